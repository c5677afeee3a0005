"""toolchain/sbom: its list of components matches the includes of our sources, the packages that CMake looks for and the
libraries that the programs are linked with; its output is CycloneDX that cyclonedx-python-lib reads."""

import fnmatch
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sysconfig
import tempfile
import unittest

from cyclonedx.model.bom import Bom
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from license_expression import get_spdx_licensing

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "toolchain" / "sbom"
SHIPPED = ("control", "identification", "hal", "firmware", "host_sim")  # what the programs are built from
SYSTEM = {"libc6-dev", "linux-libc-dev"}  # interfaces of the C library and of the kernel
HEADERS = ("/usr/include", "/usr/include/eigen3")
LOOKED_FOR = re.compile(r"\b(?:find_package|pkg_check_modules|find_library)\(([\w-]+)")


def module():
    loader = importlib.machinery.SourceFileLoader("sbom", str(PROGRAM))
    loaded = importlib.util.module_from_spec(importlib.util.spec_from_loader("sbom", loader))
    loader.exec_module(loaded)
    return loaded


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def files(*patterns):
    return (file for folder in SHIPPED for pattern in patterns for file in (ROOT / folder).rglob(pattern))


def owners(paths):
    """The Debian packages that install these files."""
    return {re.split("[:,]", line)[0] for line in output_of("dpkg-query", "-S", *paths).splitlines()}


def needed_libraries():
    found = set()
    for name in ("supercoild", "supercoil", "supercoil-sim"):
        program = pathlib.Path(os.environ["PROGRAMS"], name)
        found |= set(re.findall(r"NEEDED\s+(\S+)", output_of("objdump", "-p", program)))
    return {library for library in found if not re.match(r"lib(clang|asan|ubsan|tsan)", library)}


class Sbom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sbom = module()
        cls.components = cls.sbom.known_components()
        cls.packages = owners(f"*/{sysconfig.get_config_var('MULTIARCH')}/{library}" for library in needed_libraries())
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

    def package(self, *depends, name="supercoil"):
        control = self.folder / "root" / "DEBIAN" / "control"
        control.parent.mkdir(parents=True, exist_ok=True)
        architecture = output_of("dpkg", "--print-architecture").strip()
        control.write_text(f"Package: {name}\nVersion: 0.2.0+deb12\nArchitecture: {architecture}\n"
                           f"Maintainer: M <m@m.invalid>\nDepends: {', '.join(depends)}\n"
                           "Description: firmware and tools\n more\n")
        output_of("dpkg-deb", "--build", control.parents[1], self.folder / "p.deb")
        return subprocess.run(["/usr/bin/python3", PROGRAM, self.folder / "p.deb"], capture_output=True, text=True)

    def test_exactly_the_included_libraries_are_listed(self):
        names = {name for file in files("*.cpp", "*.hpp")
                 for name in re.findall(r"^#include <(.*)>", file.read_text(), re.M)}
        found = [path for name in names for path in (pathlib.Path(folder, name) for folder in HEADERS) if path.exists()]
        listed = [component["headers"] for component in self.components if "headers" in component]
        packages = owners(found) - SYSTEM
        matching = [fnmatch.filter(packages, pattern) for pattern in listed]
        self.assertEqual([pattern for pattern, some in zip(listed, matching, strict=True) if len(some) != 1], [])
        self.assertEqual(packages - set().union(*matching), set())

    def test_exactly_the_cmake_dependencies_are_listed(self):
        found = {name for file in files("CMakeLists.txt") for name in LOOKED_FOR.findall(file.read_text())}
        self.assertEqual(found - {"PkgConfig", "Threads"},
                         {component["cmake"] for component in self.components if "cmake" in component})

    def test_every_library_of_the_programs_is_listed_once(self):
        for package in self.packages:
            known = [component["name"] for component in self.components if self.sbom.has_library(component, package)]
            self.assertEqual(len(known), 1, package)

    def test_package_names_of_other_debian_releases_are_known(self):
        for package, name in (("libgpiod3", "libgpiod"), ("libtomlplusplus3t64", "toml++"),
                              ("libcpp-httplib0.18", "cpp-httplib"), ("libssl3t64", "OpenSSL"),
                              ("libstdc++6", "GNU C++ library"), ("libc6", "GNU C library")):
            self.assertEqual([c["name"] for c in self.components if self.sbom.has_library(c, package)], [name])
        self.assertFalse(any(self.sbom.has_library(c, "libgpiod-dev") for c in self.components))

    def test_licences_are_spdx(self):
        for component in self.components:
            validated = get_spdx_licensing().validate(component["licence"])
            self.assertEqual(validated.errors, [], component["name"])
        self.assertIn("License: Apache-2.0", (ROOT / "toolchain/debian/source/copyright").read_text())

    def test_notices_of_compiled_in_libraries_are_in_the_package(self):
        notices = (ROOT / "toolchain/debian/source/copyright").read_text()
        declarations_only = {"NLopt", "libgpiod"}  # their headers have no code
        for component in self.components:
            if "headers" not in component or component["name"] in declarations_only:
                continue
            self.assertRegex(notices, r"\nComment: " + re.escape(component["name"]) + r"\W")
            for licence in get_spdx_licensing().license_keys(component["licence"]):
                name = {"MIT": "Expat"}.get(licence, licence)  # Debian's name for it
                self.assertIn(f"\nLicense: {name}\n ", notices)

    def test_the_document_of_a_package_is_valid(self):
        done = self.package(*(f"{package} (>= 1.0)" for package in self.packages), "systemd")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIsNone(JsonStrictValidator(SchemaVersion.V1_6).validate_str(done.stdout))
        bom = Bom.from_json(json.loads(done.stdout))
        self.assertTrue(bom.validate())
        ours = bom.metadata.component
        self.assertEqual((ours.name, ours.version, *(licence.value for licence in ours.licenses)),
                         ("supercoil", "0.2.0+deb12", "Apache-2.0"))
        uses = {}
        for component in bom.components:
            self.assertEqual(len(component.licenses), 1, component.name)
            self.assertTrue(component.version or component.name == "systemd", component.name)
            use, = component.properties
            uses.setdefault(use.value, set()).add(component.name)
        self.assertEqual(uses["needed at run time"], self.packages | {"systemd"})
        self.assertEqual(len(uses["compiled in"]), 1 + sum(
            "headers" in component and "supercoil" in component.get("programs", ["supercoil"]) for component in self.components))
        self.assertIn("uplot", uses["compiled in"])
        our_dependencies = next(dependency for dependency in bom.dependencies if dependency.ref == ours.bom_ref)
        self.assertEqual({dependency.ref.value for dependency in our_dependencies.dependencies},
                         {component.bom_ref.value for component in bom.components})

    def test_a_package_lists_only_its_own_contents(self):
        for name, has, has_not in (("supercoil", {"uplot", "libcpp-httplib-dev", "libgpiod-dev"}, {"libnlopt-dev"}),
                                   ("supercoil-sim", {"uplot", "libcpp-httplib-dev", "libgpiod-dev", "libnlopt-dev"}, set())):
            done = self.package("libc6", name=name)
            listed = {component["name"] for component in json.loads(done.stdout)["components"]}
            self.assertLessEqual(has, listed)
            self.assertEqual(has_not & listed, set())

    def test_an_unlisted_dependency_is_an_error(self):
        done = self.package("libc6", "libfoo1")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("libfoo1, a dependency, has 0 entries", done.stderr)


if __name__ == "__main__":
    unittest.main()
