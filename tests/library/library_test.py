"""The libraries as other projects use them: examples/cpp built outside of this tree in four ways, and run.

Usage: library_test.py BUILD [--whole] [way...], where BUILD has all programs and libraries; ways: find_package, pkg_config,
add_subdirectory, fetch_content, install. Compiling control takes minutes of processor time: without --whole the two ways
that do it only configure, and compile the example.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"\]\(([^)#\s]+)[^)\s]*\)")  # a file, without its anchor
EXAMPLES = ROOT / "examples/cpp"
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WHOLE = "--whole" in sys.argv and not sys.argv.remove("--whole")
# The compiler's alone: neither flags nor paths of whoever runs the test.
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in {"CXXFLAGS", "CMAKE_PREFIX_PATH", "PKG_CONFIG_PATH"}}


def run(*command, environment=ENVIRONMENT, **options):
    done = subprocess.run([str(word) for word in command], env=environment, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(str(word) for word in command)}: {done.returncode}\n{done.stdout}")
    return done.stdout


class Library(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="supercoil-library-")
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def install(self, *options):
        """Into a prefix of its own; the files that were written."""
        run("cmake", "--install", BUILD, "--prefix", self.path / "prefix", *options)
        manifest = "install_manifest_development.txt" if "development" in options else "install_manifest.txt"
        return (BUILD / manifest).read_text().split()

    def build(self, source, *options, target="all"):
        built = self.path / "build"
        run("cmake", "-S", source, "-B", built, "-G", "Ninja", f"-DCMAKE_UNITY_BUILD={WHOLE}", *options)
        run("cmake", "--build", built, "--target", target)
        return built

    def build_with_control(self, source):
        if WHOLE:
            self.tracks(self.build(source, target="track_muscle") / "track_muscle")
        else:
            self.build(source, target="CMakeFiles/track_muscle.dir/track_muscle.cpp.o")

    def project(self, *lines):
        text = ["cmake_minimum_required(VERSION 3.25)", "project(another LANGUAGES C CXX)", *lines,
                "add_executable(track_muscle track_muscle.cpp)",
                "target_link_libraries(track_muscle PRIVATE supercoil::control)"]
        (self.path / "CMakeLists.txt").write_text("\n".join(text) + "\n")
        shutil.copy(EXAMPLES / "track_muscle.cpp", self.path)
        return self.path

    def tracks(self, program):
        rms_um = re.search(r"reference model: ([\d.]+) um rms", run(program))
        self.assertLess(float(rms_um[1]), 5.0)

    def drives(self, program):
        lines = run(program).splitlines()
        self.assertRegex(lines[0], r"disarmed +-?0\.0")
        self.assertRegex(lines[-1], r"85 s +active +12\.")

    def test_find_package(self):
        self.install("--component", "development")
        built = self.build(EXAMPLES, f"-DCMAKE_PREFIX_PATH={self.path}/prefix")
        self.tracks(built / "track_muscle")
        self.drives(built / "own_board")

    def test_find_package_names_what_is_missing(self):
        self.install("--component", "development")
        for wanted, why in (("COMPONENTS page", "has no component page: control, firmware, can_client"),
                            ("0.1 COMPONENTS control", "version: 0.2.")):
            with self.subTest(wanted):
                (self.path / "CMakeLists.txt").write_text(
                    f"cmake_minimum_required(VERSION 3.25)\nproject(another LANGUAGES CXX)\nfind_package(supercoil {wanted} REQUIRED)\n")
                with self.assertRaisesRegex(AssertionError, re.escape(why)):
                    run("cmake", "-S", self.path, "-B", self.path / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.path}/prefix")

    def test_pkg_config(self):
        files = self.install("--component", "development")
        folder = next(pathlib.Path(file).parent for file in files if file.endswith(".pc"))
        found = {**ENVIRONMENT, "PKG_CONFIG_PATH": str(folder)}
        for program, package, check in (("track_muscle", "supercoil-control", self.tracks),
                                        ("own_board", "supercoil-firmware", self.drives)):
            flags = run("pkg-config", "--cflags", "--libs", package, environment=found).split()
            run("g++", "-std=c++20", EXAMPLES / f"{program}.cpp", "-o", self.path / program, *flags)
            check(self.path / program)
        client = run("pkg-config", "--libs", "supercoil-can-client", environment=found).split()
        self.assertEqual(client[1:5], ["-lsupercoil_can_client", "-lsupercoil_io", "-lsupercoil_core", "-lsupercoil_control"])

    def test_add_subdirectory(self):
        """Of control alone: without anything else of this tree."""
        shutil.copytree(ROOT / "control", self.path / "control")
        self.build_with_control(self.project("add_subdirectory(control)"))

    def test_fetch_content(self):
        self.build_with_control(self.project(
            "include(FetchContent)", f"FetchContent_Declare(supercoil SOURCE_DIR {ROOT})", "FetchContent_MakeAvailable(supercoil)",
            "if(NOT TARGET supercoil::firmware OR NOT TARGET supercoil::can_client OR TARGET supercoil-sim OR TARGET supercoild)",
            '  message(FATAL_ERROR "not the libraries alone")', "endif()"))

    def test_install(self):
        """Writes nothing beside its prefix, and the service starts what is there."""
        files = self.install()
        prefix = self.path / "prefix"
        self.assertEqual([file for file in files if not file.startswith(f"{prefix}/")], [])
        self.assertIn(f"{prefix}/etc/supercoil/boards/raspberry-pi-pwm-ads1115.toml", files)
        unit = (prefix / "lib/systemd/system/supercoild.service").read_text()
        self.assertEqual(re.findall(r"^Exec\w+=(\S+)", unit, re.M), [f"{prefix}/bin/supercoild"] * 2)
        self.assertIn(f"file://{prefix}/share/doc/supercoil/running.md", unit)
        pages = list((prefix / "share/doc/supercoil").rglob("*.md"))
        links = [(page, target) for page in pages for target in LINK.findall(page.read_text()) if ":" not in target]
        self.assertGreater(len(links), 1000)
        dead = [f"{page.name}: {target}" for page, target in links if not (page.parent / target).is_file()]
        self.assertEqual(dead, [])
        self.assertIn("supercoil docs (`man supercoil-docs`)", (prefix / "share/doc/supercoil/packages.md").read_text())
        release = re.search(r"supercoil VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        for program in ("supercoil", "supercoild", "supercoil-sim"):
            self.assertRegex(run(prefix / "bin" / program, "--version"),
                             rf"^{re.escape(release)}(\+git\d{{8}}\.\d{{6}}\.[0-9a-f]{{7,}})?\n$")


if __name__ == "__main__":
    names = ["Library.test_" + way for way in sys.argv[1:]] or None
    unittest.main(argv=sys.argv[:1], defaultTest=names)
