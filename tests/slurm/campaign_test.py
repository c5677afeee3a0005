"""A campaign on a real Slurm: the bytes of one machine, although a program was killed and a job queued again.

    toolchain/slurm .venv/bin/python tests/slurm/campaign_test.py build/release/bin/supercoil-sim
"""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

PARTS = 8
RUNS = 80
# Each part takes some seconds: long enough to be killed in the middle.
STUDY = f"""# Brief
[study]
runs = {RUNS}
scenario = "real"
controllers = ["learned_ff", "pd_ff"]
[goals]
tracking_rms_m = 50e-6
[[draw]]
keys = "plant.heat_transfer_W_per_K"
uniform = [0.08, 0.1]
[[draw]]
keys = "plant.hysteresis_ratio"
uniform = [0.0, 0.1]
"""
DEADLINE_S = 150.0


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def wait_for(what, condition, deadline_s=DEADLINE_S):
    end = time.monotonic() + deadline_s
    while not (found := condition()):
        if time.monotonic() > end:
            sys.exit(f"{what}: not within {deadline_s:.0f} s\n{run('squeue')}")
        time.sleep(0.05)
    return found


def files(folder):
    """What a campaign leaves, without what brought it about."""
    return {path.name: path.read_bytes() for path in folder.iterdir()
            if path.suffix in (".csv", ".md", ".toml")}


def lines(part):
    """Runs in a part's file."""
    file = part / "runs.csv"
    return file.read_text().count("\n") - 2 if file.is_file() else 0


def program_of(part):
    """The process that works on it; None where none does."""
    for process in pathlib.Path("/proc").iterdir():
        try:
            words = (process / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"campaign" in words and part.encode() in words:
            return int(process.name)
    return None


def running():
    """Tasks of the array that are in the middle of their part, with their processes."""
    found = [(number, program_of(f"part-{number}")) for number in range(1, PARTS + 1)
             if 0 < lines(pathlib.Path(f"part-{number}")) < 2 * RUNS // PARTS - 4]
    return [(number, process) for number, process in found if process]


def main(simulator):
    folder = tempfile.TemporaryDirectory()
    os.chdir(folder.name)
    pathlib.Path("brief.toml").write_text(STUDY)
    print("on one machine", flush=True)
    run(simulator, "campaign", "brief.toml", "--out", "whole", "--quiet")
    print(f"as an array of {PARTS}", flush=True)
    said = run(simulator, "campaign", "brief.toml", "--out", "array", "--slurm", str(PARTS))
    print(said, end="")
    job = said.split()[1]
    os.chdir("array")

    (killed, process), (requeued, _) = wait_for("two tasks at work", lambda: len(two := running()) >= 2 and two[:2])
    os.kill(process, signal.SIGKILL)
    print(f"task {killed}: its program was killed after {lines(pathlib.Path(f'part-{killed}'))} runs")
    node = run("sinfo", "--noheader", "--format=%n").strip()
    run("scontrol", "update", f"nodename={node}", "state=drain", "reason=test")
    run("scontrol", "requeue", f"{job}_{requeued}")
    print(f"task {requeued}: queued again while the node drains, after {lines(pathlib.Path(f'part-{requeued}'))} runs")
    wait_for("the task off the node", lambda: program_of(f"part-{requeued}") is None)
    run("scontrol", "update", f"nodename={node}", "state=resume")

    # Slurm forgets nothing of a job for ten minutes here.
    restarts = "Restarts=1"
    wait_for("all parts and the merging", lambda: not run("squeue", "--noheader"))
    if restarts not in run("scontrol", "show", "job", f"{job}_{requeued}"):
        sys.exit(f"task {requeued} was not queued again")
    os.chdir("..")
    whole, array = files(pathlib.Path("whole")), files(pathlib.Path("array"))
    if whole != array:
        sys.exit(f"the array's files differ: {sorted(name for name in whole | array if whole.get(name) != array.get(name))}")
    print(f"{sorted(array)}: the same bytes as on one machine")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())
