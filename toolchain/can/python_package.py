"""Writes firmware/python/supercoil/generated/: the Python package's tables of the protocol, of faults and of refusals.

usage: python_package.py DBC REPOSITORY FOLDER
"""

import pathlib
import re
import sys

import cantools

from python_texts import first_paragraph, plain, section, table_cells, table_rows
from signal_table import constant, names_of, reserved_of

HEAD = "# Generated from {source} by toolchain/generate-can. Do not edit.\n"
QUOTED = re.compile(r'"\w+"')
DBC_NAME = "firmware/io/can/supercoil.dbc"


def class_name(name):
    """limited_by -> LimitedBy"""
    return "".join(word.capitalize() for word in name.split("_"))


def tables(database):
    """Each table of names once; a table has the name of its signal."""
    found = {}
    for message in database.messages:
        for signal in message.signals:
            if names := names_of(signal):
                found.setdefault(signal.name, names)
    return found


def names_module(database):
    yield HEAD.format(source=DBC_NAME)
    yield '"""Names of the values of signals."""\n'
    yield "from supercoil.named import Named"
    for title, names in sorted(tables(database).items()):
        yield f"\n\nclass {class_name(title)}(Named):"
        yield from (f"    {name} = {raw}" for raw, name in sorted(names.items()))


def field_type(signal):
    if names_of(signal):
        return f"names.{class_name(signal.name)}"
    if signal.is_float or reserved_of(signal) is not None or signal.scale != 1:
        return "float"
    return "bool" if signal.length == 1 else "int"


def signal_line(signal):
    kind = "floating" if signal.is_float else "signed" if signal.is_signed else "unsigned"
    fields = [repr(signal.name), repr(signal.unit or ""), str(signal.start), str(signal.length), f"Raw.{kind}",
              repr(float(signal.scale)), repr(reserved_of(signal)),
              repr(signal.multiplexer_ids[0] if signal.multiplexer_ids else None), field_type(signal)]
    return f"        Signal({', '.join(fields)}),".replace("'", '"')


def messages_module(database):
    yield HEAD.format(source=DBC_NAME)
    yield '"""Every message as a type, and its layout in a frame. A value that is not available is NaN."""\n'
    yield "from typing import NamedTuple\n"
    yield "from supercoil.generated import names"
    yield "from supercoil.layout import Layout, Raw, Signal"
    for message in database.messages:
        yield f'\n\nclass {message.name}(NamedTuple):\n    """{message.comment}"""\n'
        yield "    time_s: float  # when it was on the bus, by the receiver's clock"
        yield from (f"    {signal.name}: {field_type(signal)}" for signal in message.signals)
    yield "\n\nLAYOUTS = ("
    for message in database.messages:
        sent_by_board = "Board" in message.senders
        yield (f"    Layout({message.name}, {message.frame_id - 1:#05x}, {message.length}, "
               f"{message.cycle_time or 0}, {sent_by_board}, (")
        yield from map(signal_line, message.signals)
        yield "    )),"
    yield ")\n\n# Identifiers are base + node."
    for message in database.messages:
        yield f"{constant(message).upper()} = {message.frame_id - 1:#05x}"


def faults_module(database, repository):
    yield HEAD.format(source="docs/faults")
    yield '"""An exception for each fault, with the text of its page."""\n'
    yield "from supercoil.errors import FaultError"
    classes = []
    for number, name in sorted(tables(database)["fault"].items()):
        if name == "none":
            continue
        page = (repository / "docs" / "faults" / f"{name}.md").read_text()
        classes.append((number, class_name(name)))
        yield f'\n\nclass {class_name(name)}(FaultError):\n    """{plain(first_paragraph(page))}"""\n'
        yield f"    number = {number}\n    name = {name!r}".replace("'", '"')
        yield f'    meaning = """\\\n{plain(first_paragraph(page))}"""'
        yield f'    remedy = """\\\n{plain(section(page, "Remedy"))}"""'
        yield f'    page = """\\\n{page.rstrip()}\n"""'
    yield "\n\nBY_NUMBER: dict[int, type[FaultError]] = {"
    yield from (f"    {number}: {name}," for number, name in classes)
    yield "}"


def refusals_module(database, repository):
    meanings = table_rows((repository / "docs" / "can.md").read_text(), "refused with")
    yield HEAD.format(source="docs/can.md")
    yield '"""An exception for each refusal."""\n'
    yield "from supercoil.errors import RefusalError"
    classes = []
    for number, name in sorted(tables(database)["refusal"].items()):
        if name == "none":
            continue
        if name not in meanings:
            sys.exit(f"docs/can.md: the table of refusals has no row for {name}")
        classes.append((number, class_name(name)))
        yield f'\n\nclass {class_name(name)}(RefusalError):\n    """{meanings[name]}"""\n'
        yield f"    number = {number}\n    name = {name!r}".replace("'", '"')
        yield f'    meaning = """\\\n{meanings[name]}"""'
    yield "\n\nBY_NUMBER: dict[int, type[RefusalError]] = {"
    yield from (f"    {number}: {name}," for number, name in classes)
    yield "}"


def results_module(database, repository):
    meanings = table_rows((repository / "docs" / "running.md").read_text(), "result")
    notes = re.search(r"identify_note_names{(.*?)}", (repository / "firmware/core/modes/result.hpp").read_text(), re.S)[1]
    yield HEAD.format(source="docs/running.md and firmware/core/modes/result.hpp")
    yield '"""The results of identify and calibrate."""\n'
    yield "from supercoil.generated.names import Result\n"
    yield "MEANINGS = {"
    for _, name in sorted(tables(database)["result"].items()):
        if name not in meanings:
            sys.exit(f"docs/running.md: the table of results has no row for {name}")
        yield f'    Result.{name}: "{meanings[name]}",'
    yield "}"
    yield "\n# Bits of identify's notes, from the least significant."
    yield f"NOTES = ({', '.join(re.findall(QUOTED, notes))})"


def tunables_module(database, repository):
    page = (repository / "docs" / "tuning.md").read_text()
    of = {"CONTROLLER": table_cells(page, "value of a controller"), "ESTIMATOR": table_cells(page, "value of an estimator")}
    yield HEAD.format(source="docs/tuning.md")
    yield '"""Units, choices and ranges of the values of controllers and estimators."""\n'
    yield "from supercoil.generated.names import Tunable"
    tunables = [name for _, name in sorted(tables(database)["tunable"].items()) if name != "all"]
    ranges = {}
    for what, rows in of.items():
        units, choices = [], []
        for name in (name for name in tunables if name in rows):
            unit, may_be = rows[name]
            units.append(f'    Tunable.{name}: "{unit}",')
            if ends := re.fullmatch(r"(\S+) to (\S+)", may_be):
                told = f"({float(ends[1])}, {float(ends[2])})"
                if ranges.setdefault(name, told) != told:
                    sys.exit(f"docs/tuning.md: two ranges of {name}")
            else:
                choices.append(f"    Tunable.{name}: {tuple(may_be.split(', '))},".replace("'", '"'))
        yield from (f"\n{what}_UNITS = {{", *units, "}")
        yield from ("\n# A choice is sent as its index.", f"{what}_CHOICES = {{", *choices, "}")
    yield from ("\n# Minimum and maximum.", "RANGES = {", *(f"    Tunable.{name}: {told}," for name, told in ranges.items()), "}")
    for name in tunables:
        if not any(name in rows for rows in of.values()):
            sys.exit(f"docs/tuning.md: no table of values has a row for {name}")


def version_module(database, repository):
    project = (repository / "CMakeLists.txt").read_text()
    yield HEAD.format(source=f"CMakeLists.txt and {DBC_NAME}")
    yield f'__version__ = "{re.search(r"project[(]supercoil VERSION ([0-9.]+)", project)[1]}"'
    yield f"PROTOCOL_VERSION = {database.dbc.attributes['ProtocolVersion'].value}"


def main(dbc, repository, folder):
    database = cantools.database.load_file(dbc, sort_signals="by_start")
    modules = {
        "names": names_module(database), "messages": messages_module(database),
        "faults": faults_module(database, repository), "refusals": refusals_module(database, repository),
        "results": results_module(database, repository), "tunables": tunables_module(database, repository),
        "version": version_module(database, repository)}
    for name, lines in modules.items():
        (folder / f"{name}.py").write_text("\n".join(lines) + "\n")
    (folder / "__init__.py").write_text('"""Generated by toolchain/generate-can."""\n')


if __name__ == "__main__":
    main(sys.argv[1], *map(pathlib.Path, sys.argv[2:]))
