"""supercoil docs serves the files of a site to this machine only, and nothing else."""

import contextlib
import http.client
import os
import pathlib
import re
import signal
import socket
import stat
import subprocess
import tempfile
import time
import unittest

SUPERCOIL = os.environ["SUPERCOIL"]
SIMULATOR = pathlib.Path(SUPERCOIL).with_name("supercoil-sim")
PATIENCE_S = 60.0


class Docs:
    """The program, serving a folder on a free port until the context ends."""

    def __init__(self, folder, *options, program=SUPERCOIL, **environment):
        self.process = subprocess.Popen([program, "docs", "--folder", folder, "--port", "0", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, **environment})
        self.address = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/", self.address)
        if not found:
            raise AssertionError(f"printed {self.address!r}: {self.process.communicate(timeout=PATIENCE_S)}")
        self.port = int(found[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def request(self, path, method="GET", host=None):
        """Status, type and body; the path is sent unchanged."""
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)) as connection:
            connection.putrequest(method, path, skip_host=True)
            connection.putheader("Host", host or f"127.0.0.1:{self.port}")
            connection.putheader("Accept-Encoding", "gzip, br")
            connection.endheaders()
            response = connection.getresponse()
            return response.status, response.getheader("Content-Type"), response.read()


class DocsTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.site = self.folder / "html"
        (self.site / "docs" / "api").mkdir(parents=True)
        self.index = b"<!doctype html><title>supercoil</title>"
        (self.site / "index.html").write_bytes(self.index)
        (self.site / "docs" / "api" / "index.html").write_bytes(b"reference")
        (self.site / "picture.png").write_bytes(bytes(range(256)) * 4000)
        (self.folder / "secret.txt").write_text("secret")

    def test_it_serves_the_site_with_its_types(self):
        with Docs(self.site) as docs:
            self.assertEqual(docs.request("/"), (200, "text/html; charset=utf-8", self.index))
            self.assertEqual(docs.request("/docs/api/")[2], b"reference")
            self.assertEqual(docs.request("/picture.png"), (200, "image/png", bytes(range(256)) * 4000))
            self.assertEqual(docs.request("/index.html?highlight=can")[0], 200)
            for absent in ("/none.html", "/docs/"):
                self.assertEqual(docs.request(absent)[0], 404, absent)

    def test_nothing_outside_the_site_is_served(self):
        (self.site / "link.txt").symlink_to(self.folder / "secret.txt")
        (self.site / "up").symlink_to(self.folder)
        beside = self.folder / "html-beside"
        beside.mkdir()
        (beside / "secret.txt").write_text("secret")
        with Docs(self.site) as docs:
            for path in ("/../secret.txt", "/docs/../../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
                         f"/{self.folder}/secret.txt", f"{self.folder}/secret.txt", "/link.txt", "/up/secret.txt",
                         "/../html-beside/secret.txt", "/index.html%00.png", "/%00"):
                status, _, body = docs.request(path)
                self.assertIn(status, (400, 404), path)
                self.assertNotIn(b"secret", body, path)

    def test_only_reading_is_allowed(self):
        with Docs(self.site) as docs:
            status, _, body = docs.request("/", "HEAD")
            self.assertEqual((status, body), (200, b""))
            for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH"):
                self.assertEqual(docs.request("/", method)[0], 405, method)
        self.assertEqual((self.site / "index.html").read_bytes(), self.index)

    def test_other_host_names_are_refused(self):
        with Docs(self.site) as docs:
            self.assertEqual(docs.request("/", host=f"localhost:{docs.port}")[0], 200)
            self.assertEqual(docs.request("/", host=f"elsewhere.example:{docs.port}")[0], 403)

    def test_it_listens_only_on_loopback(self):
        with Docs(self.site) as docs:
            listening = pathlib.Path("/proc/net/tcp").read_text() + pathlib.Path("/proc/net/tcp6").read_text()
            addresses = re.findall(rf"^ *\d+: ([0-9A-F]+):{docs.port:04X} \S+ 0A ", listening, re.M)
            self.assertEqual(addresses, ["0100007F"])

    def test_ctrl_c_and_sigterm_end_it_normally(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with Docs(self.site) as docs:
                docs.process.send_signal(number)
                said = docs.process.communicate(timeout=PATIENCE_S)
                self.assertEqual((docs.process.returncode, *said), (0, "", ""))

    def test_the_simulators_command_serves_the_same(self):
        with Docs(self.site, program=SIMULATOR) as docs:
            self.assertEqual(docs.request("/"), (200, "text/html; charset=utf-8", self.index))
        done = subprocess.run([SIMULATOR, "docs", "--folder", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("supercoil-doc", done.stderr)

    def test_without_a_site_it_names_what_to_install_or_build(self):
        done = subprocess.run([SUPERCOIL, "docs", "--folder", self.folder], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        for word in (str(self.folder), "supercoil-doc", "toolchain/docs", "--folder"):
            self.assertIn(word, done.stderr)

    def test_a_port_in_use_is_named(self):
        with socket.socket() as other:
            other.bind(("127.0.0.1", 0))
            other.listen()
            port = str(other.getsockname()[1])
            done = subprocess.run([SUPERCOIL, "docs", "--folder", self.site, "--port", port], capture_output=True,
                                  text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(port, done.stderr)
        self.assertIn("--port", done.stderr)

    def test_open_gives_the_address_to_the_browser(self):
        browser, opened = self.folder / "xdg-open", self.folder / "asked"
        browser.write_text(f'#!/bin/sh\necho "$1" >"{opened}.part"\nmv "{opened}.part" "{opened}"\n')
        browser.chmod(browser.stat().st_mode | stat.S_IXUSR)
        with Docs(self.site, "--open", PATH=f"{self.folder}:{os.environ['PATH']}") as docs:
            end = time.monotonic() + PATIENCE_S
            while not opened.exists():
                self.assertLess(time.monotonic(), end)
                time.sleep(0.02)
            self.assertEqual(opened.read_text().strip(), docs.address)

    def test_without_a_browser_it_still_serves(self):
        with Docs(self.site, "--open", PATH=str(self.folder)) as docs:
            self.assertIn("xdg-open", docs.process.stderr.readline())
            self.assertEqual(docs.request("/")[0], 200)


if __name__ == "__main__":
    unittest.main()
