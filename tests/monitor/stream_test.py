"""The stream of the monitor's server: what is new, what a reader missed, and readers that never read.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import contextlib
import time
import unittest

from programs import SLACK_S, monitor, simulated_board, until
from served import OnServedBoard, Served


class Stream(OnServedBoard):
    def test_a_stream_sends_new_data_and_source_events(self):
        board = simulated_board()
        self.addCleanup(board.stop)
        port = board.found[1]
        program = monitor(f"socketcand:{port}")
        self.addCleanup(program.stop)
        with Served(program).open_stream() as stream:
            text = b""
            for wanted in (b'data: {"newest_s"', b"event: lost", b"event: found", b'data: {"newest_s"'):
                if wanted == b"event: lost":
                    board.stop()
                if wanted == b"event: found":
                    self.addCleanup(simulated_board(port).stop)
                end_s = time.monotonic() + 3 * SLACK_S
                while wanted not in text and time.monotonic() < end_s:
                    text += stream.recv(65536)
                self.assertIn(wanted, text)
                text = text[text.index(wanted) + len(wanted):]

    def test_a_stream_sends_its_retry_time(self):
        with self.serve().open_stream() as stream:
            text = b""
            end_s = time.monotonic() + SLACK_S
            while b"\nretry: 1000\nid: " not in text and time.monotonic() < end_s:
                text += stream.recv(4096)
        self.assertIn(b"\nretry: 1000\nid: ", text)

    def measured_s(self, batches):
        return [at_s for batch in batches for at_s in batch["nodes"].get("1", {}).get("Measurement", {}).get("time_s", [])]

    def test_a_reconnected_reader_gets_what_it_missed(self):
        served = self.serve()
        first = served.events()
        begin, nothing = next(first)
        self.assertIsNone(nothing)
        last, batch = next(first)
        self.assertNotEqual(last, begin)
        first.close()
        before = self.measured_s([batch])
        time.sleep(1.0)
        again = served.events(**{"Last-Event-ID": last})
        self.assertEqual(next(again)[0], last)
        missed = self.measured_s([next(again)[1]])
        again.close()
        # A second of them, none twice and none left out.
        self.assertGreater(len(missed), 50)
        served_s = self.measured_s([served.get("/api/history")[1]])
        self.assertEqual([at_s for at_s in served_s if (before or missed)[0] <= at_s <= missed[-1]], before + missed)

    def test_only_event_ids_of_this_run_resume(self):
        served = self.serve()
        run, begin = next(served.events())[0].split("-")
        for path, last in (("/api/stream?resume=no", f"{run}-0"), ("/api/stream", "1-0"), ("/api/stream", "0"),
                           ("/api/stream", f"{run}-"), ("/api/stream", f"{run}-1x"), ("/api/stream", f"{run}-{2**64}")):
            self.assertGreaterEqual(int(next(served.events(path, **{"Last-Event-ID": last}))[0].split("-")[1]),
                                    int(begin), (path, last))
        self.assertEqual(next(served.events(**{"Last-Event-ID": f"{run}-0"}))[0], f"{run}-0")

    def test_stalled_readers_are_dropped(self):
        served = self.serve()
        with contextlib.ExitStack() as crowd:
            def one_more(**how):
                return crowd.enter_context(served.open_stream(**how)).recv(12) == b"HTTP/1.1 200"

            for _ in range(24):
                until(lambda: one_more(receive_bytes=2048))
            self.assertFalse(one_more())
            # No reader has gone, so the server has to drop them.
            until(one_more, patience_s=10 * SLACK_S)


if __name__ == "__main__":
    unittest.main()
