"""Completion in bash, zsh and fish: it matches the current --help, and each shell offers it.

    completion_test.py PROGRAMS      the folder of the built programs
"""

import os
import pathlib
import pty
import select
import shlex
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
KEPT = ROOT / "firmware/apps/completion"
PROGRAMS = sys.argv.pop(1)
# The typed text and a word that must be among those offered; "" stands for the name of a file.
OFFERED = (
    (["supercoil", "doct"], ["doctor"]),
    (["supercoil", "--ver"], ["--version"]),
    (["supercoil", "tune", "1", "--from", "con"], ["configured"]),
    (["supercoil", "command", "1", "cali"], ["calibrate"]),
    (["supercoil", "log", "--sum"], ["--summary"]),
    (["supercoil-sim", "run", "first"], ["first-motion"]),
    (["supercoil-sim", "run", "sine", "--real"], ["--real-time"]),
    (["supercoil-sim", "run", "my-"], ["my-muscle.toml"]),
    (["supercoild", "--lat"], ["--latency"]),
    (["supercoild", "--config", "my-"], ["my-muscle.toml"]),
)


class Completion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="supercoil-completion-")
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        (self.path / "my-muscle.toml").touch()

    def test_matches_the_programs(self):
        subprocess.run([ROOT / "toolchain/generate-completion", PROGRAMS, self.path], check=True)
        for kept in KEPT.glob("*/*"):
            name = kept.relative_to(KEPT)
            self.assertEqual(kept.read_text(), (self.path / name).read_text(), f"{name}: run toolchain/generate-completion")

    def test_bash(self):
        """Calls the function as bash's completion does; if it offers nothing, bash completes files."""
        for words, wanted in OFFERED:
            with self.subTest(" ".join(words)):
                script = (f"source {KEPT}/bash/{words[0]}; COMP_WORDS=({shlex.join(words)}); COMP_CWORD={len(words) - 1}; "
                          f"_{words[0].replace('-', '_')}; [ ${{#COMPREPLY[@]}} -gt 0 ] || mapfile -t COMPREPLY < <(compgen -f -- {words[-1]}); "
                          'printf "%s\\n" "${COMPREPLY[@]}"')
                self.assertEqual(self.offered_by("bash", "--norc", "-c", script), wanted)

    def test_bash_after_an_equals_sign(self):
        script = (f"source {KEPT}/bash/supercoil; COMP_WORDS=(supercoil tune 1 --from =); COMP_CWORD=4; _supercoil; "
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        self.assertEqual(self.offered_by("bash", "--norc", "-c", script), ["in_use", "configured", "stored", "prepared"])

    def test_fish(self):
        for words, wanted in OFFERED:
            with self.subTest(" ".join(words)):
                script = f"source {KEPT}/fish/{words[0]}.fish; complete -C {shlex.quote(' '.join(words))}"
                offered = [line.split("\t")[0] for line in self.offered_by("fish", "--no-config", "-c", script)]
                self.assertEqual(offered, wanted)

    def offered_by(self, *command):
        done = subprocess.run(command, cwd=self.path, check=True, capture_output=True, text=True, timeout=60,
                              env={"PATH": os.environ["PATH"], "HOME": str(self.path)})
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines()

    def test_zsh(self):
        """Works only on a terminal: a key completes the line and writes it to a file."""
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.path)
            os.execvpe("zsh", ["zsh", "-f", "-i"], {"PATH": os.environ["PATH"], "HOME": str(self.path), "TERM": "xterm"})
        self.addCleanup(os.close, terminal)
        completed = self.path / "line"
        self.type(terminal, f"fpath=({KEPT}/zsh $fpath); autoload -Uz compinit; compinit -u -D; "
                  f"complete-and-tell() {{ zle complete-word; print -r -- $BUFFER >{completed}.new; mv {completed}.new {completed} }}; "
                  "zle -N complete-and-tell; bindkey '^T' complete-and-tell; touch ready\n", self.path / "ready")
        for words, wanted in OFFERED:
            with self.subTest(" ".join(words)):
                self.type(terminal, " ".join(words) + "\x14", completed)
                line = completed.read_text().split()
                completed.unlink()
                self.type(terminal, "\x15")  # an empty line for the next text
                self.assertEqual(line, [*words[:-1], wanted[0]])

    def type(self, terminal, text, until_there=None, patience_s=60.0):
        os.write(terminal, text.encode())
        end = time.monotonic() + patience_s
        while until_there and not until_there.exists():
            self.assertLess(time.monotonic(), end, f"{text!r} had no answer")
            if select.select([terminal], [], [], 0.02)[0]:
                os.read(terminal, 4096)  # otherwise it would wait for a reader


if __name__ == "__main__":
    unittest.main()
