"""Parses the programs' --help, for the manual pages and for completion in shells."""

import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ("supercoild", "supercoil", "supercoil-sim")

DESCRIPTION_COLUMN = 30
NAME = re.compile(r"(?P<names>[^\s{]+)(?:\{false\})?(?: (?P<value>[A-Z]+))?(?::(?P<range>.*?))?(?:=(?P<default>\S+))?"
                  r"(?P<many> \.\.\.)?(?P<required> REQUIRED)?(?P<relations>(?: (?:Needs|Excludes):(?: -[^\s:]+)+)*)")
RELATION = re.compile(r"(Needs|Excludes):((?: -\S+)+)")


def help_of(programs, command):
    program, *words = command.split()
    return subprocess.run([programs / program, *words, "--help"], check=True, capture_output=True, text=True).stdout


def entries(text):
    """(section, name, description) of each entry that a help lists."""
    section, lines = "", text.splitlines()
    for line, below in zip(lines, [*lines[1:], ""]):
        if re.fullmatch(r"[A-Z][\w -]*:", line):
            section = line[:-1]
        elif re.match(r"  \S", line):
            # A name that does not fit its column has its description below.
            own_line = below.startswith(" " * DESCRIPTION_COLUMN)
            name, description = (line, below) if own_line else (line[:DESCRIPTION_COLUMN], line[DESCRIPTION_COLUMN:])
            yield section, name.strip(), description.strip()


def commands(programs):
    """Every command of the programs, as it is typed."""
    for program in PROGRAMS:
        yield program
        for section, name, _ in entries(help_of(programs, program)):
            if section == "Subcommands":
                yield f"{program} {name}"


def parts_of(name):
    """The parts of an option or a positional as it stands in the help."""
    parts = NAME.fullmatch(name)
    if not parts:
        raise SystemExit(f"cannot parse this entry of the help: {name}")
    return parts
