"""Two boards on one CAN bus (two_boards_up in guest/functions), as their tests see them."""

import argparse
import re

import rig
import witness
from table import Table

OLD = ("can.log", "witness-2")  # what a run leaves in the share


def test(about, script, judge, prepare=lambda share: None, **settings):
    """The program of a test. prepare(share) comes before the board, judge(table, run, share) after it."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    rig.add_architecture(parser)
    board = rig.Settings(parser.parse_args().architecture, f"{script}_test", watchdog=True, can=3, **settings)
    board.share.mkdir(parents=True, exist_ok=True)
    for old in OLD:
        (board.share / old).unlink(missing_ok=True)
    prepare(board.share)
    table = Table()
    table.judge(script, lambda t, r: judge(t, r, board.share), rig.run(rig.HERE / "scripts" / script, (), board))
    table.end()


def looks(run, share):
    """The looks of the first board's witness, and of the second's."""
    return witness.looks(run.witness), witness.looks((share / "witness-2").read_text().splitlines())


def exit_statuses(console):
    """Exit status by what ended with it."""
    lines = re.findall(r"^(arm \d|arm dead \d|held \d|played|drifted|local|first ended with|second ended with) (\d+)$", console, re.M)
    return {what: int(status) for what, status in lines}


def judge_begin(table, run, ended):
    table.row("the script ended with", run.status, 0, 0, "")
    for node in (5, 9):
        table.row(f"arm {node} ended with", ended[f"arm {node}"], 0, 0, "")


def judge_end(table, console, ended):
    errors = [int(count) for count in re.findall(r"^errors can\d (\d+)$", console, re.M)]
    table.row("errors that three controllers counted", sum(errors) if len(errors) == 3 else None, 0, 0, "")
    for which in ("first", "second"):
        table.row(f"SIGTERM ended the {which} with", ended[f"{which} ended with"], 0, 0, "")
