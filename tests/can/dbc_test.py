"""supercoil dbc: the DBC of a bus is that of node 1, once for each node."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import cantools

DBC = pathlib.Path(__file__).resolve().parents[2] / "firmware" / "io" / "can" / "supercoil.dbc"
PAGE = DBC.parents[3] / "docs" / "can.md"


def dbc(*arguments):
    return subprocess.run([os.environ["SUPERCOIL"], "dbc", *map(str, arguments)], capture_output=True, text=True)


def signal_of(signal):
    return (signal.name, signal.start, signal.length, signal.is_signed, signal.is_float, signal.scale, signal.minimum,
            signal.maximum, signal.unit, signal.comment, signal.choices, signal.multiplexer_ids, signal.is_multiplexer)


class Dbc(unittest.TestCase):
    def test_without_nodes_it_is_the_committed_file(self):
        done = dbc()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, DBC.read_text())

    def test_every_node_has_every_message_with_its_attributes(self):
        nodes = [1, 2, 5, 63]
        alone = cantools.database.load_file(DBC)
        bus = cantools.database.load_string(dbc("--nodes", "1,2,5,63").stdout, "dbc")
        self.assertEqual(len(bus.messages), len(nodes) * len(alone.messages))
        self.assertEqual([node.name for node in bus.nodes], [f"Board_{node}" for node in nodes] + ["Master"])
        for message in alone.messages:
            for node in nodes:
                derived = bus.get_message_by_name(f"{message.name}_{node}")
                self.assertEqual(derived.frame_id, message.frame_id - 1 + node)
                self.assertEqual((derived.length, derived.comment, derived.cycle_time),
                                 (message.length, message.comment, message.cycle_time))
                self.assertEqual(derived.senders, [{"Board": f"Board_{node}"}.get(s, s) for s in message.senders])
                self.assertEqual([signal_of(s) for s in derived.signals], [signal_of(s) for s in message.signals])
        self.assertEqual(bus.dbc.attributes["ProtocolVersion"].value, alone.dbc.attributes["ProtocolVersion"].value)

    def test_documented_sed_removes_only_names_of_negative_values(self):
        command, = re.findall(r"^  supercoil dbc \| (sed .*) >strict.dbc$", PAGE.read_text(), re.M)
        strict = subprocess.run(["bash", "-c", command], input=dbc().stdout, capture_output=True, text=True,
                                check=True).stdout
        self.assertNotRegex(strict, r"(?m)^VAL_ .* -\d")
        read = (cantools.database.load_file(DBC).messages, cantools.database.load_string(strict, "dbc").messages)
        taken = 0
        for whole, less in zip(*read, strict=True):
            for signal, other in zip(whole.signals, less.signals, strict=True):
                if signal.choices and min(signal.choices) < 0:
                    lowest, = signal.choices
                    self.assertEqual((lowest, str(signal.choices[lowest])), (-2 ** (signal.length - 1), "not_available"))
                    signal.choices = None
                    taken += 1
                self.assertEqual(signal_of(other), signal_of(signal))
        self.assertEqual(taken, 19)

    def test_it_is_written_to_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bus.dbc"
            done = dbc("--nodes", "3", "--out", path)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            self.assertEqual(path.read_text(), dbc("--nodes", "3").stdout)
            self.assertEqual([p.name for p in pathlib.Path(folder).iterdir()], ["bus.dbc"])

    def test_invalid_nodes_are_rejected(self):
        for nodes, said in (("0", "1 to 63"), ("64", "1 to 63"), ("2,5,2", "2 is named twice"), ("x", "x")):
            done = dbc("--nodes", nodes)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
