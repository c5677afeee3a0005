# Generated from docs/can.md by toolchain/generate-can. Do not edit.

"""An exception for each refusal."""

from supercoil.errors import RefusalError


class WrongState(RefusalError):
    """the command is not for the state or mode in which the channel is: arm needs disarmed, what heats needs armed or active, renew and rest need active, reset needs fault. Ten in a row are a fault"""

    number = 1
    name = "wrong_state"
    meaning = """\
the command is not for the state or mode in which the channel is: arm needs disarmed, what heats needs armed or active, renew and rest need active, reset needs fault. Ten in a row are a fault"""


class CausePersists(RefusalError):
    """reset: a detector of the channel or of the board still trips. Remove the cause first"""

    number = 2
    name = "cause_persists"
    meaning = """\
reset: a detector of the channel or of the board still trips. Remove the cause first"""


class NoEdge(RefusalError):
    """reset: there was one in the tick before, or in the same one. Send it again"""

    number = 3
    name = "no_edge"
    meaning = """\
reset: there was one in the tick before, or in the same one. Send it again"""


class NotReady(RefusalError):
    """the self-test has not passed yet, a reading is not there, the muscle's temperature is not known yet; of store: the estimates are not trusted"""

    number = 4
    name = "not_ready"
    meaning = """\
the self-test has not passed yet, a reading is not there, the muscle's temperature is not known yet; of store: the estimates are not trusted"""


class Busy(RefusalError):
    """a probe measures the heater, or another mode runs that has to end first: rest ends it"""

    number = 5
    name = "busy"
    meaning = """\
a probe measures the heater, or another mode runs that has to end first: rest ends it"""


class OutOfRange(RefusalError):
    """no such setting or place, a value outside of its range or any but 0 where none is defined, or rates that the bus has no room for. RefusedValue, right after the answer, has the refused value and the nearest that would have been obeyed"""

    number = 6
    name = "out_of_range"
    meaning = """\
no such setting or place, a value outside of its range or any but 0 where none is defined, or rates that the bus has no room for. RefusedValue, right after the answer, has the refused value and the nearest that would have been obeyed"""


class NoSuchChannel(RefusalError):
    """the board has no such channel"""

    number = 7
    name = "no_such_channel"
    meaning = """\
the board has no such channel"""


class NotLeaseHolder(RefusalError):
    """the session is not the one that holds the lease: another master's, or an earlier one"""

    number = 8
    name = "not_lease_holder"
    meaning = """\
the session is not the one that holds the lease: another master's, or an earlier one"""


class NoLease(RefusalError):
    """no master holds the lease: it was never claimed, or it ended"""

    number = 9
    name = "no_lease"
    meaning = """\
no master holds the lease: it was never claimed, or it ended"""


class WrongCounter(RefusalError):
    """the frame is a repetition, or more than three before it were lost. The next one is obeyed"""

    number = 10
    name = "wrong_counter"
    meaning = """\
the frame is a repetition, or more than three before it were lost. The next one is obeyed"""


class QueueFull(RefusalError):
    """more commands than the loop can take at once"""

    number = 11
    name = "queue_full"
    meaning = """\
more commands than the loop can take at once"""


class ClaimAgain(RefusalError):
    """the claim did not repeat the number that the board gave last, or too late. granted has the one to repeat"""

    number = 12
    name = "claim_again"
    meaning = """\
the claim did not repeat the number that the board gave last, or too late. granted has the one to repeat"""


class ProtocolMismatch(RefusalError):
    """the frame is of another version of the protocol"""

    number = 13
    name = "protocol_mismatch"
    meaning = """\
the frame is of another version of the protocol"""


class Unsuitable(RefusalError):
    """to tune: the prepared controller contradicts itself, or is unstable on the muscle that is known; the prepared estimator does not run in its arithmetic. To scale in a joint: both muscles read one sensor"""

    number = 14
    name = "unsuitable"
    meaning = """\
to tune: the prepared controller contradicts itself, or is unstable on the muscle that is known; the prepared estimator does not run in its arithmetic. To scale in a joint: both muscles read one sensor"""


class Infeasible(RefusalError):
    """to a knot of a trajectory: the way to it asks for more power than there is, or would have the muscle cooled"""

    number = 15
    name = "infeasible"
    meaning = """\
to a knot of a trajectory: the way to it asks for more power than there is, or would have the muscle cooled"""


BY_NUMBER: dict[int, type[RefusalError]] = {
    1: WrongState,
    2: CausePersists,
    3: NoEdge,
    4: NotReady,
    5: Busy,
    6: OutOfRange,
    7: NoSuchChannel,
    8: NotLeaseHolder,
    9: NoLease,
    10: WrongCounter,
    11: QueueFull,
    12: ClaimAgain,
    13: ProtocolMismatch,
    14: Unsuitable,
    15: Infeasible,
}
