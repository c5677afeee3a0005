"""The mutants of all lines, and a sample of them spread evenly over the lines."""

import contextlib
import dataclasses
import io
import random
import re

RULES = ["universal.rules", "c_like.rules", "cpp.rules"]
# Lines that have no effect of their own.
NO_CODE = [r"^\s*(#|//|/\*|\*|using |namespace |static_assert|template|public:|private:|class |struct |enum )",
           r"^\s*[})\]]+[;,]?\s*(//.*)?$"]
# Declared names are used: without the declaration nothing compiles.
DECLARATION = (r"\s*(?!return\b|delete\b|throw\b|else\b|if\b|for\b|while\b|case\b)"
               r"(?!.*(<<|>>))[\w:][\w:<>,&*\s\[\]]*[\s&*>][\w:]+\s*(;|=[^=]|\{|\()")
# The code is formatted: these have spaces on both sides as binary operators, and none in types.
OF_TYPES_TOO = "<>*&"


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str
    line: int  # from 1
    before: str
    after: str

    def key(self):
        """Its name in tests/mutants/equivalent: without the line number, which other changes shift."""
        return self.file, self.before.strip(), self.after.strip()

    def __str__(self):
        return f"{self.file}:{self.line}\n      - {self.before.strip()}\n      + {self.after.strip()}"


def mutants_of(file, text):
    """By line. Not in the texts of messages, which do no harm, nor as inserted lines, which seldom compile."""
    from universalmutator import mutator  # the rest of this file does not need it

    source = text.splitlines(keepends=True)
    with contextlib.redirect_stdout(io.StringIO()):
        made = mutator.mutants_regexp(source, RULES, ignorePatterns=NO_CODE)
    by_line = {}
    for number, after, *_ in made:
        before = source[number - 1]
        if after.count("\n") != 1 or squeezed(after) == squeezed(before) or not promising(before, after):
            continue
        by_line.setdefault(number, []).append(Mutant(file, number, before.rstrip("\n"), after.rstrip("\n")))
    return by_line


def promising(before, after):
    """False if it cannot compile, which saves half of all attempts."""
    if after.lstrip().startswith("/*"):
        return before.rstrip().endswith(";") and not re.match(DECLARATION, before)
    first = next(i for i in range(len(before)) if not after.startswith(before[:i + 1]))
    if after[first] == "=" and before[first - 1] in OF_TYPES_TOO:
        first -= 1
    if before[first].isdigit():  # neither part of a name nor of a number
        return not re.match(r"\w", before[first - 1]) and not re.search(r"\(\d+[-+]1\)\.|\.\(\d+[-+]1\)", after)
    if re.search(r"[%*/]\+|\+[%*/]|[%/]-|-[%*/]", after[first - 1:first + 2]):  # half of ++ or --
        return False
    if before[first] not in OF_TYPES_TOO:
        return True
    return before[first - 1] == " " and before[first + 1] in " =&"


def squeezed(line):
    """The line without spaces, texts and trailing comments."""
    return re.sub(r"\s|//.*", "", re.sub(r'"[^"]*"', '""', line))


def strata(files, root, count, seed):
    """`count` runs of equally many lines; all mutants of each run in random order: first the line, then its mutant.
    The first one that compiles and is not an equivalent represents the run."""
    lines = []
    for file in files:
        by_line = mutants_of(file, (root / file).read_text())
        lines += [by_line[number] for number in sorted(by_line)]
    result = []
    count = min(count, len(lines))
    for i in range(count):
        chance = random.Random(f"{seed} {i}")
        run = [list(of_line) for of_line in lines[i * len(lines) // count:(i + 1) * len(lines) // count]]
        order = []
        while run:
            of_line = chance.choice(run)
            order.append(of_line.pop(chance.randrange(len(of_line))))
            run = [rest for rest in run if rest]
        result.append(order)
    return result, len(lines)
