"""Moves a muscle to 5 mm for 10 s. Needs cantools and python-can 4.4 or newer. With the simulated board, or a real one:

supercoil-sim run bench --real-time --can socketcand:29536
python3 move_muscle.py interface=socketcand host=127.0.0.1 port=29536 channel=can0
python3 move_muscle.py interface=socketcan channel=can0
"""

import pathlib
import sys
import time

import can
import cantools

can.log.setLevel("ERROR")  # it warns about every frame that TCP splits
HERE = pathlib.Path(__file__).resolve()
# Beside this file in the package; `supercoil dbc` prints it too.
DBC = next(file for file in (HERE.with_name("supercoil.dbc"), HERE.parents[2] / "firmware/io/can/supercoil.dbc")
           if file.exists())
PROTOCOL = cantools.database.load_file(DBC)
COMMAND = PROTOCOL.get_message_by_name("Command")
OURS = {message.frame_id for message in PROTOCOL.messages}  # of the first node
counter, session, signals = 0, 0x1234, {}


def crc(frame_id, data):
    value = 0xFF
    for byte in (*data[1:], frame_id & 0xFF):
        value ^= byte
        for _ in range(8):
            value = (value << 1 ^ 0x2F if value & 0x80 else value << 1) & 0xFF
    return value ^ 0xFF


def command(opcode, value=0.0):
    """Sends a command and returns its answer. Keeps what the board sends until then in `signals`."""
    global counter
    counter = (counter + 1) % 16
    data = COMMAND.encode({"crc": 0, "counter": counter, "opcode": opcode, "session": session, "value": value})
    data = bytes([crc(COMMAND.frame_id, data)]) + data[1:]
    bus.send(can.Message(arbitration_id=COMMAND.frame_id, data=data, is_extended_id=False))
    end = time.monotonic() + 1.0
    while time.monotonic() < end and (frame := bus.recv(1.0)):
        if frame.arbitration_id not in OURS:
            continue  # from another node, received before the kernel had the filters
        heard = PROTOCOL.decode_message(frame.arbitration_id, frame.data)
        signals.update({name: round(x, 7) if isinstance(x, float) else x for name, x in heard.items()})
        if "refusal" in heard and (heard["session"], heard["counter"]) == (session, counter):
            return heard if heard["refusal"] in ("none", "claim_again") else sys.exit(f"{opcode} is refused: {heard['refusal']}")
    sys.exit(f"{opcode}: no answer")


def claim():
    """The session under which to command. The board first wants its own random number repeated."""
    return command("lease", command("lease")["granted"])["granted"]


if __name__ == "__main__":
    filters = [{"can_id": frame_id, "can_mask": 0x7FF, "extended": False} for frame_id in OURS]
    with can.Bus(can_filters=filters, **dict(word.split("=") for word in sys.argv[1:])) as bus:
        session = claim()
        command("arm")
        time.sleep(0.2)  # a probe measures the heater
        for i in range(200):
            command("position", 0.005)  # expires after 250 ms unless repeated
            if i % 20 == 19:
                print(f"{signals['position_m']} m, {signals['hottest_C']} °C at most", flush=True)
            time.sleep(0.05)
        command("disarm")
        command("lease", -1.0)
