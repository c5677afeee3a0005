"""Connections to a port that send a byte now and then and never end a request, reopened when they are closed.

    trickle.py PORT COUNT       until it is killed; prints "trickling" when all were begun and have had time to open
"""

import contextlib
import itertools
import os
import resource
import socket
import sys
import time

BYTE_EVERY_S = 0.1


class Trickle:
    """Never waits for its peer: a server without room for more connections lets new ones wait for seconds."""

    def __init__(self, port):
        self.port = port
        self.connection = None
        self.sent = 0

    def drip(self):
        try:
            if self.connection is None:
                self.open()
            elif self.connection.recv(64) == b"":
                raise ConnectionResetError
        except BlockingIOError:
            pass  # nothing was said, or it is not open yet
        except OSError:
            self.close()
        with contextlib.suppress(OSError):
            if self.connection:
                self.sent += self.connection.send(b"P")

    def open(self):
        self.connection = socket.socket()
        self.connection.setblocking(False)
        self.connection.connect(("127.0.0.1", self.port))

    def close(self):
        if self.connection:
            self.connection.close()
        self.connection = None


def main(port, count):
    if os.getpriority(os.PRIO_PROCESS, 0) < 0:
        os.setpriority(os.PRIO_PROCESS, 0, 0)  # this tests connections, not who gets the processor
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    trickles = [Trickle(port) for _ in range(count)]
    for turn in itertools.count():
        begin_s = time.monotonic()
        for trickle in trickles:
            trickle.drip()
        if turn == 1:
            if not any(trickle.sent for trickle in trickles):
                sys.exit(f"nobody takes connections at port {port}")
            print("trickling", flush=True)
        time.sleep(max(0.0, begin_s + BYTE_EVERY_S - time.monotonic()))


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        main(int(sys.argv[1]), int(sys.argv[2]))
