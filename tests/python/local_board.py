"""A simulated board of two channels behind the socket of supercoild, in real time, and what it is seen to do."""

import contextlib
import os
import pathlib
import socket
import subprocess
import tempfile
import threading
import time

DEADLINE_S = 120.0


class LocalBoard:
    """path: of its socket."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory()
        self._process = subprocess.Popen([os.environ["LOCAL_BOARD"], self._folder.name], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.path = str(pathlib.Path(self._folder.name) / "commands")
        if self._process.stdout.readline() != "ready\n":
            raise RuntimeError("local_board does not start")

    def end(self):
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        ended = self._process.wait(DEADLINE_S)
        self._process.stdout.close()
        self._folder.cleanup()
        if ended:
            raise RuntimeError(f"local_board ended with {ended}")


class Watch(threading.Thread):
    """seen: references of both channels, from one answer each, while both follow a position."""

    def __init__(self, path):
        super().__init__(daemon=True)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._socket.settimeout(DEADLINE_S)
        self._socket.connect(path)
        self.seen = []
        self._stopping = False

    def run(self):
        while not self._stopping:
            self._socket.send(b"state")
            lines = [line.split() for line in self._socket.recv(8192).decode().splitlines()]
            if all(words[2] == "position" for words in lines):
                self.seen.append(tuple(float(words[4]) for words in lines))
            time.sleep(0.002)

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self._stopping = True
        self.join()
        self._socket.close()


def apart_m(seen, rests_m, scale):
    """How far the second's way, times `scale`, is from the first's while both move; and how far the first comes."""
    ways = [(first - rests_m, second - rests_m) for first, second in seen]
    apart = [abs(first - scale * second) for first, second in ways if first > 1e-5 and second > 1e-5]
    return max(apart), max(first for first, _ in ways)
