"""A master that knows only docs/can-protocol.md moves the simulated board's muscle: its tables, rules and frames are enough."""

import pathlib
import re
import struct
import tempfile
import time
import unittest

import can

from live import DEADLINE_S, Simulator, join

PAGE = (pathlib.Path(__file__).resolve().parents[2] / "docs/can-protocol.md").read_text()
NODE = 1


def rows(heading):
    """The cells of the first table below a heading, without its own two lines."""
    lines = PAGE.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0].splitlines()
    return [[cell.strip().strip("`") for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")][2:]


class Message:
    def __init__(self, name):
        self.name = name
        self.identifier = int(re.search(rf"\| (0x\w+) \+ node \| \[{name}\]", PAGE)[1], 16) + NODE
        self.length = int(re.search(rf"\n## {name}\n\n0x\w+ \+ node, (\d) bytes", PAGE)[1])
        self.signals = {}
        for signal, bits, raw, scale, *_ in rows(name):
            first, last = re.fullmatch(r"(\d+)(?: to (\d+))?", bits).groups()
            self.signals[signal] = (int(first), int(last or first) - int(first) + 1, raw, float(scale or 1))

    def encode(self, **values):
        number = 0
        for signal, value in values.items():
            first, _, raw, _ = self.signals[signal]
            number |= (struct.unpack("<I", struct.pack("<f", value))[0] if raw == "float" else value) << first
        return protected(self.identifier, number.to_bytes(self.length, "little"))

    def decode(self, data):
        number, values = int.from_bytes(data, "little"), {}
        for signal, (first, bits, raw, scale) in self.signals.items():
            value = number >> first & (1 << bits) - 1
            if raw == "float":
                values[signal] = struct.unpack("<f", struct.pack("<I", value))[0]
            else:
                values[signal] = (value - (raw[0] == "i" and value >> bits - 1) * (1 << bits)) * scale
        return values


def crc8h2f(data):
    polynomial, start, final = (int(number, 16) for number in
                                re.search(r"polynomial (0x\w\w), start (0x\w\w), final XOR (0x\w\w), nothing reflected", PAGE).groups())
    crc = start
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (polynomial if crc & 0x80 else 0)) & 0xFF
    return crc ^ final


def protected(identifier, data):
    return bytes([crc8h2f(data[1:] + bytes([identifier & 0xFF]))]) + data[1:]


def names(title):
    return {name: int(raw) for raw, name in rows(f"Names of {title}")}


COMMAND, ACKNOWLEDGE, REFUSED = Message("Command"), Message("Acknowledge"), Message("RefusedValue")
MEASUREMENT, STATUS = Message("Measurement"), Message("Status")
OPCODES, REFUSALS, STATES = names("opcode"), names("refusal"), names("state")


class Commander:
    """A session as the page describes it."""

    def __init__(self, bus):
        self.bus, self.counter, self.session = bus, 0, 0x1234

    def send(self, data):
        self.bus.send(can.Message(arbitration_id=COMMAND.identifier, data=data, is_extended_id=False))

    def receive(self, message, wanted=lambda values: True):
        end = time.monotonic() + DEADLINE_S
        while time.monotonic() < end:
            frame = self.bus.recv(DEADLINE_S)
            if frame is not None and frame.arbitration_id == message.identifier and wanted(values := message.decode(frame.data)):
                return values
        raise AssertionError(f"no such {message.name}")

    def request(self, opcode, value=0.0):
        self.counter = (self.counter + 1) % 16
        self.send(COMMAND.encode(counter=self.counter, opcode=OPCODES[opcode], session=self.session, value=value))
        mine = {"counter": self.counter, "opcode": OPCODES[opcode], "session": self.session}
        answer = self.receive(ACKNOWLEDGE, lambda values: mine.items() <= values.items())
        return next(name for name, number in REFUSALS.items() if number == answer["refusal"]), int(answer["granted"])

    def claim(self):
        refusal, number = self.request("lease")
        if refusal == "claim_again":
            refusal, number = self.request("lease", float(number))
        if refusal == "none":
            self.session = number
        return refusal


class CommanderFromDocumentation(unittest.TestCase):
    def test_checksum_has_the_check_value(self):
        self.assertEqual(crc8h2f(b"123456789"), int(re.search(r"`123456789` it is (0x\w\w)", PAGE)[1], 16))

    def test_example_session_matches_the_documented_rules(self):
        counter, session = 0, 0x1234
        for sender, what, identifier, data in rows("A session"):
            with self.subTest(what):
                message = COMMAND if sender == "master" else ACKNOWLEDGE
                self.assertEqual(int(identifier, 16), message.identifier)
                data = bytes.fromhex(data)
                self.assertEqual(len(data), message.length)
                self.assertEqual(data, protected(message.identifier, data))
                values = message.decode(data)
                if sender == "master":
                    counter = (counter + 1) % 16
                    opcode, value = re.match(r"(\w+)`?(?: (-?[\d.]+))?", what.strip("`")).groups()
                    self.assertEqual(data, message.encode(counter=counter, opcode=OPCODES[opcode], session=session,
                                                          value=float(value or 0)))
                else:
                    self.assertIn(next(name for name, number in REFUSALS.items() if number == values["refusal"]), what)
                    if values["refusal"] == 0 and values["granted"]:
                        session = int(values["granted"])
                self.assertEqual(values["counter"], counter)

    def test_moves_the_muscle(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        simulator = Simulator(folder.name)
        self.addCleanup(simulator.end)
        bus = join(simulator.port)
        self.addCleanup(bus.shutdown)
        master = Commander(bus)
        # A machine that stops this program for a second ends its lease; then it begins again.
        for _ in range(5):
            if self.session_of(master):
                break
            master.request("disarm")
        else:
            self.fail("the lease ended in each of five tries")
        self.assertEqual(master.request("disarm")[0], "none")
        self.wait_for_state(master, "disarmed")
        self.assertEqual(master.request("lease", -1.0)[0], "none")
        self.assertEqual(master.request("arm")[0], "no_lease")

    def session_of(self, master):
        """False: the lease, or a command to heat, ended before its time."""
        if master.claim() != "none":
            return False
        self.wait_for_state(master, "disarmed")
        for opcode in ("arm", "calibrate"):
            refusal, _ = master.request(opcode, 1.0)
            if refusal != "out_of_range":
                return False
            refused = master.receive(REFUSED)
            self.assertEqual((refused["value"], refused["nearest"]), (1.0, 0.0))
        # Until it must have cooled from before.
        if self.request_until(master, "arm", 0.0, {"not_ready"}, lambda refusal: refusal == "none"):
            def there(_):
                return abs(master.receive(MEASUREMENT)["position_m"] - 0.005) < 2e-4

            return self.request_until(master, "position", 0.005, {"none", "busy"}, there) and master.request("rest")[0] == "none"
        return False

    def request_until(self, master, opcode, value, bearable, done):
        """Repeats about every 10 ms; False when it was refused for a reason that is not bearable."""
        end = time.monotonic() + DEADLINE_S
        while time.monotonic() < end:
            refusal, _ = master.request(opcode, value)
            if done(refusal):
                return True
            if refusal not in bearable:
                return False
            master.receive(MEASUREMENT)
        self.fail(f"{opcode} did not come to its end")

    def wait_for_state(self, master, name):
        master.receive(STATUS, lambda values: values["state"] == STATES[name])


if __name__ == "__main__":
    unittest.main()
