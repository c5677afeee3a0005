"""Between a program and a simulated board, over socketcand: frames are lost or altered on their way."""

import contextlib
import re
import socket
import threading


def unaltered(identifier, data):
    return data


class Between(threading.Thread):
    """Serves programs as the board does, and passes on what either says.

    to_board, from_board: (identifier, data) -> the data to pass on; None: the frame is lost."""

    def __init__(self, port, to_board=unaltered, from_board=unaltered):
        super().__init__(daemon=True)
        self.board = port
        self.to_board, self.from_board = to_board, from_board
        self.listening = socket.create_server(("127.0.0.1", 0))
        self.port = self.listening.getsockname()[1]
        self.start()

    def run(self):
        with contextlib.suppress(OSError):  # until it is ended
            while True:
                program, _ = self.listening.accept()
                board = socket.create_connection(("127.0.0.1", self.board))
                for ends in ((program, board, self.to_board), (board, program, self.from_board)):
                    threading.Thread(target=pass_on, args=ends, daemon=True).start()

    def end(self):
        self.listening.shutdown(socket.SHUT_RDWR)  # wakes accept
        self.listening.close()
        self.join()


def pass_on(source, sink, alter):
    """Passes data on until either end is closed."""
    rest = b""
    with source, sink, contextlib.suppress(OSError):
        while data := source.recv(65536):
            *elements, rest = re.split(rb"(?<=>)", rest + data)
            sink.sendall(b"".join(altered(element, alter) for element in elements))
        for end in (source, sink):
            end.shutdown(socket.SHUT_RDWR)  # wakes the other direction


def altered(element, alter):
    """< send 41 2 A B > of a program, < frame 41 23.424242 0A0B > of the board; everything else unchanged."""
    words = element.decode().strip("<> ").split()
    if words[0] not in ("send", "frame"):
        return element
    sent = words[0] == "send"
    identifier = int(words[1], 16)
    data = alter(identifier, bytes(int(word, 16) for word in words[3:]) if sent else bytes.fromhex("".join(words[3:])))
    if data is None:
        return b""
    last = [str(len(data)), *(f"{byte:X}" for byte in data)] if sent else [words[2], data.hex().upper()]
    return f"< {' '.join([words[0], words[1], *last])} >".encode()
