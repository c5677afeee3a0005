"""The session in docs/can-protocol.md, with frames encoded by cantools from the DBC."""

SESSION = """
## A session

A master moves the muscle of node 1 to 10 mm and lets it rest. In the claim, `session` is any number that the master chooses (here 0x1234);
0xBEEF and 0x5A17 stand for numbers that the board chooses at random. An answer comes within a few ms. If there is none within 100 ms,
the command or its answer was lost: send the command again as a new one, with the next counter.

| from | what | identifier | bytes |
|---|---|---|---|
"""

RULES = """
- **Counter.** Each answer repeats the counter of its command. The granted claim sets the counter: each later command increments it by
  one, modulo 16, even if commands in between were refused. A frame may skip up to 3 values.
- **Checksum.** CRC-8H2F: polynomial 0x2F, start 0xFF, final XOR 0xFF, nothing reflected; for the ASCII text `123456789` it is 0xDF. It is
  computed over all bytes except the first, then over the data id, which is the low byte of the identifier: for node 1 it is 0x01 in
  Command and 0x41 in Acknowledge, for node 2 it is 0x02 and 0x42.
- **Lease.** The number from claim_again is valid for one claim within `lease_ms` (1 s). A lease ends `lease_ms` after its last command
  with the right session and counter, when the board starts, or when its holder sends `lease` with value -1.
- **Expiry.** A command to heat ends with the fault command_timeout if neither it nor `renew` arrives for `command.timeout_ms` (250 ms).
  Send one of them every 50 ms. `lease_ms` and `command.timeout_ms` are keys of the board's file.
- **Values.** `position`: displacement from rest, at most the channel's `limits.max_travel_m` in either direction; beyond that it is refused
  with `out_of_range`. `power`: any finite number; below 0 the muscle gets no power, above `limits.max_W` it gets `limits.max_W`. NaN is
  refused with `out_of_range`, and so is any value except 0 for `arm`, `reset`, `renew`, `rest`, `identify` and `calibrate`. RefusedValue
  then has the nearest value that would be obeyed, and the channel continues as before.
- **Stop.** `disarm` with value 0 is obeyed from every sender, with any session and counter; the checksum must be right. With another
  value it needs the lease, like other commands.
"""

MASTER, NONCE, GRANTED = 0x1234, 0xBEEF, 0x5A17


def crc8(data):
    crc = 0xFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x2F if crc & 0x80 else crc << 1) & 0xFF
    return crc ^ 0xFF


def row(sender, what, message, **signals):
    data = message.encode({"crc": 0, **signals})
    data = bytes([crc8(data[1:] + bytes([message.frame_id & 0xFF]))]) + data[1:]
    return f"| {sender} | {what} | 0x{message.frame_id:03X} | `{data.hex(' ').upper()}` |"


def session(database):
    command, acknowledge = (database.get_message_by_name(name) for name in ("Command", "Acknowledge"))

    def asks(what, counter, opcode, value=0.0, session=GRANTED):
        return row("master", what, command, counter=counter, opcode=opcode, session=session, value=value)

    def answers(what, counter, opcode, refusal="none", session=GRANTED, granted=0):
        return row("board", what, acknowledge, counter=counter, opcode=opcode, session=session, refusal=refusal, granted=granted)

    yield asks("`lease` 0: claims", 1, "lease", session=MASTER)
    yield answers("`claim_again`, with 0xBEEF in `granted`", 1, "lease", "claim_again", MASTER, NONCE)
    yield asks("`lease` 48879 (0xBEEF): claims with that number", 2, "lease", float(NONCE), MASTER)
    yield answers("`none`, with the session in `granted`", 2, "lease", session=MASTER, granted=GRANTED)
    yield asks("`arm`: the board probes the heater", 3, "arm")
    yield answers("`none`", 3, "arm")
    yield asks("`position` 0.01", 4, "position", 0.01)
    yield answers("`busy`: the probe takes up to 50 ms, so try again", 4, "position", "busy")
    yield asks("`position` 0.01", 5, "position", 0.01)
    yield answers("`none`: the muscle moves", 5, "position")
    yield asks("`renew`, every 50 ms", 6, "renew")
    yield answers("`none`", 6, "renew")
    yield asks("`rest`: armed, without power", 7, "rest")
    yield answers("`none`", 7, "rest")
    yield asks("`disarm`", 8, "disarm")
    yield answers("`none`", 8, "disarm")
    yield asks("`lease` -1: releases the lease", 9, "lease", -1.0)
    yield answers("`none`", 9, "lease")
    yield RULES.rstrip("\n")
