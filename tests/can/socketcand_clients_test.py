"""Programs that do to the simulated board's bus what they should not, and what a user of --can gets wrong."""

import contextlib
import json
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import threading
import time
import unittest

from live import DEADLINE_S, Master, Simulator

MOST_CLIENTS = 32
GARBAGE = b"\x00\xff<<>< send 201 8 <\n< send 201 8 zz >< echo" + bytes(range(256)) + b" >"
FLOOD = b"< send 7ff 0 >" * 4096


class Client:
    """A client that speaks the protocol by hand."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=DEADLINE_S)
        self.received = b""

    def send(self, text):
        self.socket.sendall(text if isinstance(text, bytes) else text.encode())

    def element(self):
        """The next one; empty: the simulator has closed."""
        while b">" not in self.received:
            more = self.socket.recv(65536)
            if not more:
                return ""
            self.received += more
        element, self.received = self.received.split(b">", 1)
        return element.decode("latin-1").strip("< ")

    def request(self, text):
        self.send(text)
        return self.element()

    def opened(self):
        assert (self.element(), self.request("< open can0 >")) == ("hi", "ok")
        return self

    def skip_to(self, text):
        while (element := self.element()) != text:
            if not element:
                raise AssertionError(f"closed before {text}")


class HostileClients(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.simulator = Simulator(folder.name)
        self.addCleanup(self.simulator.end)

    def client(self):
        client = Client(self.simulator.port)
        self.addCleanup(client.socket.close)
        return client

    def assert_goes_on(self):
        """A program that joins now hears the board, without a frame lost."""
        master = Master(self.simulator.port)
        counters = [master.receive_next("Status").signals["counter"] for _ in range(3)]
        master.bus.shutdown()
        self.assertEqual([(counter - counters[0]) % 256 for counter in counters], [0, 1, 2])

    def test_garbage_is_skipped(self):
        client = self.client().opened()
        client.send(GARBAGE * 20)
        client.send("> < echo still here >")
        client.skip_to("echo still here")
        self.assert_goes_on()

    def test_a_partial_element_waits_for_its_rest(self):
        client = self.client().opened()
        client.send("< ec")
        self.assert_goes_on()
        self.assertEqual(client.request("ho halves >"), "echo halves")

    def test_a_client_may_disconnect_within_an_element(self):
        client = self.client().opened()
        client.send("< send 201 8 1 2")
        client.socket.close()
        self.assert_goes_on()

    def test_an_endless_element_is_skipped(self):
        client = self.client().opened()
        client.send(b"<" + b"x" * (1 << 20))
        self.assert_goes_on()
        self.assertEqual(client.request("< echo still here >"), "echo still here")

    def test_only_classical_standard_frames_are_accepted(self):
        client = self.client().opened()
        listener = self.client().opened()
        self.assertEqual(listener.request("< rawmode >"), "ok")
        for text in ("< send 00000201 1 0 >", "< send 1FFFFFFF 0 >", "< send 800 0 >", "< send 123 9 1 1 1 1 1 1 1 1 1 >",
                     "< send 123 2 1 >", "< send 123 1 100 >", "< add 0 0 123 1 0 >"):
            self.assertIn("error unknown command", client.request(text), text)
        client.send("< send 7FE 1 5A >")
        element = ""
        while not element.startswith("frame 7FE"):
            element = listener.element()
            self.assertRegex(element, r"^frame (081|241|2[8C]1|3[048C]1|4[048C]1|701|7FE) ")
        self.assertTrue(element.endswith(" 5A"))

    def test_a_bus_must_be_opened_by_its_name(self):
        client = self.client()
        self.assertEqual(client.element(), "hi")
        self.assertEqual(client.request("< rawmode >"), "error open a bus first")
        self.assertEqual(client.request("< send 123 0 >"), "error open a bus first")
        self.assertEqual(client.request("< open can1 >"), "error could not open bus: there is can0")

    def test_a_client_that_never_reads_is_disconnected(self):
        deaf, listener, loud = (self.client().opened() for _ in range(3))
        for client in (deaf, listener):
            self.assertEqual(client.request("< rawmode >"), "ok")
        statuses, ended = [], threading.Event()

        def listen():
            while not ended.is_set():
                element = listener.element()
                if element.startswith("frame 701 "):
                    statuses.append(int(element[-6:-4], 16))
        listening = threading.Thread(target=listen, daemon=True)
        listening.start()
        # This is more than the kernel holds for a connection and the simulator's mebibyte.
        for _ in range(100):
            loud.send(FLOOD)
        self.assertEqual(loud.request("< echo done >"), "echo done")
        received_bytes, more, end = 0, b"some", time.monotonic() + DEADLINE_S / 4
        with contextlib.suppress(ConnectionResetError):
            while more and time.monotonic() < end:
                more = deaf.socket.recv(1 << 20)
                received_bytes += len(more)
            self.assertEqual(more, b"", "not cut off")
        ended.set()
        listening.join()
        self.assertGreater(received_bytes, 1 << 16)
        self.assertGreater(len(statuses), 3)
        self.assertEqual(statuses, [(statuses[0] + i) % 256 for i in range(len(statuses))])
        self.assert_goes_on()

    def test_a_board_with_a_lagging_clock_is_still_shown(self):
        self.simulator.process.send_signal(signal.SIGSTOP)
        time.sleep(5.0)  # the board's time stands still, this machine's does not
        self.simulator.process.send_signal(signal.SIGCONT)
        for _ in range(5):  # it asks for the controller meanwhile, which the others on the bus hear at that time or a moment later
            state = subprocess.run([os.environ["SUPERCOIL"], "command", "state", "--can", f"socketcand:{self.simulator.port}"],
                                  capture_output=True, text=True, timeout=DEADLINE_S)
            self.assertRegex(state.stdout, r"node 1: disarmed, rest, \w+ \(controller 0\), off; at most")
            self.assertRegex(state.stdout, r"position +-?\d")

    def test_the_number_of_clients_is_limited(self):
        clients = [self.client() for _ in range(40)]
        greeted = [client.element() == "hi" for client in clients]
        self.assertEqual(sum(greeted), MOST_CLIENTS)
        clients[greeted.index(True)].socket.close()
        self.assert_goes_on()


class SilentBoard(unittest.TestCase):
    def test_the_monitor_says_that_its_values_are_old(self):
        with tempfile.TemporaryDirectory() as folder:
            simulator = Simulator(folder)
            self.addCleanup(simulator.end)
            monitor = subprocess.Popen([os.environ["SUPERCOIL"], "monitor", "--text", f"socketcand:{simulator.port}"],
                                       stdout=subprocess.PIPE, text=True)
            self.addCleanup(monitor.communicate)
            self.addCleanup(monitor.kill)
            while not monitor.stdout.readline().startswith("node 1: disarmed"):
                self.assertIsNone(monitor.poll())
            simulator.process.send_signal(signal.SIGSTOP)
            self.addCleanup(simulator.process.send_signal, signal.SIGCONT)
            while not (line := monitor.stdout.readline()).startswith("SILENT"):
                self.assertIsNone(monitor.poll())
            self.assertRegex(line, r"^SILENT: no frames for \d+ s; older values follow\n$")


class Usage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def assert_wrong(self, *options):
        """Exits with 2 and writes nothing; returns what it says."""
        done = subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "bench", *options, "--out", "out"], cwd=self.path,
                              capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(list(self.path.iterdir()), [])
        return done.stderr

    def test_a_port_in_use_is_named(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            self.assertEqual(self.assert_wrong("--real-time", "--can", f"socketcand:{port}"),
                             f"supercoil-sim: socketcand: port {port} of loopback: Address already in use\n")

    def test_an_invalid_bus_is_rejected(self):
        for bus in ("nonsense", "socketcand", "socketcand:", "socketcand:65536", "socketcand:-1", "socketcand:1x", "can0"):
            self.assertIn(f"--can: {bus}: must be socketcand:PORT", self.assert_wrong("--real-time", "--can", bus))
        self.assertIn("--real-time", self.assert_wrong("--can", "socketcand:0"))

    def test_an_interrupt_ends_it_normally(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            simulator = Simulator(self.path)
            self.assertEqual(simulator.end(how), 0)
            summary = json.loads((self.path / "out/summary.json").read_text())
            self.assertEqual((summary["scenario"], summary["faults"]), ("bench", []))


if __name__ == "__main__":
    unittest.main()
