"""toolchain/version: its output with and without tags, in a shallow clone and without git; for Debian the version of a
newer commit is newer."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROJECT = "project(supercoil VERSION {} LANGUAGES CXX)\n"


def output_of(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout.strip()


class Version(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name, "tree")
        (self.tree / "toolchain").mkdir(parents=True)
        shutil.copy(ROOT / "toolchain" / "version", self.tree / "toolchain")
        self.is_of("0.2.0")

    def is_of(self, release):
        (self.tree / "CMakeLists.txt").write_text(PROJECT.format(release))

    def git(self, *arguments, when="2026-11-22T15:02:33+0000"):
        # Without this machine's settings, and without a repository around the test.
        return output_of("git", "-C", self.tree, "-c", "user.name=N", "-c", "user.email=n@n.invalid", *arguments,
                         env={"PATH": os.environ["PATH"], "GIT_CONFIG_NOSYSTEM": "1", "HOME": str(self.tree.parent),
                              "GIT_AUTHOR_DATE": when, "GIT_COMMITTER_DATE": when})

    def commit(self, when="2026-11-22T15:02:33+0000"):
        if not (self.tree / ".git").exists():
            self.git("init", "--quiet", "--initial-branch=main")
        self.git("add", ".")
        self.git("commit", "--quiet", "--allow-empty", "--message=m", when=when)
        return self.git("rev-parse", "--short=7", "HEAD")

    def version(self, tree=None):
        # In a different time zone from the commit's, and not in UTC.
        return output_of((tree or self.tree) / "toolchain" / "version", env={"PATH": os.environ["PATH"], "TZ": "JST-9"})

    def assert_older(self, older, newer):
        self.assertEqual(subprocess.run(["dpkg", "--compare-versions", older, "lt", newer]).returncode, 0,
                         f"{older} is not older than {newer}")

    def test_without_git_the_version_is_the_release(self):
        self.assertEqual(self.version(), "0.2.0")

    def test_an_untagged_commit_has_time_and_hash(self):
        commit = self.commit()
        self.assertEqual(self.version(), f"0.2.0+git20261122.150233.{commit}")

    def test_only_the_matching_tag_makes_a_release(self):
        self.commit()
        self.git("tag", "v0.1.0")
        self.assertIn("+git", self.version())
        self.git("tag", "--annotate", "--message=m", "v0.2.0")
        self.assertEqual(self.version(), "0.2.0")

    def test_a_shallow_clone_has_time_and_hash(self):
        self.commit()
        self.git("tag", "v0.1.0")
        commit = self.commit("2026-11-23T08:00:00+0000")
        shallow = self.tree.parent / "shallow"
        self.git("clone", "--quiet", "--depth=1", "--no-tags", f"file://{self.tree}", shallow)
        self.assertEqual(self.version(shallow), f"0.2.0+git20261123.080000.{commit}")

    def test_a_later_commit_is_newer_in_any_time_zone(self):
        self.commit("2026-11-22T15:02:33+0900")
        first = self.version()
        self.commit("2026-11-22T10:00:00-0300")  # seven hours later, although its local time is earlier
        self.assert_older(first, self.version())

    def test_a_release_sorts_between_its_neighbours(self):
        self.commit()
        before = self.version()
        self.is_of("0.3.0")
        self.commit()
        self.git("tag", "v0.3.0")
        release = self.version()
        self.assertEqual(release, "0.3.0")
        self.commit("2026-11-23T08:00:00+0000")
        self.assert_older(before, release)
        self.assert_older(release, self.version())


if __name__ == "__main__":
    unittest.main()
