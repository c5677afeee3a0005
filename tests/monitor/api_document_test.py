"""docs/monitor-api.json is OpenAPI, has every path that the monitor serves and no other, and says what it answers.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import contextlib
import http.client
import json
import pathlib
import re
import unittest

import jsonschema
from hour_source import INFEASIBLE
from openapi_spec_validator import validate
from programs import OnSimulatedBoard, SLACK_S, monitor, until

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENT = json.loads((ROOT / "docs" / "monitor-api.json").read_text())
SOURCES = ROOT / "firmware" / "apps" / "supercoil"
# server.Get("/api/about" and server.Get(R"(/api/tuning/(\d+))"
SERVED = re.compile(r'server\.(Get|Post)\((?:R"\((/api/.*?)\)"|"(/api/[^"]*)"),')


def served():
    """(method, path) of the sources, a group of a path as {}."""
    # One has a listener of its own, the other is among the page's files.
    found = {("post", "/stop"), ("get", "/api/openapi.json")}
    for source in SOURCES.rglob("*.cpp"):
        for method, pattern, path in SERVED.findall(source.read_text()):
            found.add((method.lower(), re.sub(r"\([^()]*\)", "{}", pattern) or path))
    return found


def documented():
    return {(method, re.sub(r"\{\w+\}", "{}", path)) for path, item in DOCUMENT["paths"].items()
            for method in item if method in ("get", "post")}


class Document(unittest.TestCase):
    def test_document_is_valid_openapi(self):
        validate(DOCUMENT)

    def test_document_lists_every_command(self):
        names = re.search(r"verb_names\{(.*?)\};", (ROOT / "firmware/core/loop/command.hpp").read_text(), re.S).group(1)
        body = DOCUMENT["paths"]["/api/command"]["post"]["requestBody"]["content"]["application/json"]["schema"]
        plain = re.findall(r'"(\w+)"', names.partition('"knot"')[0])  # a trajectory's have a path of their own
        self.assertEqual(["none", *body["properties"]["opcode"]["enum"]], plain)

    def test_document_lists_every_served_path(self):
        self.assertGreater(len(served()), 10)
        self.assertEqual(documented(), served())


class Answers(OnSimulatedBoard):
    def setUp(self):
        program = monitor(self.source)
        self.addCleanup(program.stop)
        self.port = int(program.found[1].rstrip("/").split(":")[-1])
        self.token = program.found[2].removeprefix("#token=")
        until(lambda: "1" in self.request("get", "/api/history")[1]["nodes"])

    def request(self, method, path, body=None, port=None, **headers):
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", port or self.port, timeout=SLACK_S)) as connection:
            connection.request(method.upper(), path, None if body is None else json.dumps(body), headers)
            answer = connection.getresponse()
            text = answer.read().decode()
            return answer.status, json.loads(text) if "json" in answer.headers.get("Content-Type", "") else text

    def check(self, method, path, expected, requested=None, **options):
        """The status is one that the document has, and the body fits its schema there. requested: path with values."""
        status, body = self.request(method, requested or path, **options)
        self.assertEqual(status, expected, body)
        answers = DOCUMENT["paths"][path][method]["responses"]
        self.assertIn(str(status), answers)
        answer = answers[str(status)]
        if "$ref" in answer:
            answer = DOCUMENT["components"]["responses"][answer["$ref"].rsplit("/", 1)[1]]
        (media, content), = answer["content"].items()
        if media == "application/json":
            # References are to the document's own parts.
            jsonschema.validate(body, {**content["schema"], "components": DOCUMENT["components"]})
        return body

    def test_document_is_served(self):
        self.assertEqual(self.check("get", "/api/openapi.json", 200), DOCUMENT)

    def test_read_requests_match_the_document(self):
        about = self.check("get", "/api/about", 200)
        self.assertEqual(str(about["protocol_version"]), DOCUMENT["info"]["version"])
        self.assertEqual(about["infeasible"], INFEASIBLE)
        self.check("get", "/api/history", 200, "/api/history?from_s=-1")
        self.check("get", "/api/history", 400, "/api/history?from_s=x")
        self.check("get", "/api/history", 403, Host="example.org")
        self.check("get", "/api/fault/{name}", 200, "/api/fault/over_temperature")
        self.check("get", "/api/fault/{name}", 404, "/api/fault/none_such")
        for path in ("/api/kinds/{node}", "/api/muscle/{node}"):
            self.check("get", path, 200, path.format(node=1))
            self.check("get", path, 504, path.format(node=9))
            self.check("get", path, 400, path.format(node=64))

    def test_commands_match_the_document(self):
        bearer = {"Authorization": f"Bearer {self.token}"}
        node = {"node": 1}
        self.check("post", "/api/command", 200, body={**node, "opcode": "disarm"}, **bearer)
        self.check("post", "/api/command", 400, body={**node, "opcode": "fly"}, **bearer)
        self.check("post", "/api/command", 403, body={**node, "opcode": "disarm"})
        self.check("post", "/api/trajectory", 200, body=node, **bearer)
        self.check("post", "/api/trajectory", 400, body={**node, "knots": [{}]}, **bearer)
        self.check("post", "/api/trajectory", 403, body=node)
        self.check("post", "/api/alive", 200, body=node, **bearer)
        self.check("post", "/api/alive", 400, body={"node": 0}, **bearer)
        self.check("post", "/api/tuning", 200, body={**node, "place": 0, "from": "in_use"}, **bearer)
        self.check("post", "/api/tuning", 400, body={**node, "place": 5, "from": "in_use"}, **bearer)
        port = self.request("get", "/api/about")[1]["stop_port"]
        self.check("post", "/stop", 200, port=port)
        self.check("post", "/stop", 403, port=port, Origin="http://example.org")


if __name__ == "__main__":
    unittest.main()
