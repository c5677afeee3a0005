"""Prints firmware/io/can/generated/messages.hpp, every message and signal as a table, from the DBC given on the
command line."""

import re
import sys

import cantools

HEAD = """\
// Generated from firmware/io/can/supercoil.dbc by toolchain/generate-can. Do not edit.
#pragma once

#include "can/message.hpp"

namespace supercoil::can {
"""

NOT_AVAILABLE = "not_available"
MASTER = "Master"


def names_of(signal):
    names = {raw: str(name) for raw, name in (signal.choices or {}).items()}
    return {} if NOT_AVAILABLE in names.values() else names


def reserved_of(signal):
    return next((raw for raw, name in (signal.choices or {}).items() if str(name) == NOT_AVAILABLE), None)


def constant(message):
    """FirstCause -> first_cause"""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", message.name).lower()


def table_name(signal):
    return f"names_of_{signal.name}"


def describe_names(database):
    tables = {}
    for message in database.messages:
        for signal in message.signals:
            names = names_of(signal)
            if names and tables.setdefault(signal.name, names) != names:
                sys.exit(f"{message.name}.{signal.name}: another signal of this name has other names of values")
    for name, values in sorted(tables.items()):
        yield f"\ninline constexpr std::array<ValueName, {len(values)}> names_of_{name}{{{{"
        yield from (f'    {{{raw}, "{text}"}},' for raw, text in sorted(values.items()))
        yield "}};"


def describe_signal(signal):
    kind = "floating" if signal.is_float else "signed_integer" if signal.is_signed else "unsigned_integer"
    reserved = reserved_of(signal)
    fields = [f'"{signal.name}"', f'"{signal.unit or ""}"', str(signal.start), str(signal.length), f"Raw::{kind}",
              f"{float(signal.scale)!r}", "no_value" if reserved is None else str(reserved),
              str(signal.multiplexer_ids[0]) if signal.multiplexer_ids else "always",
              table_name(signal) if names_of(signal) else "{}"]
    return f"    {{{', '.join(fields)}}},"


def describe(database):
    yield HEAD.rstrip("\n")
    yield from describe_names(database)
    for message in database.messages:
        yield f"\ninline constexpr std::array<SignalInfo, {len(message.signals)}> signals_of_{message.name}{{{{"
        yield from map(describe_signal, message.signals)
        yield "}};"
    yield "\nnamespace message {"
    for message in database.messages:
        yield (f'inline constexpr MessageInfo {constant(message)}{{"{message.name}", {message.frame_id - 1:#05x}, '
               f"{message.length}, {message.cycle_time or 0}, signals_of_{message.name}, "
               f"{'true' if message.senders == [MASTER] else 'false'}}};")
    yield "}  // namespace message\n"
    yield "/// In the order of the DBC."
    yield f"inline constexpr std::array<MessageInfo, {len(database.messages)}> all_messages{{{{"
    for message in database.messages:
        yield f"    message::{constant(message)},"
    yield "}};\n"
    yield "}  // namespace supercoil::can"


if __name__ == "__main__":
    print("\n".join(describe(cantools.database.load_file(sys.argv[1], sort_signals="by_start"))))
