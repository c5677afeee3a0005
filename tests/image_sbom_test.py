"""toolchain/image.d/sbom: every package of an image's files, with version and licences, as CycloneDX that
cyclonedx-python-lib reads."""

import gzip
import json
import pathlib
import subprocess
import tempfile
import unittest

from cyclonedx.model.bom import Bom
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "toolchain" / "image.d" / "sbom"
FIELDS = "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\nFiles: *\nLicense: {}\n\n" \
         "Files: debian/*\nLicense:  {}\n text\n\nLicense: {}\n text\n"


class ImageSbom(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name, "root")
        (self.root / "var/lib/dpkg").mkdir(parents=True)
        self.status = self.root / "var/lib/dpkg/status"
        self.status.touch()

    def install(self, package, version="1.0-1", state="installed"):
        with self.status.open("a") as status:
            status.write(f"Package: {package}\nStatus: install ok {state}\nMaintainer: M <m@m.invalid>\n"
                         f"Architecture: arm64\nVersion: {version}\nDescription: d\n\n")

    def document(self, package, text, root=None):
        folder = (root or self.root) / "usr/share/doc" / package
        folder.mkdir(parents=True)
        (folder / "copyright").write_text(text)
        return folder

    def listed(self, *others):
        done = subprocess.run(["/usr/bin/python3", PROGRAM, "supercoil-x-arm64", self.root, *others], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIsNone(JsonStrictValidator(SchemaVersion.V1_6).validate_str(done.stdout))
        bom = Bom.from_json(json.loads(done.stdout))
        self.assertTrue(bom.validate())
        self.assertEqual((bom.metadata.component.name, bom.metadata.component.version), ("supercoil-x-arm64", "0.2.0+deb12"))
        return {component.name: (component.version, {licence.name for licence in component.licenses}) for component in bom.components}

    def test_every_installed_package_is_listed_with_its_licences(self):
        self.install("supercoil", "0.2.0+deb12")
        self.document("supercoil", FIELDS.format("Apache-2.0", "Apache-2.0", "Apache-2.0"))
        self.install("libfoo1", "1:2.3~rc1-4")
        foo = self.document("libfoo1", FIELDS.format("GPL-2+  or MIT", "public-domain", "GPL-2+"))
        self.install("foo-common")  # its documents belong to another package
        (foo.parent / "foo-common").symlink_to("libfoo1")
        self.install("old")
        self.document("old", "See /usr/share/common-licenses/LGPL-2.1, and `/usr/share/common-licenses/GPL-2'.\n")
        self.install("prose")
        self.document("prose", "License: whoever likes it.\n")
        self.install("undocumented")
        self.install("removed", state="config-files")
        foo_licences = {"GPL-2+ or MIT", "public-domain", "GPL-2+"}
        self.assertEqual(self.listed(), {
            "supercoil": ("0.2.0+deb12", {"Apache-2.0"}), "libfoo1": ("1:2.3~rc1-4", foo_licences), "foo-common": ("1.0-1", foo_licences),
            "old": ("1.0-1", {"LGPL-2.1", "GPL-2"}), "prose": ("1.0-1", {"in /usr/share/doc/prose/copyright"}),
            "undocumented": ("1.0-1", {"in /usr/share/doc/undocumented/copyright"})})

    def test_an_unpacked_package_is_listed_too(self):
        self.install("supercoil", "0.2.0+deb12")
        firmware = self.root.parent / "firmware"
        folder = self.document("raspi-firmware", FIELDS.format("GPL-2", "GPL-2+", "Broadcom"), firmware)
        with gzip.open(folder / "changelog.Debian.gz", "wt") as changelog:
            changelog.write("raspi-firmware (1.20220830+ds-1) unstable; urgency=medium\n")
        self.assertEqual(self.listed(f"raspi-firmware={firmware}")["raspi-firmware"],
                         ("1.20220830+ds-1", {"GPL-2", "GPL-2+", "Broadcom"}))

    def test_an_image_without_supercoil_is_refused(self):
        self.install("libfoo1")
        done = subprocess.run(["/usr/bin/python3", PROGRAM, "x", self.root], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("supercoil is not installed", done.stderr)


if __name__ == "__main__":
    unittest.main()
