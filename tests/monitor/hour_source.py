"""A stand-in for supercoil monitor that has an hour of four muscles at 100 Hz to give, as fast as a page takes it."""

import http.server
import itertools
import json
import math
import pathlib
import queue
import threading

import cantools

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "firmware" / "apps" / "supercoil" / "monitor" / "page"
UPLOT = ROOT / "toolchain" / "page" / "node_modules" / "uplot" / "dist"
FILES = {"/": PAGE / "index.html", "/uplot.js": UPLOT / "uPlot.iife.min.js", "/uplot.css": UPLOT / "uPlot.min.css"}
TYPES = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}
NODES = (1, 2, 3, 4)
DATABASE = cantools.database.load_file(ROOT / "firmware" / "io" / "can" / "supercoil.dbc")
PROTOCOL = {message.name: {signal.name: {"unit": signal.unit or "", "digits": 8 if signal.is_float or signal.length <= 24 else 15,
                                         "values": {str(number): str(name) for number, name in (signal.choices or {}).items()}}
                           for signal in message.signals} for message in DATABASE.messages}
PARAMETERS = len(PROTOCOL["Estimate"]["parameter"]["values"])
CONSTANT = {"state": 2, "mode": 1, "fault": 0, "leased": 1, "protocol_version": 3, "error_bound": 0.1}
# As the monitor's own: api_document_test compares them.
INFEASIBLE = {"limits": ["minimum", "maximum", "temperature", "cooling", "unproven"], "lasts_s": 0.2}


def value(signal, time_s, node, turn):
    """A motion with a tremble; parameters and counters go round."""
    if signal in ("parameter", "counter"):
        return turn % PARAMETERS
    if signal in CONSTANT:
        return CONSTANT[signal]
    return round(0.01 * (1 + math.sin(0.3 * time_s + node)) + 1e-5 * math.sin(997.0 * time_s), 7)


def batch(from_s, to_s):
    """All periodic messages, each at its own period."""
    nodes = {}
    for node, message in itertools.product(NODES, DATABASE.messages):
        if not message.cycle_time or (message.name == "Timing" and node != NODES[0]):
            continue
        period_s = message.cycle_time / 1e3
        turns = range(math.ceil(from_s / period_s - 1e-9), math.ceil(to_s / period_s - 1e-9))
        rows = {"time_s": [round(turn * period_s, 6) for turn in turns]}
        for signal in message.signals:
            rows[signal.name] = [value(signal.name, turn * period_s, node, turn) for turn in turns]
        nodes.setdefault(str(node), {})[message.name] = rows
    bus = {"load": 0.6, "frames_per_s": 1600, "error_frames": 0, "dropped": 0, "foreign_per_s": 0}
    return {"newest_s": to_s, "nodes": nodes, "bus": bus}


class HourSource(http.server.ThreadingHTTPServer):
    """Serves the page; send() puts a batch into the stream and waits while it is congested."""

    daemon_threads = True

    def __init__(self):
        self.batches = queue.Queue(maxsize=4)
        super().__init__(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.serve_forever, daemon=True).start()

    @property
    def address(self):
        return f"http://127.0.0.1:{self.server_port}/"

    def send(self, from_s, to_s):
        self.batches.put(json.dumps(batch(from_s, to_s)), timeout=30)

    def handle_error(self, *_):
        """A browser that was closed is not an error."""


class Handler(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        """Says nothing."""

    def do_GET(self):
        path = self.path.partition("?")[0]
        if path == "/api/stream":
            return self.stream()
        if path == "/api/about":
            return self.answer("application/json", json.dumps(
                {"version": "0", "source": "an hour", "kind": "live", "read_only": True, "may_command": False,
                 "stop_port": 1, "page_timeout_s": 1.5, "protocol_version": CONSTANT["protocol_version"], "protocol": PROTOCOL,
                 "infeasible": INFEASIBLE}).encode())
        if path == "/api/history":
            return self.answer("application/json", b'{"newest_s": null, "nodes": {}}')
        file = FILES.get(path, PAGE / path.removeprefix("/"))
        if not file.is_file():
            return self.send_error(404)
        return self.answer(TYPES[file.suffix], file.read_bytes())

    def answer(self, kind, body):
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        # Isolated, so that the browser tells the page's memory.
        self.send_header("Cross-Origin-Opener-Policy", "same-origin")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        self.end_headers()
        self.wfile.write(body)

    def stream(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        self.end_headers()
        while True:
            self.wfile.write(f"data: {self.server.batches.get()}\n\n".encode())
            self.wfile.flush()
