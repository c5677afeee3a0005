"""The bookkeeping of toolchain/mutate: which mutants are sampled, which are left out, and the interval."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import areas
import parts
import results
import sample
import workshop

ROOT = pathlib.Path(__file__).resolve().parents[2]
EQUIVALENTS = pathlib.Path(__file__).parent / "equivalent"


class Interval(unittest.TestCase):
    def test_matches_the_literature(self):
        # Clopper and Pearson, Biometrika 26 (1934), table for n = 10 and 95 %.
        for killed, low, high in ((0, 0.0, 0.3085), (5, 0.1871, 0.8129), (10, 0.6915, 1.0)):
            found = results.interval(killed, 10)
            self.assertAlmostEqual(found[0], low, places=4)
            self.assertAlmostEqual(found[1], high, places=4)


class Sample(unittest.TestCase):
    def of_lines(self, count, lines):
        made = {i + 1: [sample.Mutant("a", i + 1, "x", f"{k}") for k in range(3)] for i in range(lines)}
        with mock.patch.object(sample, "mutants_of", return_value=made), \
                mock.patch.object(pathlib.Path, "read_text", return_value=""):
            return sample.strata(["a"], pathlib.Path(), count, 1)[0]

    def test_runs_partition_all_mutants_in_order(self):
        runs = self.of_lines(10, 47)
        self.assertEqual(len(runs), 10)
        self.assertEqual(sorted((m.line, m.after) for run in runs for m in run),
                         [(i + 1, str(k)) for i in range(47) for k in range(3)])
        for run, next_run in zip(runs, runs[1:]):
            self.assertLess(max(m.line for m in run), min(m.line for m in next_run))
            self.assertIn(len(run) // 3, (4, 5))

    def test_is_the_same_for_the_same_seed(self):
        self.assertEqual(self.of_lines(5, 20), self.of_lines(5, 20))

    def test_excludes_changes_of_texts_and_types(self):
        self.assertEqual(sample.squeezed('fail("a b", 1)'), sample.squeezed('fail("", 1)'))
        self.assertEqual(sample.squeezed("a;  // 5 %"), sample.squeezed("a;  // 6 %"))
        for before, after in (("Handle* h) {", "Handle% h) {"), ("std::vector<int> a;", "std::vector<=int> a;"),
                              ("std::int64_t a;", "std::int1_t a;"), ("int f() {", "/*int f() {*/"),
                              ("a = 0.5;", "a = 0.(5+1);"), ("  double a_ = 0;", "  /*double a_ = 0;*/"),
                              ("++a;", "+%a;")):
            self.assertFalse(sample.promising(before, after), after)
        for before, after in (("a = b * c;", "a = b / c;"), ("if (a < b)", "if (a <= b)"), ("a = 64;", "a = (64-1);"),
                              ("  f();", "  /*f();*/"), ("  a << b;", "  /*a << b;*/"), ("  return a;", "  /*return a;*/")):
            self.assertTrue(sample.promising(before, after), after)


class Kept(unittest.TestCase):
    """Which results of a run are kept when the same command is given again."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        first = self.opened(["a"])
        for number, verdict in enumerate(("killed", "survived", "invalid")):
            first.add(number, sample.Mutant("f", number, "x", verdict), "area", verdict, "", 1.0)

    def opened(self, tests, of="code", known=()):
        return results.Results(pathlib.Path(self.folder.name) / "r.jsonl", [of], {"t": tests}, known)

    def verdicts(self, *what, **how):
        return [row["verdict"] for row in self.opened(*what, **how).rows]

    def test_is_everything_when_nothing_changed(self):
        self.assertEqual(self.verdicts(["a"]), ["killed", "survived", "invalid"])

    def test_excludes_survivors_when_tests_were_added(self):
        self.assertEqual(self.verdicts(["b", "a", "c"]), ["killed", "invalid"])
        self.assertEqual(self.verdicts(["b", "a", "c"]), ["killed", "invalid"], "as it was stored")

    def test_is_empty_when_a_test_line_or_the_code_changed(self):
        self.assertEqual(self.verdicts(["b"]), [])
        self.assertEqual(self.verdicts(["a"], of="other code"), [])

    def test_excludes_survivors_listed_as_equivalent(self):
        self.assertEqual(self.verdicts(["a"], known={("f", "x", "survived")}), ["killed", "invalid"])


class Parts(unittest.TestCase):
    def test_contain_the_archive_members_that_the_linker_used(self):
        archives = {"l/a.a": {"x.o": ["l/x.o"], "y.o": ["l/y.o", "l/m/y.o"]}}
        for traced in ("t.o\nl/a.a(y.o)\n/usr/lib/c.a(x.o)\n", "t.o\n(l/a.a)y.o\n(/usr/lib/c.a)x.o\n"):
            self.assertEqual(list(parts.pulled(traced, archives)), ["l/y.o", "l/m/y.o"])

    def test_the_linker_reports_the_members_it_used(self):
        with tempfile.TemporaryDirectory() as folder:
            def run(*command):
                return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout
            for name, text in (("main", "int f(); int main() { return f(); }"), ("f", "int f() { return 0; }"),
                               ("g", "int g() { return 0; }")):
                (pathlib.Path(folder) / f"{name}.cpp").write_text(text)
                run("c++", "-c", f"{name}.cpp")
            run("ar", "qc", "a.a", "f.o", "g.o")
            traced = run("c++", *parts.TRACE, "main.o", "-o", "main", "a.a")
            self.assertEqual(list(parts.pulled(traced, {"a.a": {"f.o": ["f.o"], "g.o": ["g.o"]}})), ["f.o"])

    def test_named_like_a_file_are_nearest_to_it(self):
        def distance(name, source=""):
            return parts.Part("p", name, frozenset(), [], pathlib.Path(name), source).distance("board/heat.hpp")
        ordered = [distance("heat_test"), distance("heat_late_test"), distance("x_test", '#include "board/heat.hpp"'),
                   distance("x_test", '#include "board/known_heat.hpp"')]
        self.assertEqual(ordered, sorted(set(ordered)))


class Judged(unittest.TestCase):
    def test_code_of_a_header_is_known_before_its_objects_are_compiled(self):
        with tempfile.TemporaryDirectory() as folder:
            shop = workshop.Workshop(ROOT, pathlib.Path(folder) / "0", (), 1, {})
            for there in (shop.tree, shop.build):
                there.mkdir()
            (shop.tree / "h.hpp").write_text("inline int f(int a) { return a > 3 ? a : 7; }\nstruct S;\n")
            (shop.tree / "with.cpp").write_text('#include "h.hpp"\nint g(int a) { return f(a) * f(a + 1); }\n')
            (shop.tree / "without.cpp").write_text('#include "h.hpp"\nint k() { return 1; }\n')
            (shop.tree / "h.cpp").write_text('#include "h.hpp"\nint own() { return 2; }\n')
            (shop.build / "build.ninja").write_text(
                "rule cxx\n command = c++ -O0 -g1 -MD -MF $out.d -c $in -o $out\n depfile = $out.d\n deps = gcc\n"
                + "".join(f"build {name}.o: cxx {shop.tree}/{name}.cpp\n" for name in ("with", "without", "h")).replace("build h.o:", "build h.cpp.o:"))
            shop.ninja(["with.o", "without.o", "h.cpp.o"], check=True)
            shop.read_dependencies()
            shop.lock.close()
            (shop.build / "with.o").unlink()
            self.assertEqual(shop.objects("h.hpp"), {"with.o", "without.o", "h.cpp.o"})
            # Its own source has no line of it, but shows whether a changed declaration compiles.
            self.assertEqual(shop.objects_with_code("h.hpp"), {"with.o", "h.cpp.o"})

    def judge(self, *verdicts):
        shop = mock.Mock(spec=workshop.Workshop)
        shop.judge_by.side_effect = [(verdict, "") for verdict in verdicts]
        return workshop.Workshop.judge(shop, mock.Mock(file="f.hpp"), (), 1.0)[0]

    def test_code_in_no_program_survives(self):
        self.assertEqual(self.judge("in no program", "in no program"), "survived")
        self.assertEqual(self.judge("same code", "killed"), "killed")
        self.assertEqual(self.judge("same code", "same code"), "same code")

    def test_survives_only_if_no_including_file_notices(self):
        self.assertEqual(self.judge("survived", "killed"), "killed")
        self.assertEqual(self.judge("survived", "invalid"), "invalid")
        self.assertEqual(self.judge("survived", "survived"), "survived")


class Equivalents(unittest.TestCase):
    def test_refer_to_existing_lines(self):
        for file, before, after in results.equivalents(EQUIVALENTS):
            lines = [line.strip() for line in (ROOT / file).read_text().splitlines()]
            self.assertIn(before, lines, f"{file}: an equivalent is listed of a line that is gone")
            self.assertNotEqual(before, after)

    def test_every_area_has_files(self):
        for area in areas.AREAS:
            for pattern in area.patterns:
                self.assertTrue(any(ROOT.glob(pattern)), f"{area.name}: {pattern} matches no file")


if __name__ == "__main__":
    sys.exit(unittest.main())
