"""How long after the click on STOP the board is disarmed, while a thousand connections trickle on STOP's own port.

    stop_times.py [CLICKS [CONNECTIONS]]    in a real browser, over a simulated board; prints the figures of docs/monitor.md

A click's time is the browser's, the board's is that of its answer on the bus; both are of this machine's clock.
"""

import re
import socket
import sys
import threading
import time

from hour_source import DATABASE
from page_test import TARGET_MM, Page
from programs import monitor, simulated_board, trickle

LIMIT_MS = 100
PATIENCE_S = 20.0
HEATS_S = 0.3
ACKNOWLEDGE = DATABASE.get_message_by_name("Acknowledge")
NOTES_CLICKS = """addEventListener("click", (event) => {
    if (event.target.closest("#stop")) window.clicked_s = (performance.timeOrigin + event.timeStamp) / 1e3;
}, { capture: true })"""


class Answers(threading.Thread):
    """Times at which node 1 answered that it obeyed a disarm."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.bus = socket.create_connection(("127.0.0.1", port))
        self.times_s = []
        self.bus.sendall(b"< open can0 >")
        time.sleep(0.5)
        self.bus.sendall(b"< rawmode >")
        self.start()

    def run(self):
        received = ""
        while more := self.bus.recv(65536).decode():
            *elements, received = (received + more).split(">")
            for element in elements:
                if not (found := re.fullmatch(rf"< frame {ACKNOWLEDGE.frame_id:x} ([\d.]+) ([0-9a-f]+) ", element.lower())):
                    continue
                answer = ACKNOWLEDGE.decode(bytes.fromhex(found[2]))
                if answer["opcode"] == "disarm" and answer["refusal"] == "none":
                    self.times_s.append(float(found[1]))

    def first_after(self, time_s):
        return min((answer_s for answer_s in self.times_s if answer_s >= time_s), default=None)


def measure(page, answers):
    """Milliseconds from a click to its effect. Repeats when a stall of this machine let the command expire before."""
    while True:
        page.arm()
        page.move(TARGET_MM)
        time.sleep(HEATS_S)
        page.click("#stop")
        clicked_s = page.run("return window.clicked_s")
        page.wait(lambda: answers.first_after(clicked_s), PATIENCE_S, "the board's answer")
        page.wait(lambda: page.state() in ("disarmed", "fault"), PATIENCE_S, "off")
        if page.state() == "disarmed":
            return 1e3 * (answers.first_after(clicked_s) - clicked_s)


def main(clicks=100, connections=1000):
    board = simulated_board()
    own = monitor(f"socketcand:{board.found[1]}")
    crowd = None
    try:
        answers = Answers(int(board.found[1]))
        with Page() as page:
            page.open(own.found[0])
            page.run(NOTES_CLICKS)
            crowd = trickle(page.stop_port(), connections)
            times_ms = sorted(measure(page, answers) for _ in range(clicks))
    finally:
        for program in filter(None, (crowd, own, board)):
            program.stop()
    within = sum(time_ms <= LIMIT_MS for time_ms in times_ms)
    print(f"{within} of {clicks} within {LIMIT_MS} ms; median {times_ms[clicks // 2]:.1f} ms, longest "
          + ", ".join(f"{time_ms:.0f}" for time_ms in times_ms[-3:]) + " ms")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
