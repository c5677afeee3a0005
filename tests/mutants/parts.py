"""Test programs in parts: one file of tests at a time, linked only with the objects that it needs.

So a mutant is compiled only into the objects of the next part, parts whose code it does not change are not run, and the
nearest part comes first.
"""

import dataclasses
import pathlib
import re
import shlex
import shutil


TRACE = ("-Wl,--trace", "-Wl,--trace")  # once it names archives, twice also the members it takes


@dataclasses.dataclass
class Part:
    program: str
    name: str
    objects: frozenset  # of the build: a change in one of these can change the part
    command: list  # links it
    path: pathlib.Path
    source: str
    took_s: float = 0.0

    def __str__(self):
        return self.path.name

    def distance(self, file):
        """Smaller is nearer: the tests of a file have its name or include its header. A part without a source is a whole
        program that tries everything."""
        stem = pathlib.Path(file).stem
        tests = self.name.removesuffix("_test")
        if tests == stem:
            return 0
        if tests.startswith(stem) or stem.startswith(tests):
            return 1
        if re.search(rf"[/\"]{re.escape(stem)}\.hpp", self.source):
            return 2
        return 4 if self.source else 3


def parts_of(program, tree, build, run):
    """`run` runs a command in the build's folder and returns its output. Everything must have been built."""
    output = run(["ninja", "-C", build, "-t", "commands", program]).stdout
    words = shlex.split(output.splitlines()[-1].removeprefix(": && ").removesuffix(" && :"))
    at = words.index("-o")
    linked = [word for word in words if word.endswith(".o")]
    flags = [word for word in words[:at] if word not in linked]
    if shutil.which("ld.lld"):
        flags.append("-fuse-ld=lld")  # takes a third of the time
    own = [name for name in linked if name.endswith("_test.cpp.o")]
    rest = [name for name in linked if name not in own]
    (build / "parts").mkdir(exist_ok=True)
    archives = {word: members_of(word, build, run) for word in words[at + 2:] if word.endswith(".a")
                and not word.startswith("/")}
    for test in own or [None]:
        name = pathlib.Path(test).name.removesuffix(".cpp.o") if test else program
        path = build / "parts" / f"{program}.{name}"
        objects = [*([test] if test else []), *rest]
        traced = run([*flags, *TRACE, *objects, "-o", path, *words[at + 2:]], cwd=build).stdout
        objects += sorted(pulled(traced, archives))
        libraries = [word for word in words[at + 2:] if word not in archives]
        yield Part(program, name, frozenset(objects), [*flags, *objects, "-o", str(path), *libraries], path,
                   source_of(test, tree) if test else "")


def source_of(test, tree):
    return (tree / re.sub(r"CMakeFiles/[^/]*\.dir/", "", test).removesuffix(".o")).read_text()


def members_of(archive, build, run):
    """The objects of an archive by their name in it. Two may have the same name."""
    output = run(["ninja", "-C", build, "-t", "query", archive]).stdout
    inputs = [line.strip() for line in output.split("outputs:")[0].splitlines() if line.strip().endswith(".o")]
    return {name: [path for path in inputs if pathlib.Path(path).name == name]
            for name in {pathlib.Path(path).name for path in inputs}}


def pulled(traced, archives):
    """The archives' objects that a linker took, from its trace. GNU's linker writes (a)b, LLVM's a(b)."""
    for words in re.findall(r"^(\S+\.a)\((\S+\.o)\)$|^\((\S+\.a)\)(\S+\.o)$", traced, re.M):
        archive, member = words[:2] if words[0] else words[2:]
        yield from archives.get(archive, {}).get(member, [])
