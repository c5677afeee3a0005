"""The documentation's site, built by toolchain/docs and read in a real browser.

Every page of docs/ can be reached from the start page, no link or anchor is dead, the search works, nothing is loaded
from another machine, and no page scrolls sideways on a phone. Every command has a manual page with all its options.
The API reference has every public header, and a public class without a comment fails the build.
"""

import functools
import html
import html.parser
import http.server
import os
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "monitor"))
from browser import Browser  # noqa: E402

SUPERCOIL = os.environ.get("SUPERCOIL", ROOT / "build" / "release" / "bin" / "supercoil")
SHOWN_S = 10.0
PHONE = (360, 760)
# Where libsupercoil-dev's headers come from, and the folders there that are generated, or not installed.
INSTALLED = ("control/include", "hal/include", "firmware/core", "firmware/io")
NOT_IN_THE_REFERENCE = ("generated", "linux_board", "plot")
# In this theme the column of text scrolls instead of the page.
BEYOND = """return Math.max(...[document.documentElement, ...document.querySelectorAll(".content")]
    .map((box) => box.scrollWidth - box.clientWidth))"""


class Page(html.parser.HTMLParser):
    """The links of a page, the files that it loads, and its anchors."""

    def __init__(self, file):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(file.read_text())

    def handle_starttag(self, _tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name == "id":
                self.anchors.add(value)


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def serve(folder):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(QuietHandler, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def resolved(page, link):
    """(file in the site, anchor), or None if the link leaves the site."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), path)) if path else page, parts.fragment


class SiteTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        out = cls.enterClassContext(tempfile.TemporaryDirectory())
        built = subprocess.run([ROOT / "toolchain" / "docs", "--package", "--out", out], capture_output=True, text=True)
        if built.returncode:
            raise AssertionError(f"toolchain/docs failed:\n{built.stdout}{built.stderr}")
        cls.out = pathlib.Path(out)
        cls.site = cls.out / "html"
        cls.pages = {file.relative_to(cls.site).as_posix(): Page(file) for file in cls.site.rglob("*.html")}
        cls.server = serve(cls.site)
        cls.addClassCleanup(cls.server.server_close)
        cls.addClassCleanup(cls.server.shutdown)
        cls.address = f"http://127.0.0.1:{cls.server.server_port}/"
        cls.browser = cls.enterClassContext(Browser())

    def open(self, page):
        self.browser.driver.get(self.address + page)

    def shown(self, selector):
        return self.browser.driver.find_elements("css selector", selector)

    def wait(self, condition, what):
        end = time.monotonic() + SHOWN_S
        while not condition():
            self.assertLess(time.monotonic(), end, f"not there in time: {what}")
            time.sleep(0.05)

    def test_every_source_is_a_page_reachable_from_the_start(self):
        files = [*(ROOT / "docs").rglob("*.md"), *(ROOT / "docs").glob("man/*.[1-8]")]
        sources = [file.relative_to(ROOT).with_suffix(".html").as_posix() for file in files]
        self.assertGreater(len(sources), 60)
        reached, ahead = set(), ["index.html"]
        while ahead:
            page = ahead.pop()
            if page in reached or page not in self.pages:
                continue
            reached.add(page)
            ahead += [target[0] for link in self.pages[page].links if (target := resolved(page, link))]
        self.assertEqual(sorted(set(sources) - reached), [])

    def test_no_link_or_anchor_is_dead(self):
        dead = []
        for page, parsed in self.pages.items():
            for link in parsed.links:
                target = resolved(page, link)
                if not target:
                    continue
                file, anchor = target
                if not (self.site / file).is_file():
                    dead.append(f"{page}: {link}: no such file")
                elif anchor and file in self.pages and anchor not in self.pages[file].anchors:
                    dead.append(f"{page}: {link}: no such anchor")
        self.assertEqual(dead, [], "\n" + "\n".join(dead))

    def test_every_command_has_a_page_with_an_anchor_per_option(self):
        for manual in sorted((ROOT / "docs" / "man").glob("*.[1-8]")):
            with self.subTest(manual.stem):
                name = f"docs/man/{manual.stem}.html"
                text = html.unescape(re.sub(r"<[^>]+>", "", (self.site / name).read_text()))
                items = re.findall(r"^\.It Fl (?:\S+ , Fl )?\\-(\S+)", manual.read_text(), re.M)
                self.assertGreaterEqual(len(items), 1)
                for option in (f"--{item}".replace("\\-", "-") for item in items):
                    self.assertIn(option, text)
                    self.assertTrue([anchor for anchor in self.pages[name].anchors
                                     if anchor.startswith("cmdoption-") and anchor.endswith(option.strip("-"))], option)

    def test_a_manual_page_shows_defaults_ranges_and_examples(self):
        page = html.unescape(re.sub(r"<[^>]+>", "", (self.site / "docs/man/supercoil-sim.html").read_text()))
        for text in ("supercoil-sim campaign [options] [study]", "--nodes INT",
                     "From 1 to 8. Default: 1. Not with --learned.",
                     "supercoil-sim run bench --real-time --can socketcand:29536"):
            self.assertIn(text, page)
        self.assertIn("../simulation.html", self.pages["docs/man/supercoil-sim.html"].links)

    def test_the_package_installs_the_site_where_it_is_served(self):
        package, = self.out.glob("supercoil-doc_*_all.deb")
        control = subprocess.run(["dpkg-deb", "--field", package], capture_output=True, text=True, check=True).stdout
        self.assertIn("Package: supercoil-doc\n", control)
        self.assertNotIn("@", re.sub(r"<.*>", "", control))
        help_text = subprocess.run([SUPERCOIL, "docs", "--help"], capture_output=True, text=True, check=True).stdout
        folder = re.search(r"--folder DIR=/(\S+)", help_text)[1]
        with tempfile.TemporaryDirectory() as root:
            subprocess.run(["dpkg-deb", "--extract", package, root], check=True)
            site = pathlib.Path(root, folder)
            self.assertEqual({file.relative_to(site) for file in site.rglob("*.html")},
                             {file.relative_to(self.site) for file in self.site.rglob("*.html")})
            self.assertEqual((site / "index.html").read_bytes(), (self.site / "index.html").read_bytes())
            for name in ("copyright", "changelog.gz"):
                self.assertTrue((site.parent / name).is_file(), name)
            named = re.findall(r"html/_static/(\S+)", (site.parent / "copyright").read_text())
            self.assertEqual([name for name in named if not [*site.glob(f"_static/{name}")]], [])

    def test_every_public_header_is_in_the_reference(self):
        text = "".join(page.read_text() for page in self.site.glob("docs/api/*.html"))
        text = html.unescape(re.sub(r"<[^>]+>", "", text))
        headers = [header.relative_to(ROOT / root).as_posix() for root in INSTALLED
                   for header in (ROOT / root).rglob("*.hpp") if header.parent.name not in NOT_IN_THE_REFERENCE]
        self.assertGreater(len(headers), 150)
        self.assertEqual([header for header in headers if f'#include "{header}"' not in text], [])

    def test_the_reference_shows_signatures_units_and_errors(self):
        page = html.unescape(re.sub(r"<[^>]+>", "", (self.site / "docs/api/tracking.html").read_text()))
        for text in ("Controller(const ControllerSettings &settings, double step_s);",
                     "supported; step_s > 0 in seconds.", "template <class Scalar>\nclass Pi",
                     "double proportional_W_per_m = 2000.0"):
            self.assertIn(text, page)
        self.assertNotIn("OscillationDetector::Band", page, "private")

    def test_an_undocumented_class_or_function_fails_the_build(self):
        for root, code, said in (
                ("control/include", "struct Bare { double value_m; };", "Bare is not documented"),
                ("hal/include", "double bare(double value_m);", "bare(double value_m)"),
                ("hal/include", "/// A length.\nstruct Bare { void set(double value_m); };", "set(double value_m)"),
                ("hal/include", "/// \\param none There is none.\ndouble bare(double value_m);", "none"),
                ("firmware/core", "struct Settings { double value_m; };", "Settings is not documented"),
                ("firmware/io", "double bare(double value_m);", "bare(double value_m)")):
            with self.subTest(code, root=root), tempfile.TemporaryDirectory() as folder:
                for part in ("toolchain/docs", "toolchain/docs.d/Doxyfile"):
                    pathlib.Path(folder, part).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy2(ROOT / part, pathlib.Path(folder, part))
                setup = pathlib.Path(folder, "toolchain/setup")
                setup.write_text("#!/bin/sh\n")
                setup.chmod(0o755)
                for include in INSTALLED:
                    pathlib.Path(folder, include).mkdir(parents=True)
                header = pathlib.Path(folder, root, "bare.hpp")
                header.write_text(f"// A header.\n#pragma once\n\nnamespace supercoil {{\n{code}\n}}\n")
                built = subprocess.run([pathlib.Path(folder, "toolchain/docs")], capture_output=True, text=True)
                self.assertEqual(built.returncode, 1)
                self.assertIn("the API reference has gaps", built.stderr)
                self.assertIn(said, built.stderr)

    def test_nothing_is_requested_from_other_hosts(self):
        for page in ("", "docs/paper.html", "docs/safety.html"):
            self.open(page)
        self.wait(lambda: self.shown(".drawn-diagram svg"), "the diagram")
        asked = [url for url in self.browser.requests() if not url.startswith(("data:", "blob:", "chrome:"))]
        self.assertGreater(len(asked), 10)
        self.assertEqual([url for url in asked if not url.startswith(self.address)], [])
        self.assertEqual(self.browser.errors(), [])

    def test_the_search_finds_a_fault(self):
        self.open("")
        field = self.browser.find(".sidebar-search")
        field.send_keys("over_temperature")
        field.submit()
        self.wait(lambda: any(link.get_attribute("href").split("?")[0].endswith("docs/faults/over_temperature.html")
                              for link in self.shown(".search a")), "over_temperature among what was found")

    def test_light_and_dark_follow_the_system(self):
        seen = set()
        for scheme in ("light", "dark"):
            self.browser.colours(scheme)
            self.open("docs/safety.html")
            seen.add(self.browser.run("return getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(seen), 2)

    def test_no_page_scrolls_sideways_on_a_phone(self):
        self.browser.screen(*PHONE, mobile=True)
        self.addCleanup(self.browser.cdp, "Emulation.clearDeviceMetricsOverride")
        wide = {}
        for page in sorted(self.pages):
            self.open(page)
            beyond = self.browser.run(BEYOND)
            if beyond > 0:
                wide[page] = beyond
        self.assertEqual(wide, {}, "pixels beyond the screen")


if __name__ == "__main__":
    unittest.main()
