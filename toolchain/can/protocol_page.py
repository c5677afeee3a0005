"""Prints docs/can-protocol.md from the DBC given on the command line."""

import sys

import cantools

from protocol_session import SESSION, session

INTRODUCTION = """\
# CAN protocol

Generated from `firmware/io/can/supercoil.dbc` by `toolchain/generate-can`; [can.md](can.md) explains how to use it.

Version {version}. Classical CAN with 11-bit identifiers, at the bit rate of the bus (usually 500 kbit/s). An identifier is base + node,
node 1 to 63; each channel of a board is a node. The DBC describes node 1.

All signals are little-endian (Intel): bit n is bit n mod 8, counted from the lowest, of byte n / 8, and a signal's lowest bit
comes first. *Raw* is the type of the bits: i is signed (two's complement), u is unsigned, a float is IEEE 754 with 32 bits. The value is
raw × scale. *n/a* is the raw value for "not available"; for a float it is NaN. A value outside its range is sent as the nearest end of
the range.

A board ignores remote frames, CAN FD frames, and frames with 29-bit or other identifiers. A protected message
([Command](#command), [SettingWrite](#settingwrite), [TuningWrite](#tuningwrite), [Knot](#knot), [Play](#play)) of the wrong length counts as damaged, like one with
a wrong checksum: it is neither obeyed nor answered, and counts towards the fault command_damaged. Any other message of the wrong length is
ignored. [A session](#a-session) shows how all of this works together.

| identifier | message | from | every | bytes |
|---|---|---|---|---|
"""


def number(value):
    return f"{value:.12g}"


def period(message):
    return f"{message.cycle_time} ms" if message.cycle_time else "when needed"


def is_scaled(signal):
    return not signal.is_float and "not_available" in map(str, (signal.choices or {}).values())


def raw_kind(signal):
    if signal.is_float:
        return "float"
    return f"{'i' if signal.is_signed else 'u'}{signal.length}"


def span(signal):
    if signal.is_float:
        return "any"
    return f"{number(signal.minimum)} to {number(signal.maximum)}"


def unavailable(signal):
    return next((number(raw) for raw, name in (signal.choices or {}).items() if str(name) == "not_available"), "")


def meaning(signal):
    text = signal.comment
    if signal.multiplexer_ids:
        text = f"While {signal.multiplexer_signal} is {signal.multiplexer_ids[0]}: {text}"
    if signal.choices and not is_scaled(signal):
        text += f" [Names](#names-of-{signal.name})"
    return text


def signal_row(signal):
    bits = f"{signal.start}" if signal.length == 1 else f"{signal.start} to {signal.start + signal.length - 1}"
    scale = "" if signal.is_float or signal.scale == 1 else number(signal.scale)
    cells = [f"`{signal.name}`", bits, raw_kind(signal), scale, signal.unit or "", span(signal), unavailable(signal),
             meaning(signal)]
    return "| " + " | ".join(cells) + " |"


def describe_message(message):
    yield f"\n## {message.name}\n"
    yield f"0x{message.frame_id - 1:03X} + node, {message.length} bytes, {period(message)}. {message.comment}\n"
    yield "| signal | bits | raw | scale | unit | range | n/a | meaning |"
    yield "|---|---|---|---|---|---|---|---|"
    yield from map(signal_row, message.signals)


def describe_names(database):
    tables = {}
    for message in database.messages:
        for signal in message.signals:
            if signal.choices and not is_scaled(signal):
                names = {raw: str(name) for raw, name in signal.choices.items()}
                if tables.setdefault(signal.name, names) != names:
                    sys.exit(f"{message.name}.{signal.name}: another signal of this name has other names of values")
    for title, names in tables.items():
        yield f"\n## Names of {title}\n"
        yield "| raw | name |"
        yield "|---|---|"
        yield from (f"| {raw} | `{name}` |" for raw, name in sorted(names.items()))


def page(database):
    yield INTRODUCTION.format(version=database.dbc.attributes["ProtocolVersion"].value).rstrip("\n")
    for message in database.messages:
        anchor = message.name.lower()
        yield (f"| 0x{message.frame_id - 1:03X} + node | [{message.name}](#{anchor}) | {message.senders[0]} | "
               f"{period(message)} | {message.length} |")
    yield SESSION.rstrip("\n")
    yield from session(database)
    for message in database.messages:
        yield from describe_message(message)
    yield from describe_names(database)


if __name__ == "__main__":
    print("\n".join(page(cantools.database.load_file(sys.argv[1], sort_signals="by_start"))))
