"""For tests on the simulated board in real time.

A busy machine may stop any of the programs for a second: a command may then expire, or a lease end, and the test begins
again. Nothing is judged by wall-clock time."""

import contextlib
import functools
import os
import pathlib

import supercoil

QUICK = pathlib.Path(__file__).with_name("quick.toml")
TRIES = 5
DEADLINE_S = 120.0  # for what takes a second on an idle machine
STARVED = (supercoil.faults.CommandTimeout, supercoil.NoAnswerError, supercoil.refusals.NotLeaseHolder,
           supercoil.DeadlineError, supercoil.PlaybackError, supercoil.refusals.NoLease)
with contextlib.suppress(PermissionError):  # root, as in a container: fewer commands expire, so it ends sooner
    os.setpriority(os.PRIO_PROCESS, 0, -15)


def patient(test):
    """Tries again when the test was starved. The test must itself catch the exceptions that it expects."""
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
    """Makes all tests of a class patient."""
    for name, test in list(vars(case).items()):
        if name.startswith("test_"):
            setattr(case, name, patient(test))
    return case
