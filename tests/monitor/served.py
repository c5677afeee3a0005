"""The page of a monitor, as a program sees it."""

import contextlib
import http.client
import json
import socket

from programs import OnSimulatedBoard, SLACK_S, monitor, until


class Served:
    """One monitor's page, as seen by a program."""

    def __init__(self, program):
        self.address = program.found[1].removeprefix("http://").rstrip("/")
        self.token = (program.found[2] or "").removeprefix("#token=")
        self.port = int(self.address.split(":")[1])

    def request(self, method, path, body=None, port=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", port or self.port, timeout=SLACK_S)
        with contextlib.closing(connection):
            connection.request(method, path, body, headers)
            answer = connection.getresponse()
            return answer.status, answer.read().decode()

    def get(self, path, **headers):
        status, text = self.request("GET", path, **headers)
        return status, json.loads(text)

    def post(self, path, body, port=None, token=None, origin=None):
        headers = {"X-Supercoil-Token": self.token if token is None else token,
                   "Origin": f"http://{self.address}" if origin is None else origin}
        status, text = self.request("POST", path, body if isinstance(body, str) else json.dumps(body), port, **headers)
        return status, json.loads(text)

    def command(self, opcode, value=0.0):
        return self.post("/api/command", {"node": 1, "opcode": opcode, "value": value})

    def stop_port(self):
        return self.get("/api/about")[1]["stop_port"]

    def state(self):
        """Name of the newest state, and the power."""
        about = self.get("/api/about")[1]
        node = self.get("/api/history?from_s=-1")[1]["nodes"]["1"]
        names = about["protocol"]["Status"]["state"]["values"]
        return names[str(node["Status"]["state"][-1])], node["Power"]["applied_W"][-1]

    def open_stream(self, receive_bytes=None):
        stream = socket.socket()
        if receive_bytes:
            stream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
        stream.settimeout(SLACK_S)
        stream.connect(("127.0.0.1", self.port))
        stream.sendall(f"GET /api/stream HTTP/1.1\r\nHost: {self.address}\r\n\r\n".encode())
        return stream

    def events(self, path="/api/stream", **headers):
        """(id, data) of each message of a stream, until it is closed; the id alone of what it begins with."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=SLACK_S)
        with contextlib.closing(connection):
            connection.request("GET", path, headers=headers)
            answer, event = connection.getresponse(), {}
            while line := answer.readline().decode():
                if line == "\n":
                    if "id" in event:
                        yield event["id"], json.loads(event.get("data", "null"))
                    event = {}
                name, _, text = line.rstrip("\n").partition(": ")
                event[name] = text


class OnServedBoard(OnSimulatedBoard):
    def serve(self, *options):
        program = monitor(self.source, *options)
        self.addCleanup(program.stop)
        served = Served(program)
        until(lambda: "1" in served.get(f"/api/history?token={served.token}")[1]["nodes"])
        return served
