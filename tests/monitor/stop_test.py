"""STOP while somebody tries to block it, or nothing answers: its port as a program meets it, and the page in a real browser.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import contextlib
import http.server
import os
import pathlib
import resource
import signal
import socket
import threading
import time
import unittest

from page_test import READY_S, TARGET_MM, PageCase
from programs import OnSimulatedBoard, SLACK_S, monitor, simulated_board, trickle, until
from served import Served

# The monitor hears STOP and the commands of this page, and never says anything to them.
HEARS_NO_STOP = """const asked = window.fetch;
    window.fetch = (address, options) => !/[/]stop$|[/]api[/]command/.test(address) ? asked(address, options)
        : new Promise((_, fail) => options.signal?.addEventListener("abort", () => fail(options.signal.reason)))"""

# In their order. The browser's log has no start: between a look at it and the key a renewal may pass.
REMEMBERS_REQUESTS = """const asks = window.fetch;
    window.asked = [];
    window.fetch = (address, options) => (window.asked.push(String(address)), asks(address, options));"""


class StopPort(OnSimulatedBoard):
    def serve(self, board=None, **options):
        program = monitor(f"socketcand:{(board or self.board).found[1]}", **options)
        self.addCleanup(program.stop)
        served = Served(program)
        served.process = program.process
        until(lambda: "1" in served.get("/api/history")[1]["nodes"])
        return served

    def crowd(self, port, count, text):
        connections = self.enterContext(contextlib.ExitStack())
        for _ in range(count):
            connection = connections.enter_context(socket.create_connection(("127.0.0.1", port), timeout=SLACK_S))
            connection.sendall(text)
            yield connection

    def test_unfinished_requests_are_closed(self):
        served = self.serve()
        for text in (b"", b"POST /stop HTTP/1.1\r\nContent-Length: 4\r\n\r\nabc"):
            for connection in self.crowd(served.stop_port(), 2, text):
                with contextlib.suppress(ConnectionResetError):
                    self.assertEqual(connection.recv(64), b"", text)

    def test_stop_works_despite_many_unfinished_requests(self):
        served = self.serve()
        stop_port = served.stop_port()
        for text in (b"", b"P", b"POST /stop HTTP/1.1\r\nX: " + 4000 * b"x"):
            list(self.crowd(stop_port, 400, text))
            self.assertEqual(served.post("/stop", "", stop_port), (200, {"nodes": [1]}))

    def test_at_most_256_connections_are_open(self):
        served = self.serve()
        stop_port = served.stop_port()
        files = pathlib.Path(f"/proc/{served.process.pid}/fd")
        before = len(list(files.iterdir()))
        self.addCleanup(trickle(stop_port).stop)
        most = max(len(list(files.iterdir())) for _ in range(300))
        print(f"{most - before} connections at most")
        self.assertLessEqual(most - before, 256 + 8)
        self.assertEqual(served.post("/stop", "", stop_port), (200, {"nodes": [1]}))

    @unittest.skipUnless(os.getpriority(os.PRIO_PROCESS, 0) < 0, "this user may not have precedence")
    def test_the_two_stop_threads_have_priority(self):
        served = self.serve(prepare=lambda: os.setpriority(os.PRIO_PROCESS, 0, 0))
        threads = [int(task.name) for task in pathlib.Path(f"/proc/{served.process.pid}/task").iterdir()]
        nice = sorted(os.getpriority(os.PRIO_PROCESS, thread) for thread in threads)
        self.assertEqual(nice, [-10, -10] + (len(nice) - 2) * [0])

    def test_other_requests_are_refused(self):
        served = self.serve()
        stop_port = served.stop_port()
        self.assertEqual(served.request("GET", "/stop", port=stop_port)[0], 404)
        self.assertEqual(served.post("/", "", stop_port)[0], 404)
        self.assertEqual(served.post("/stop", "", stop_port, origin=f"http://127.0.0.1:{stop_port}")[0], 403)
        for text in (b"\0\xff\r\n\r\n", b"POST /stop HTTP/1.1\r\nX: " + 20000 * b"x",
                     b"POST /stop HTTP/1.1\r\nContent-Length: 5000\r\n\r\n"):
            connection, = self.crowd(stop_port, 1, text)
            with contextlib.suppress(ConnectionResetError):
                self.assertEqual(connection.recv(64), b"", text)
        self.assertEqual(served.post("/stop", "", stop_port), (200, {"nodes": [1]}))

    def test_stop_works_when_the_page_exhausts_file_descriptors(self):
        served = self.serve(prepare=lambda: resource.setrlimit(
            resource.RLIMIT_NOFILE, (256, resource.getrlimit(resource.RLIMIT_NOFILE)[1])))
        stop_port = served.stop_port()
        self.addCleanup(trickle(served.port, 400).stop)
        self.assertEqual(served.post("/stop", "", stop_port), (200, {"nodes": [1]}))

    def test_stop_fails_for_a_node_that_does_not_confirm_it(self):
        board = simulated_board()
        self.addCleanup(board.stop)
        served = self.serve(board)
        stop_port = served.stop_port()
        os.kill(board.process.pid, signal.SIGSTOP)
        try:
            self.assertEqual(served.post("/stop", "", stop_port), (502, {"error": "node 1 did not confirm it"}))
        finally:
            os.kill(board.process.pid, signal.SIGCONT)
        until(lambda: served.post("/stop", "", stop_port) == (200, {"nodes": [1]}))

    def test_stop_does_not_wait_for_a_node_that_was_only_asked(self):
        served = self.serve()
        self.assertEqual(served.get("/api/tuning/63")[0], 504)
        self.assertEqual(list(served.get("/api/history")[1]["nodes"]), ["1"])
        self.assertEqual(served.post("/stop", "", served.stop_port()), (200, {"nodes": [1]}))

    def test_stop_works_after_a_bus_reconnection(self):
        board = simulated_board()
        self.addCleanup(board.stop)
        served = self.serve(board)
        stop_port = served.stop_port()
        self.assertEqual(served.post("/stop", "", stop_port), (200, {"nodes": [1]}))
        board.stop()
        self.addCleanup(simulated_board(board.found[1]).stop)
        self.assertEqual(served.post("/stop", "", stop_port), (200, {"nodes": [1]}))


class StopOnThePage(PageCase):
    def stop_often(self, page, act, times=5):
        """Every STOP is obeyed, and STOP's own port has answered: not always in time, as this machine does other work."""
        answered = 0
        for _ in range(times):
            print(f"off {page.stop_by(act, READY_S):.2f} s after the click, seen on the page")
            page.wait(page.stop_is_confirmed, READY_S, "stop is confirmed")
            answered += page.text("#stop-notice").startswith("stopped node")
        print(f"{answered} of {times} answered by STOP's own port within its deadline")
        self.assertGreater(answered, 0)

    def test_a_thousand_slow_connections_do_not_block_stop(self):
        page = self.page()
        crowd = trickle(page.stop_port())
        self.addCleanup(crowd.stop)
        self.stop_often(page, lambda: page.click("#stop"))

    def test_preconnections_of_another_page_do_not_delay_stop(self):
        page = self.page()
        links = "".join(f"<link rel=preconnect href=http://127.0.0.1:{page.stop_port()} {how}>"
                        for how in ("", "crossorigin", "crossorigin=use-credentials"))
        handler = type("Other", (http.server.BaseHTTPRequestHandler,), {
            "do_GET": lambda self: (self.send_response(200), self.send_header("Content-Type", "text/html"),
                                    self.end_headers(), self.wfile.write(links.encode())),
            "log_message": lambda *_: None})
        other = http.server.HTTPServer(("127.0.0.1", 0), handler)
        self.addCleanup(other.server_close)
        self.addCleanup(other.shutdown)
        threading.Thread(target=other.serve_forever, daemon=True).start()

        def stop_beside_it():
            ours = page.driver.current_window_handle
            page.driver.switch_to.new_window("tab")
            page.driver.get(f"http://localhost:{other.server_port}/")  # another site than ours
            page.driver.switch_to.window(ours)
            page.click("#stop")

        self.stop_often(page, stop_beside_it, 3)

    def test_a_failed_stop_still_releases_the_muscle(self):
        page = self.page()
        page.bring_to(TARGET_MM)
        page.run(HEARS_NO_STOP)
        page.run(REMEMBERS_REQUESTS)
        page.press_space()
        page.wait(lambda: page.state() != "active" and page.value("power") == 0.0, READY_S, "cools by itself")
        page.wait(lambda: page.text("#stop-notice").endswith("STOP itself failed: no answer within 0.5 s"), READY_S,
                  "that nothing answered")
        asked = page.run("return window.asked")
        since = asked[next(i for i, address in enumerate(asked) if address.endswith("/stop")):]
        self.assertEqual([address for address in since if address.endswith("/api/alive")], [])

    def test_a_failed_stop_is_cleared_when_the_muscle_is_off(self):
        board = simulated_board()
        self.addCleanup(board.stop)
        own = monitor(f"socketcand:{board.found[1]}")
        self.addCleanup(own.stop)
        page = self.page(own.found[0])
        page.wait(lambda: page.state() == "disarmed", READY_S, "disarmed")
        board.stop()
        page.wait(lambda: page.state() == "silent", READY_S, "silent")
        page.press_space()
        page.wait(lambda: page.text("#stop-notice").startswith("STOP FAILED"), READY_S, "that STOP failed")
        self.addCleanup(simulated_board(board.found[1]).stop)
        page.wait(lambda: page.state() == "disarmed", READY_S, "disarmed")
        page.wait(lambda: not page.text("#stop-notice").startswith("STOP FAILED"), READY_S, "that it is off")

    def test_the_stop_notice_covers_nothing(self):
        page = self.page()
        for width, height, mobile in ((1440, 1000, False), (800, 900, False), (390, 844, True)):
            page.screen(width, height, mobile)
            page.run("scrollTo(0, 0)")
            page.press_space()
            page.wait(page.stop_is_confirmed, READY_S, "a word about STOP")
            covered = page.run("""const box = document.querySelector("#stop-notice").getBoundingClientRect();
                return [...document.querySelectorAll("header *, .readouts, .plot, .card, #stop")].filter((element) => {
                    const other = element.getBoundingClientRect();
                    return other.width * other.height > 0 && other.bottom > box.top + 1 && other.top < box.bottom - 1
                        && other.right > box.left + 1 && other.left < box.right - 1;
                }).map((element) => element.id || element.className || element.tagName)""")
            self.assertEqual([name for name in covered if not (name == "stop" and not mobile)], [], (width, mobile))
            page.wait(lambda: page.text("#stop-notice") == "", READY_S, "it goes")

    def test_a_command_answered_after_stop_is_not_renewed(self):
        page = self.page()
        page.bring_to(TARGET_MM)
        page.run("""const asked = window.fetch;
            window.fetch = (address, options) => asked(address, options).then((answer) => !/command/.test(address) ? answer
                : new Promise((resolve) => setTimeout(resolve, 1000, answer)))""")
        page.click(".go")
        page.press_space()
        page.wait(page.is_off, READY_S, "off")
        list(page.requests())
        page.wait(lambda: page.text(".answer").endswith("obeyed"), READY_S, "the command's answer")
        time.sleep(1.0)
        self.assertEqual([address for address in page.requests() if address.endswith("/api/alive")], [])


if __name__ == "__main__":
    unittest.main()
