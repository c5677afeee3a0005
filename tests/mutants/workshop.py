"""A copy of the tree with its own build, in which mutants are compiled and tried one after the other."""

import collections
import fcntl
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from parts import parts_of

# Without optimisation tests take ten times as long; line tables show which objects have code from which header.
# A missing return may work by luck when the compiler builds the result in place: such a mutant must not compile.
FLAGS = "-O1 -g1 -gno-column-info -Werror=return-type"
PRECOMPILED = ["-DBOOST_ALL_NO_LIB", "-DEIGEN_DONT_VECTORIZE", "-isystem", "/usr/include/eigen3"]
ENVIRONMENT = {"RC_PARAMS": "seed=20261120 max_success=100 noshrink=1"}
NOT_BUILT = ("docs/", "toolchain/", "tests/coverage/", "tests/attack/", "tests/mutants/equivalent/",
             "tests/mutants/mutants_test.py")
BUILT_ALL_THE_SAME = ("toolchain/cmake/", "toolchain/page/")
FAILURE = r"error: Failure in |\nFAILED "  # printed by CppUTest and by the fault matrix
HEADER = re.compile(r" (\S+\.hpp)$", re.M)  # in readelf's tables
PATIENCE = 10.0  # times the program's time on the unchanged tree


class Failed(Exception):
    """Something in the unchanged tree does not work; the text says what."""


def tree_files(root):
    listed = subprocess.run(["git", "ls-files", "-z", "-c", "-o", "--exclude-standard"], cwd=root, check=True,
                            capture_output=True, text=True).stdout
    return sorted(name for name in listed.split("\0") if name and (root / name).is_file())


def is_test(name):
    """Whether a file is a test that is run: its results stay valid while it only grows."""
    return name.startswith(("tests/unit/", "tests/loop/"))


def tests_of(root):
    """Short hashes of the lines of each test, which show whether any line is gone."""
    return {name: [hashlib.sha256(line).hexdigest()[:8] for line in (root / name).read_bytes().splitlines()]
            for name in tree_files(root) if is_test(name)}


def code_hash(root):
    """A hash of everything except tests and texts."""
    digest = hashlib.sha256()
    for name in tree_files(root):
        built = name.startswith(BUILT_ALL_THE_SAME) or not name.startswith(NOT_BUILT)
        if built and not is_test(name) and not name.endswith(".md"):
            digest.update(name.encode() + b"\0" + hashlib.sha256((root / name).read_bytes()).digest())
    return digest.hexdigest()[:16]


class Workshop:
    def __init__(self, root, folder, programs, jobs, green):
        """green: the time of each part on the unchanged tree; shared by the copies."""
        self.root = root
        self.folder = folder
        self.tree = folder / "tree"
        self.build = folder / "build"
        self.programs = programs
        self.jobs = jobs
        self.green = green
        self.mutated = None  # the file that currently differs from the original
        self.lines = []  # of the original file
        self.mutants = set()  # objects that were compiled with the mutant
        self.absent = set()  # objects that must be compiled when they are needed
        self.originals = {}  # hash of each original object's code
        self.kills = collections.Counter()  # by file and part, and by part
        folder.mkdir(parents=True, exist_ok=True)
        self.shared = folder.parent / "shared"  # by the copies: files that no mutant changes
        self.lock = open(folder / "lock", "w")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Failed(f"{folder}: another toolchain/mutate is at work there") from None

    def prepare(self, jobs, say):
        """Copies and builds the unchanged tree; every part of the programs must be green."""
        self.copy()
        say("building the unchanged tree")
        self.precompile()
        self.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=",
                  f"-DCMAKE_PROJECT_supercoil_INCLUDE={self.tree / 'tests/mutants/precompiled.cmake'}",
                  f"-DSUPERCOIL_PRECOMPILED={self.shared / 'precompiled.hpp'}",
                  f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DCMAKE_UNITY_BUILD=OFF", "-DSUPERCOIL_BENCH=OFF",
                  "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
                  "-DSUPERCOIL_TESTS=ON"])
        self.ninja(self.programs, check=True, jobs=jobs)
        self.read_dependencies()
        self.parts = [part for program in self.programs for part in parts_of(program, self.tree, self.build, self.run)]
        for part in self.parts:
            self.find_green(part)
        for program in self.programs:
            times = [part.took_s for part in self.parts if part.program == program]
            say(f"{program}: {sum(times):.0f} s in {len(times)} parts")

    def find_green(self, part):
        """Runs the part on the unchanged tree unless this or another copy already knows that it is green."""
        stored = self.folder / "green.json"
        known = json.loads(stored.read_text()) if stored.exists() else {}
        program = hashlib.sha256(part.path.read_bytes()).hexdigest()
        if known.get(str(part), [""])[0] == program:
            self.green.setdefault(str(part), known[str(part)][1])
        if str(part) not in self.green:
            start = time.monotonic()
            if not self.passes(part, None):
                raise Failed(f"{part} is red without any mutant ({part.path}, {self.log_of(part)})")
            self.green[str(part)] = time.monotonic() - start
        part.took_s = self.green[str(part)]
        stored.write_text(json.dumps(known | {str(part): [program, part.took_s]}))

    def copy(self):
        names = tree_files(self.root)
        (self.shared / "control").mkdir(parents=True, exist_ok=True)
        self.tree.mkdir(exist_ok=True)
        if not (self.tree / "control").is_symlink():
            shutil.rmtree(self.tree / "control", ignore_errors=True)
            (self.tree / "control").symlink_to(self.shared / "control")
        wanted = {str(self.tree / name) for name in names}
        for path in self.tree.rglob("*") if self.tree.exists() else ():
            generated = "node_modules" in path.parts or path.is_symlink()
            if path.is_file() and not generated and str(path) not in wanted:
                path.unlink()
        for name in names:
            here, there = self.root / name, self.tree / name
            there.parent.mkdir(parents=True, exist_ok=True)
            if not there.exists() or there.read_bytes() != here.read_bytes():
                shutil.copy(here, there)
        self.control_changed = max(path.stat().st_mtime for path in (self.shared / "control").rglob("*"))
        for name in (".venv", "toolchain/page/node_modules"):
            there = self.tree / name
            if not there.exists():
                there.symlink_to((self.root / name).resolve())

    def precompile(self):
        """Compiles the headers that no mutant changes once for all copies: they take most of the compile time."""
        here, there = self.root / "tests/mutants/precompiled.hpp", self.shared / "precompiled.hpp"
        made = self.shared / "precompiled.hpp.gch"
        if made.exists() and there.read_bytes() == here.read_bytes() and made.stat().st_mtime > self.control_changed:
            return
        shutil.copy(here, there)
        self.run(["c++", "-x", "c++-header", "-std=c++20", "-ffp-contract=off", *FLAGS.split(), *PRECOMPILED,
                  "-I", self.shared / "control/include", there, "-o", made])

    def run(self, command, check=True, **options):
        done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              **options)
        if check and done.returncode != 0:
            raise Failed(f"{command[0]} failed:\n{done.stdout[-4000:]}")
        return done

    def ninja(self, targets, check=False, cached=True, jobs=None):
        """cached: the objects are worth keeping if a compiler cache is in use."""
        environment = os.environ | ({} if cached else {"CCACHE_DISABLE": "1"})
        return self.run(["ninja", "-C", self.build, "-j", jobs or self.jobs, *targets], check,
                        env=environment).returncode == 0

    def read_dependencies(self):
        """Called while every object exists: later some have not been compiled yet."""
        self.objects_of = {}
        output = self.run(["ninja", "-C", self.build, "-t", "deps"]).stdout
        target = ""
        for line in output.splitlines():
            if line and not line.startswith(" "):
                target = line.split(": #deps")[0]
            elif line.strip() and (self.build / target).exists():
                path = os.path.normpath(self.build / line.strip())
                self.objects_of.setdefault(path, set()).add(target)
        self.with_code = {}  # by a header's name
        for target in set().union(*self.objects_of.values()):
            lines = self.run(["readelf", "--debug-dump=rawline", self.build / target]).stdout
            for name in set(HEADER.findall(lines)):
                self.with_code.setdefault(name, set()).add(target)

    def objects(self, file):
        """The objects that must be compiled again when the file changes."""
        return self.objects_of.get(str(self.tree / file), set())

    def objects_with_code(self, file):
        """For a header, the objects that have code from it according to their line tables, and that of its own source,
        which shows whether a changed declaration compiles."""
        if file.endswith(".cpp"):
            return self.objects(file)
        path = pathlib.Path(file)
        own = {target for target in self.objects(file) if pathlib.Path(target).name.startswith(f"{path.stem}.cpp")}
        return self.objects(file) & (self.with_code.get(path.name, set()) | own)

    def code_hash(self, target):
        stripped = self.folder / "stripped.o"
        self.run(["objcopy", "--strip-debug", self.build / target, stripped])
        return hashlib.sha256(stripped.read_bytes()).hexdigest()

    def write(self, file, text, targets):
        """Keeps the file's time, so that ninja compiles only those sources whose objects were removed."""
        for target in targets:
            if target not in self.originals:
                self.originals[target] = self.code_hash(target)
        self.absent |= targets | self.mutants
        self.mutants = set()
        for target in self.absent:
            (self.build / target).unlink(missing_ok=True)
        path = self.tree / file
        was = path.stat()
        path.write_text(text)
        os.utime(path, ns=(was.st_atime_ns, was.st_mtime_ns))

    def restore(self):
        """Restores the file's text; its objects are compiled again when they are needed."""
        if self.mutated is not None:
            self.write(self.mutated, "".join(self.lines), set())
        self.mutated = None

    def mutate(self, mutant, targets):
        if self.mutated not in (None, mutant.file):
            self.restore()
        if self.mutated is None:
            self.lines = (self.tree / mutant.file).read_text().splitlines(keepends=True)
        self.mutated = mutant.file
        lines = list(self.lines)
        lines[mutant.line - 1] = mutant.after + "\n"
        self.write(mutant.file, "".join(lines), targets)

    def compile(self, part, targets):
        """Compiles the removed objects of a part, with the mutant or as they were."""
        needed = sorted(part.objects & self.absent)
        for mutated in (False, True):
            some = [target for target in needed if (target in targets) == mutated]
            if some and not self.ninja(some, cached=not mutated):
                return False
        self.absent.difference_update(needed)
        # All objects that include the mutated file: one without a line of it may still have one of its constants.
        self.mutants |= self.objects(self.mutated) & set(needed)
        return True

    def judge(self, mutant, programs, patience_s):
        """("invalid" | "same code" | "survived" | "killed", by which part). Unnoticed within the time, it has survived."""
        ends = time.monotonic() + patience_s
        targets = self.objects_with_code(mutant.file)
        verdict = self.judge_by(mutant, programs, targets, ends)
        if verdict[0] in ("same code", "in no program", "survived") and targets != self.objects(mutant.file):
            # A constant or a default argument may be used in an object without any line of the file.
            verdict = self.judge_by(mutant, programs, self.objects(mutant.file), time.monotonic() + patience_s)
        # No test program can notice code that it is not linked with.
        return ("survived", "") if verdict[0] == "in no program" else verdict

    def judge_by(self, mutant, programs, targets, ends):
        self.mutate(mutant, targets)
        changed = {}
        for part in self.nearest_first(mutant.file, programs):
            if not part.objects & targets:
                continue
            if time.monotonic() > ends:
                return "survived", ""
            if not self.compile(part, targets):
                return "invalid", ""
            for target in (part.objects & targets) - changed.keys():
                changed[target] = self.code_hash(target) != self.originals[target]
            if not any(changed[target] for target in part.objects & targets):
                continue
            if not self.link(part):
                return "invalid", ""
            if not self.passes(part, part.took_s):
                self.kills[mutant.file, str(part)] += 1
                self.kills[str(part)] += 1
                return "killed", str(part)
        if not changed:
            return "in no program", ""
        return ("survived" if any(changed.values()) else "same code"), ""

    def nearest_first(self, file, programs):
        """First the parts that killed other mutants of the file, then by name, number of kills and least time."""
        parts = [part for part in self.parts if part.program in programs]
        return sorted(parts, key=lambda part: (-self.kills[file, str(part)], part.distance(file), -self.kills[str(part)],
                                               part.took_s))

    def link(self, part):
        return self.run(part.command, False, cwd=self.build).returncode == 0

    def log_of(self, part):
        return self.folder / f"{part}.log"

    def passes(self, part, usual_s):
        """A part that hangs does not pass. It is stopped at its first failure."""
        limit_s = None if usual_s is None else PATIENCE * usual_s + 30.0
        environment = os.environ | ENVIRONMENT | {"SUPERCOIL_REFERENCE": str(self.build / "reference")}
        with open(self.log_of(part), "w") as log:
            running = subprocess.Popen(["prlimit", "--core=0", "stdbuf", "-oL", part.path], stdout=log,
                                       stderr=subprocess.STDOUT, env=environment, cwd=self.folder,
                                       start_new_session=True)
            try:
                return self.ends_well(running, part, limit_s)
            finally:
                end_group(running)

    def ends_well(self, running, part, limit_s):
        ends = None if limit_s is None else time.monotonic() + limit_s
        while ends is None or time.monotonic() < ends:
            try:
                return running.wait(0.5) == 0
            except subprocess.TimeoutExpired:
                if re.search(FAILURE, self.log_of(part).read_text(errors="replace")):
                    return False
        return False


def end_group(process):
    """Ends a process and the processes that it started."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
