"""For tests on the simulated board in real time.

A busy machine may stop any of the programs for a second: a command may then expire, or a lease end, and the test begins
anew. Nothing is judged by the clock on the wall."""

import contextlib
import functools
import os
import pathlib

import supercoil

QUICK = pathlib.Path(__file__).with_name("quick.toml")
TRIES = 5
DEADLINE_S = 120.0  # for whatever takes a second on a machine that has nothing else to do
STARVED = (supercoil.faults.CommandTimeout, supercoil.NoAnswerError, supercoil.refusals.NotLeaseHolder,
           supercoil.DeadlineError, supercoil.PlaybackError, supercoil.refusals.NoLease)
with contextlib.suppress(PermissionError):  # root, as in a container: the fewer commands expire the sooner it is done
    os.setpriority(os.PRIO_PROCESS, 0, -15)


def patient(test):
    """Tries again where the test was starved. What it expects to be raised it must catch itself."""
    @functools.wraps(test)
    def tried(self):
        for attempt in range(TRIES):
            try:
                return test(self)
            except STARVED:
                if attempt + 1 == TRIES:
                    raise
                self.doCleanups()
                self.setUp()
    return tried


def patient_tests(case):
    """All of a class."""
    for name, test in list(vars(case).items()):
        if name.startswith("test_"):
            setattr(case, name, patient(test))
    return case
