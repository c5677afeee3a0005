#!/usr/bin/env python3
"""The package on the image, while a muscle tracks: upgraded by dpkg, then removed.

Each time supercoild must cut the heat while its heartbeat still beats, and nothing may be driven until it is back,
disarmed. The plant's witness sees this from outside of the board. Prints what was measured; exits with 1 if any of it is
wrong, 2 if the board did not do its part.

    tests/hil/upgrade_test.py
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import image
import image_test
import rig
import witness
from table import Table

MARK_MS = 10.0
START_S = 60.0  # dpkg and systemd on this processor
SELF_TEST_S = 0.25  # the first half of it drives each line alone, before the heartbeat (docs/safety.md)


def newer_package(to):
    """The package of this tree once more, with a higher version."""
    package = next((rig.ROOT / "build" / "bookworm-arm64").glob("supercoil_*_arm64.deb"))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["dpkg-deb", "-R", package, folder], check=True)
        control = pathlib.Path(folder) / "DEBIAN" / "control"
        control.write_text(re.sub(r"(?m)^(Version: .*)$", r"\1.1", control.read_text()))
        subprocess.run(["dpkg-deb", "--build", "--root-owner-group", "-Zgzip", folder, to], check=True, stdout=subprocess.DEVNULL)


def heating(look):
    return any(channel.power_W > 0 for channel in look.channels)


def driven(look):
    return any(channel.duty > 0 or channel.enable for channel in look.channels)


def end_of(table, what, looks, began_s, over_s):
    """Rows of one end of supercoild, and the looks from its last edge until it beats again."""
    before = [look for look in looks if began_s - 1 <= look.time_s < began_s - MARK_MS / 1e3]
    table.row(f"{what}: the muscle was heated before, by", max(look.channels[0].power_W for look in before), 0.3, 4.5, "W")
    after = [look for look in looks if began_s - MARK_MS / 1e3 <= look.time_s]
    off = next(look for look in after if not heating(look))
    opened = next(look for look in after if not look.closed)
    table.row("    off by enable and duty, after", off.time_s - began_s, -MARK_MS / 1e3, START_S, "s")
    table.row("        and then the heartbeat still beat for", (opened.edge_s - off.time_s) * 1e3, 0, 1000, "ms")
    table.row("    heated again until it is over", sum(heating(look) for look in after if off.time_s < look.time_s <= over_s), 0, 0, "looks")
    silent = [look for look in after if look.edges == opened.edges and look.time_s >= opened.time_s]
    zero = next((look for look in silent if not driven(look)), None)
    table.row("    duties and enables at 0, after", zero and zero.time_s - opened.edge_s, 0, 10, "s")
    still = [look for look in silent if zero and zero.time_s < look.time_s < silent[-1].time_s - SELF_TEST_S]
    table.row("        and driven again before the next self-test", sum(driven(look) for look in still), 0, 0, "looks")
    return silent


def judge(table, run):
    marks, _ = witness.marks_and_reads(run.console)
    looks = witness.looks(run.witness)
    console = run.console.replace("\r", "")
    table.row("the script ended with", run.status, 0, 0, "")
    silent = end_of(table, "upgrade", looks, marks["upgrade"], marks["upgrade_over"])
    table.row("    disarmed again after", marks["upgrade_over"] - marks["upgrade"], 0, 2 * START_S, "s")
    table.row("        of which without a heartbeat", silent[-1].time_s - silent[0].edge_s, 0, 2 * START_S, "s")
    old, new = re.findall(r"^version (\S+)", console, re.M)
    table.row(f"    {old} is {new}", new == f"{old}.1", 1, 1, "")
    table.row("    dpkg ended well, another process runs", "upgrade ended with 0" in console and "another process" in console, 1, 1, "")
    # No heartbeat follows: judged until the board is switched off.
    end_of(table, "removal", looks, marks["remove"], looks[-1].time_s)
    table.row("    dpkg ended well, programs gone, board.toml kept", "removal ended with 0" in console and "programs gone" in console and
              "board kept" in console, 1, 1, "")
    table.row("    looks at the cold board after it", sum(look.time_s > marks["remove_over"] for look in looks), 100, 10000, "")


def main():
    table = Table()
    try:
        card = image.prepared("upgrade_test")
    except OSError as error:
        sys.exit(f"upgrade_test: {error}")
    share = rig.BUILD / "upgrade_test"
    share.mkdir(exist_ok=True)
    newer_package(share / "newer.deb")
    # Without a bus, which costs this processor more than all the rest.
    image.put_board(card, image_test.board_toml().split("[can]")[0])
    run = image.run("upgrade", (), rig.Settings(share=share, watchdog=True, can=2, image=card, time_out_s=3600.0))
    table.judge("upgrade", judge, run)
    table.end()


if __name__ == "__main__":
    main()
