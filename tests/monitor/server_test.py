"""The monitor's server as a page, a script or an attacker meets it.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import contextlib
import http.client
import json
import pathlib
import re
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time
import unittest

from programs import SLACK_S, SUPERCOIL, command, free_ports, monitor, until
from served import OnServedBoard, Served

# As the page says (page_timeout_s), and as a board of the bench lets a command expire.
PAGE_TIMEOUT_S = 1.5
NEED_A_VALUE = ("position", "power", "scale", "controller", "estimator", "store", "compare_supply", "compare_current",
                "compare_rise", "tune")


class Live(OnServedBoard):
    def arm(self, served):
        """Arms from any state."""
        served.command("disarm")
        served.command("reset")
        until(lambda: served.command("arm")[1] == {"refusal": "none"} or served.state()[0] == "armed", 30.0)
        until(lambda: served.state()[0] == "armed")

    def test_columns_of_a_message_are_aligned_and_ordered(self):
        served = self.serve()
        about = served.get("/api/about")[1]
        self.assertEqual((about["kind"], about["may_command"], about["protocol"]["Power"]["applied_W"]["unit"]),
                         ("live", False, "W"))
        self.assertEqual([about["protocol"]["Emergency"][signal]["digits"] for signal in ("fault", "board_time_s")], [8, 15])
        until(lambda: "Boot" in served.get("/api/history")[1]["nodes"]["1"])  # the rarest
        for message, columns in served.get("/api/history")[1]["nodes"]["1"].items():
            self.assertEqual(columns.keys() - {"time_s"}, about["protocol"][message].keys())
            self.assertEqual({len(column) for column in columns.values()}, {len(columns["time_s"])})
            self.assertEqual(columns["time_s"], sorted(columns["time_s"]))

    def test_commands_need_token_and_origin(self):
        served = self.serve()
        order = {"node": 1, "opcode": "renew", "value": 0}
        for wrong in ({"token": ""}, {"token": "0" * 32}, {"origin": "null"}, {"origin": "http://example.org"},
                      {"origin": f"http://127.0.0.1:{served.port + 1}"}):
            for path in ("/api/command", "/api/alive"):
                self.assertEqual(served.post(path, order, **wrong)[0], 403, (path, wrong))
        self.assertEqual(served.post("/stop", "", served.stop_port(), origin="http://example.org")[0], 403)
        self.assertEqual(served.post("/api/command", order)[0], 200)
        # A name that somebody else's DNS directs here.
        self.assertEqual(served.request("GET", "/api/history", Host="example.org")[0], 403)
        self.assertEqual(served.request("GET", "/api/about", Host=f"localhost:{served.port}")[0], 200)

    def test_a_script_needs_only_the_token(self):
        served = self.serve()
        self.arm(served)
        order = json.dumps({"node": 1, "opcode": "arm"})
        bearer = {"Authorization": f"Bearer {served.token}"}
        # Any program on this machine may stop it, but no page of another server.
        for browser in ({"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}):
            self.assertEqual(served.request("POST", "/stop", "", served.stop_port(), **browser)[0], 403, browser)
        self.assertEqual(served.request("POST", "/stop", "", served.stop_port())[0], 200)
        until(lambda: served.state()[0] == "disarmed")
        for wrong in ({}, {"Authorization": "Bearer " + "0" * 32}, {"Authorization": served.token},
                      {"X-Supercoil-Token": "0" * 32}, {**bearer, "Origin": "http://example.org"}, {**bearer, "Origin": "null"},
                      {**bearer, "Sec-Fetch-Site": "cross-site"},
                      {**bearer, "Host": "example.org"}):
            self.assertEqual(served.request("POST", "/api/command", order, **wrong)[0], 403, wrong)
        # A token in an address ends up in logs and histories: it allows watching only.
        status, said = served.request("POST", f"/api/command?token={served.token}", order)
        self.assertEqual(status, 403)
        self.assertIn("Authorization: Bearer TOKEN", said)
        self.assertEqual(served.state()[0], "disarmed")
        self.assertEqual(served.request("POST", "/api/command", order, **bearer)[0], 200)
        until(lambda: served.state()[0] == "armed")

    def test_invalid_requests_are_rejected(self):
        served = self.serve()
        for wrong in ("", "{", "[]", "7", "null", '{"node":0}', '{"node":64,"opcode":"arm"}', '{"node":1}',
                      '{"node":1,"opcode":"claim"}', '{"node":1,"opcode":"none"}', '{"node":1.5,"opcode":"arm"}',
                      '{"node":"1","opcode":"arm"}', '{"node":1,"opcode":"power","value":"x"}',
                      *(f'{{"node":1,"opcode":"{opcode}"}}' for opcode in NEED_A_VALUE),
                      '{"node":1,"opcode":"power","value":1e999}', '{"node":1,"opcode":7}', "\xff\x00", "[" * 4000):
            status, answer = served.post("/api/command", wrong)
            self.assertEqual((status, list(answer)), (400, ["error"]), wrong)
            if not wrong.startswith('{"'):
                self.assertIn("must be a JSON object", answer["error"])
        said = served.post("/api/command", '{"node":1,"opcode":"store"}')[1]["error"]
        self.assertEqual(said, "store needs a value: 1 stores the muscle, 0 clears it, 2 stores the tuning, 3 clears it")
        said = served.post("/api/command", '{"node":1,"opcode":"power","value":-1}')
        self.assertEqual(said, (400, {"error": "power must be 0 W or more"}))
        for path in ("/api/history?from_s=x", "/api/history?to_s=1e300", "/api/history?from_s=nan"):
            self.assertEqual(served.get(path)[0], 400, path)
        self.assertEqual(served.get("/api/fault/no_such")[0], 404)
        self.assertIn("heater", served.request("GET", "/api/fault/heater_open")[1])

    def test_a_muscle_moves_only_while_a_page_is_alive(self):
        served = self.serve()
        for _ in range(3):
            reason, lasted_s = self.move_and_leave(served)
            if "the board let it go" not in reason:
                break
            print("this machine stalled for longer than a command lasts: once more")
        self.assertIn("no page was alive", reason)
        self.assertGreater(lasted_s, PAGE_TIMEOUT_S / 2)
        until(lambda: served.state()[1] == 0.0)

    def move_and_leave(self, served):
        """Why the muscle cooled, and how long after the page's last message."""
        self.arm(served)
        # Busy while the probe of arming runs.
        until(lambda: served.command("position", 0.004) == (200, {"refusal": "none"}))
        end_s = time.monotonic() + 2 * PAGE_TIMEOUT_S
        while time.monotonic() < end_s and served.post("/api/alive", {"node": 1})[1]["holding"]:
            time.sleep(0.2)
        lost_s = time.monotonic()
        until(lambda: served.state()[0] == "fault")
        lasted_s = time.monotonic() - lost_s
        until(lambda: not served.post("/api/alive", {"node": 1})[1]["holding"])
        return served.post("/api/alive", {"node": 1})[1]["reason"], lasted_s

    def test_stop_works_however_busy_the_page_is(self):
        served = self.serve()
        stop_port = served.stop_port()
        self.arm(served)
        with contextlib.ExitStack() as crowd:
            def one_more():
                return crowd.enter_context(served.open_stream()).recv(12) == b"HTTP/1.1 200"

            # Streams of pages that have just gone count for a moment.
            for _ in range(24):
                until(one_more)
            until(lambda: not one_more())
            # These say nothing and stay, so that nobody is left to serve the page.
            for _ in range(64):
                crowd.enter_context(socket.create_connection(("127.0.0.1", served.port)))
            begin_s = time.monotonic()
            self.assertEqual(served.post("/stop", "", stop_port)[1], {"nodes": [1]})
            self.assertLess(time.monotonic() - begin_s, 1.0)
        until(lambda: served.state() == ("disarmed", 0.0))

    def test_read_only_serves_no_stop_and_no_command(self):
        program = monitor(self.source, "--read-only")
        self.addCleanup(program.stop)
        self.assertIsNone(program.found[2])
        served = Served(program)
        self.assertEqual(served.stop_port(), 0)
        self.assertEqual(served.command("renew")[0], 403)

    def test_other_machines_need_the_token(self):
        program = monitor(self.source, "--listen", "0.0.0.0")
        self.addCleanup(program.stop)
        served = Served(program)
        self.assertEqual(served.get("/api/about")[0], 403)
        self.assertEqual(served.get("/api/history?token=" + "0" * 32)[0], 403)
        status, about = served.get("/api/about", **{"X-Supercoil-Token": served.token})
        self.assertEqual((status, about["may_command"]), (200, True))
        self.assertEqual(served.get(f"/api/history?token={served.token}")[0], 200)
        # Its page may post there, under whatever name others know this machine by.
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", served.port)) as connection:
            connection.request("GET", "/")
            self.assertIn(f"http://*:{about['stop_port']};", connection.getresponse().headers["Content-Security-Policy"])
        self.assertEqual(served.post("/stop", "", about["stop_port"], token="")[0], 403)
        self.assertEqual(served.post("/stop", served.token, about["stop_port"])[0], 200)

    def test_it_ends_at_once_with_open_pages(self):
        program = monitor(self.source)
        with Served(program).open_stream():
            program.process.send_signal(signal.SIGTERM)
            self.assertEqual(program.process.wait(SLACK_S), 0)
        program.stop()

    def test_a_port_in_use_is_named(self):
        served = self.serve()
        done = subprocess.run([SUPERCOIL, "monitor", self.source, "--port", str(served.port)], capture_output=True,
                              text=True, timeout=SLACK_S)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(f"port {served.port} of 127.0.0.1 is not available", done.stderr)

    def test_a_second_master_on_the_bus_is_refused(self):
        served = self.serve()
        self.arm(served)
        self.assertEqual(served.command("rest")[0], 200)
        refused = command(self.source, "1", "position", "0.002", "--json")
        self.assertEqual((refused.returncode, json.loads(refused.stdout)),
                         (1, {"command": "1 position 0.002", "answer": "refused: not_lease_holder"}))
        until(lambda: command(self.source, "1", "power", "0.1").returncode == 0)
        until(lambda: served.state()[0] == "fault")
        self.assertEqual(command(self.source, "1", "reset").returncode, 0)
        self.arm(served)
        time.sleep(1.5)  # the lease of the page runs out
        held = subprocess.Popen([SUPERCOIL, "command", "1", "position", "0.003", "--hold", "--can", self.source])
        until(lambda: served.state()[0] == "active")
        time.sleep(1.0)
        self.assertEqual(served.state()[0], "active")
        held.send_signal(signal.SIGINT)
        self.assertEqual(held.wait(SLACK_S), 0)
        until(lambda: served.state()[0] == "armed")
        self.assertIn("node 1: armed", command(self.source, "state").stdout)


class Sources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def run_monitor(self, source, *options):
        return subprocess.run([SUPERCOIL, "monitor", str(source), "--port", str(free_ports()), *options],
                              capture_output=True, text=True, timeout=SLACK_S)

    def test_invalid_sources_are_rejected(self):
        (self.path / "empty").touch()
        (self.path / "text").write_text("what is this\n")
        for source, why in ((self.path / "empty", "is empty"), (self.path / "text", "text:1: must begin with"),
                            (self.path, "is a folder"), ("no-such-can", "no CAN interface"),
                            ("no-such-can", "nor is there a log of that name"),
                            ("none.log", "supercoil: none.log: no such log\n"),
                            ("logs/none", "logs/none: no such log\n"),
                            ("socketcand:", "must be socketcand:"), ("socketcand:70000", "must be socketcand:"),
                            (f"socketcand:{free_ports()}", "refused")):
            done = self.run_monitor(source)
            self.assertEqual((done.returncode, done.stdout), (2, ""), source)
            self.assertIn(why, done.stderr)

    def test_an_ipv6_address_is_refused(self):
        log = self.path / "can.log"
        log.write_text("(0000000001.000000) can0 281#0A000000000000FF\n")
        for address in ("::1", "::", "[::1]"):
            done = self.run_monitor(log, "--listen", address)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (
                2, "", f"supercoil: --listen {address}: must be an IPv4 address or a name, such as 0.0.0.0\n"))

    def test_a_log_whose_time_goes_back_is_reported(self):
        log = self.path / "two.log"
        log.write_text("(0000000009.500000) can0 281#0A000000000000FF\n(0000000009.499000) can0 281#0A000000000000FF\n"
                       "(0000000001.000000) can0 281#0A000000000000FF\n(0000000000.100000) can0 281#0A000000000000FF\n")
        done = self.run_monitor(log, "--text")
        self.assertEqual((done.returncode, done.stderr), (0, f"supercoil: {log}:3: is 8.499 s before the line before it; what "
                                                             "follows is shown at one time: split the log there\n"))

    def test_a_peer_that_is_not_socketcand_is_reported(self):
        def greet(client):
            client.send(b"< hi >")
            client.recv(100)
            time.sleep(2.5)  # longer than a first try

        silent = "accepted the connection but did not send '< hi >' in time: it is stopped or busy, or not a socketcand server"
        for act, why in ((None, silent), (lambda client: None, "closed the connection"),
                         (greet, "did not answer '< open can0 >' in time: it is stopped or busy")):
            with socket.create_server(("127.0.0.1", 0)) as other:
                def serve(act=act, other=other):
                    with other.accept()[0] as client:
                        act(client)

                if act:
                    threading.Thread(target=serve, daemon=True).start()
                source = f"socketcand:{other.getsockname()[1]}"
                done = self.run_monitor(source)
            self.assertEqual((done.returncode, done.stderr), (2, f"supercoil: {source}: {why}\n"))

    def test_damaged_log_lines_are_skipped(self):
        log = self.path / "can.log"
        log.write_text("(0000000001.000000) can0 281#0A000000000000FF\n(0000000001.01\n"
                       "(0000000001.500000) can0 00000281#00\n(0000000002.000000) can0 301#00\n"
                       "(0000000003.000000) can0 281#140000000000FFFF\n")
        program = subprocess.Popen([SUPERCOIL, "monitor", log, "--port", str(free_ports())], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(program.stderr.close)
        self.addCleanup(program.stdout.close)
        self.addCleanup(program.wait)
        self.addCleanup(program.terminate)
        self.assertIn("can.log:2: must begin with (SECONDS.MICROSECONDS); 1 such line is skipped",
                      program.stderr.readline())
        port = int(program.stdout.readline().rsplit(":", 1)[1].strip("/\n"))
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=SLACK_S)
        self.addCleanup(connection.close)
        connection.request("GET", "/api/history")
        batch = json.loads(connection.getresponse().read())
        self.assertEqual(batch["nodes"], {"1": {"Measurement": {
            "time_s": [1, 3], "position_m": [1e-6, 2e-6], "resistance_Ohm": [0, 0],
            "resistance_age_s": [652.8, None]}}})

    def test_text_shows_a_log_once(self):
        log = self.path / "can.log"
        log.write_text("(0000000001.000000) can0 281#102700000000FFFF\n(0000000001.000000) can0 701#02000000FF000102\n")
        done = subprocess.run([SUPERCOIL, "monitor", log, "--text"], capture_output=True, text=True, timeout=SLACK_S)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("off", done.stdout)
        self.assertIn("node 1: active, rest, last identification or calibration: found", done.stdout)
        self.assertRegex(done.stdout, r"position\s+1\.000 mm")
        self.assertRegex(done.stdout, r"\n  it speaks version 1 of the protocol, this program \d+: numbers may be wrong")
        own = re.search(r"this program (\d+)", done.stdout)[1]
        log.write_text(f"(0000000001.000000) can0 701#02000000FF00{int(own):02X}02\n")
        done = subprocess.run([SUPERCOIL, "monitor", log, "--text"], capture_output=True, text=True, timeout=SLACK_S)
        self.assertNotIn("version", done.stdout)

    def test_text_that_cannot_be_written_is_an_error(self):
        log = self.path / "can.log"
        log.write_text("(0000000001.000000) can0 281#102700000000FFFF\n")
        with open("/dev/full", "w") as full:
            done = subprocess.run([SUPERCOIL, "monitor", log, "--text"], stdout=full, stderr=subprocess.PIPE, text=True,
                                  timeout=SLACK_S)
        self.assertEqual((done.returncode, done.stderr), (1, "supercoil: cannot write to standard output\n"))

    def test_text_shows_the_boards_program_version(self):
        log = self.path / "can.log"

        def text_of(boot):
            log.write_text(f"(0000000001.000000) can0 701#0000000000000500\n(0000000001.100000) can0 741#{boot}\n")
            return subprocess.run([SUPERCOIL, "monitor", log, "--text"], capture_output=True, text=True, timeout=SLACK_S).stdout

        self.assertIn("\n  program 0.2.1 (080ebf0)\n", text_of("00020100F0EB8000"))
        self.assertIn("\n  program 1.0.0\n", text_of("0100000000000000"))

    def test_text_shows_a_faults_margin_and_a_disabled_proof(self):
        log = self.path / "can.log"
        cause = struct.pack("<ff", 0.0008, 0.00267).hex()

        def text_of(*frames):
            log.write_text("".join(f"({time_s:017.6f}) can0 {frame}\n" for time_s, frame in frames))
            return subprocess.run([SUPERCOIL, "monitor", log, "--text"], capture_output=True, text=True, timeout=SLACK_S).stdout

        tripped = ((1, "081#1703000000000000"), (1, f"0C1#{cause}"))
        text = text_of(*tripped, (61, "701#0317000000000410"))
        self.assertIn(", FAULT heater_not_responding (measured 0.0008, limit 0.00267 m)", text)
        self.assertIn("proof of response (proof_of_response is false, or this muscle is one of a joint's two or follows in a bundle)", text)
        text = text_of(*tripped, (60, "081#1E03000000000000"), (61, "701#031E000000000400"))
        self.assertIn(", FAULT over_temperature\n", text)
        self.assertNotIn("proof_of_response", text)

    def test_text_shows_a_slack_muscle(self):
        log = self.path / "can.log"
        for flags, expected in (("80", True), ("10", False)):
            log.write_text(f"(0000000001.000000) can0 701#02000000FF0004{flags}\n")
            done = subprocess.run([SUPERCOIL, "monitor", log, "--text"], capture_output=True, text=True, timeout=SLACK_S)
            self.assertEqual("\n  according to its model this muscle is slack at the present joint angle\n" in done.stdout, expected)

    def test_text_shows_the_hottest_temperature_when_off(self):
        log = self.path / "can.log"
        for state, word in enumerate(("disarmed", "armed", "fault")):
            for hottest, said in (("2620", "off; may still be at 83 C"), ("820a", "off; at most 27 C"),
                                  ("0080", "off; temperature not known")):
                number = 3 if word == "fault" else state
                log.write_text(f"(0000000001.000000) can0 381#D007{hottest}\n"
                               f"(0000000001.000000) can0 701#{number:02X}00000000000302\n")
                done = subprocess.run([SUPERCOIL, "monitor", log, "--text"], capture_output=True, text=True, timeout=SLACK_S)
                self.assertIn(f"node 1: {word}, rest, {said}", done.stdout)
                self.assertNotIn("cold,", done.stdout)


if __name__ == "__main__":
    unittest.main()
