"""A copy of the tree with a build of its own, in which one mutant after the other is compiled and tried."""

import fcntl
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
import time

# Without optimisation tests take ten times as long; line tables say which objects have code from which header.
FLAGS = "-O1 -g1 -gno-column-info -w"
ENVIRONMENT = {"RC_PARAMS": "seed=20261120 max_success=100"}
PATIENCE = 10.0  # times what a program takes on the unchanged tree


class Failed(Exception):
    """Something of the unchanged tree does not work: its text says what."""


def tree_files(root):
    listed = subprocess.run(["git", "ls-files", "-z", "-c", "-o", "--exclude-standard"], cwd=root, check=True,
                            capture_output=True, text=True).stdout
    return sorted(name for name in listed.split("\0") if name and (root / name).is_file())


def tree_hash(root):
    digest = hashlib.sha256()
    for name in tree_files(root):
        digest.update(name.encode() + b"\0" + hashlib.sha256((root / name).read_bytes()).digest())
    return digest.hexdigest()[:16]


class Workshop:
    def __init__(self, root, folder, programs, jobs):
        self.root = root
        self.folder = folder
        self.tree = folder / "tree"
        self.build = folder / "build"
        self.programs = programs
        self.jobs = jobs
        self.mutated = None  # the file that differs from the original now
        self.lines = []  # of its original
        self.touched = set()  # objects that were compiled with it
        self.took_s = {}
        self.originals = {}  # of objects: what their code hashes to
        folder.mkdir(parents=True, exist_ok=True)
        self.lock = open(folder / "lock", "w")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Failed(f"{folder}: another toolchain/mutate is at work there") from None

    def prepare(self, say):
        """The copy as the tree is, built, and every program green."""
        self.copy()
        say("building the unchanged tree")
        self.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=",
                  f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DCMAKE_UNITY_BUILD=OFF", "-DSUPERCOIL_BENCH=OFF",
                  "-DSUPERCOIL_TESTS=ON"])
        self.ninja(self.programs, check=True)
        self.read_dependencies()
        for program in self.programs:
            start = time.monotonic()
            if not self.passes(program, None):
                raise Failed(f"{program} is red without any mutant (in {self.build})")
            self.took_s[program] = time.monotonic() - start
            say(f"{program}: {self.took_s[program]:.0f} s")

    def copy(self):
        names = tree_files(self.root)
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
        for name in (".venv", "toolchain/page/node_modules"):
            there = self.tree / name
            if not there.exists():
                there.symlink_to((self.root / name).resolve())

    def run(self, command, check=True, **options):
        done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              **options)
        if check and done.returncode != 0:
            raise Failed(f"{command[0]} failed:\n{done.stdout[-4000:]}")
        return done

    def ninja(self, targets, check=False, cached=True):
        """cached: worth keeping, where a compiler cache is in use."""
        environment = os.environ | ({} if cached else {"CCACHE_READONLY": "1"})
        return self.run(["ninja", "-C", self.build, "-j", self.jobs, *targets], check, env=environment).returncode == 0

    def read_dependencies(self):
        self.objects_of = {}
        told = self.run(["ninja", "-C", self.build, "-t", "deps"]).stdout
        target = ""
        for line in told.splitlines():
            if line and not line.startswith(" "):
                target = line.split(": #deps")[0]
            elif line.strip() and (self.build / target).exists():
                path = os.path.normpath(self.build / line.strip())
                self.objects_of.setdefault(path, set()).add(target)
        self.with_code = {}

    def objects(self, file):
        """Which objects must be compiled again when it changes."""
        return self.objects_of.get(str(self.tree / file), set())

    def objects_with_code(self, file):
        """Of a header, those that have code from it, by their line tables."""
        if file.endswith(".cpp"):
            return self.objects(file)
        if file not in self.with_code:
            name = f" {pathlib.Path(file).name}\n"
            lines_of = lambda target: self.run(["readelf", "--debug-dump=rawline", self.build / target], False).stdout
            self.with_code[file] = {target for target in self.objects(file) if name in lines_of(target)}
        return self.with_code[file]

    def code_hash(self, target):
        stripped = self.folder / "stripped.o"
        self.run(["objcopy", "--strip-debug", self.build / target, stripped])
        return hashlib.sha256(stripped.read_bytes()).hexdigest()

    def code_changed(self, targets):
        return any(self.code_hash(target) != self.originals[target] for target in targets)

    def write(self, file, text, targets):
        """Not newer than before: ninja compiles again what has lost its object, and nothing else."""
        path = self.tree / file
        for target in targets:
            (self.build / target).unlink(missing_ok=True)
        was = path.stat()
        path.write_text(text)
        os.utime(path, ns=(was.st_atime_ns, was.st_mtime_ns))

    def restore(self):
        if self.mutated is None:
            return
        self.write(self.mutated, "".join(self.lines), self.touched)
        self.ninja([*self.touched], check=True)
        self.mutated, self.touched = None, set()

    def compile(self, mutant, targets):
        if self.mutated not in (None, mutant.file):
            self.restore()
        for target in targets - self.originals.keys():
            self.originals[target] = self.code_hash(target)
        if self.mutated is None:
            self.lines = (self.tree / mutant.file).read_text().splitlines(keepends=True)
        self.mutated = mutant.file
        self.touched |= targets
        lines = list(self.lines)
        lines[mutant.line - 1] = mutant.after + "\n"
        self.write(mutant.file, "".join(lines), self.touched)
        return self.ninja(sorted(self.touched), cached=False)

    def judge(self, mutant, programs):
        """("invalid" | "same code" | "survived" | "killed", by which program)."""
        targets = self.objects_with_code(mutant.file)
        if targets and not self.compile(mutant, targets):
            return "invalid", ""
        if not self.code_changed(targets):
            # A constant may be elsewhere, where no line of its own tells of it.
            targets = self.objects(mutant.file)
            if not self.compile(mutant, targets):
                return "invalid", ""
            if not self.code_changed(targets):
                return "same code", ""
        for program in programs:
            if not self.ninja([program], cached=False):
                return "invalid", ""
            if not self.passes(program, self.took_s[program]):
                return "killed", program
        return "survived", ""

    def passes(self, program, usual_s):
        """What hangs does not pass."""
        limit_s = None if usual_s is None else PATIENCE * usual_s + 30.0
        environment = os.environ | ENVIRONMENT | {"SUPERCOIL_REFERENCE": str(self.build / "reference")}
        with open(self.folder / f"{program}.log", "w") as log:
            running = subprocess.Popen(["prlimit", "--core=0", self.build / "bin" / program],
                                       stdout=log, stderr=subprocess.STDOUT, env=environment, cwd=self.folder,
                                       start_new_session=True)
            try:
                return running.wait(limit_s) == 0
            except subprocess.TimeoutExpired:
                return False
            finally:
                end_group(running)


def end_group(process):
    """With the processes that it started itself."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
