# Generated from docs/can.md by toolchain/generate-can. Do not edit.

"""An exception for each refusal."""

from supercoil.errors import RefusalError


class WrongState(RefusalError):
    """the channel's state or mode does not allow the command: arm needs disarmed, commands to heat need armed or active, renew and rest need active, reset needs fault. Ten in a row are a fault"""

    number = 1
    name = "wrong_state"
    meaning = """\
the channel's state or mode does not allow the command: arm needs disarmed, commands to heat need armed or active, renew and rest need active, reset needs fault. Ten in a row are a fault"""


class CausePersists(RefusalError):
    """reset: a detector of the channel or of the board still trips. Remove the cause first"""

    number = 2
    name = "cause_persists"
    meaning = """\
reset: a detector of the channel or of the board still trips. Remove the cause first"""


class NoEdge(RefusalError):
    """reset: there was another one of this channel in the tick before, or in the same tick. Send it again. (In a joint or a bundle each channel may send one: it resets all of them, and all get the same answer)"""

    number = 3
    name = "no_edge"
    meaning = """\
reset: there was another one of this channel in the tick before, or in the same tick. Send it again. (In a joint or a bundle each channel may send one: it resets all of them, and all get the same answer)"""


class NotReady(RefusalError):
    """the self-test has not passed yet, a reading is missing, or the muscle's temperature is not known yet; to store: the estimates are not trusted"""

    number = 4
    name = "not_ready"
    meaning = """\
the self-test has not passed yet, a reading is missing, or the muscle's temperature is not known yet; to store: the estimates are not trusted"""


class Busy(RefusalError):
    """a probe is measuring the heater, or another mode must end first: rest ends it"""

    number = 5
    name = "busy"
    meaning = """\
a probe is measuring the heater, or another mode must end first: rest ends it"""


class OutOfRange(RefusalError):
    """there is no such setting or place; the value is outside its range, or not 0 for a command without a value; or the bus has no room for the rates. RefusedValue, right after the answer, has the refused value and the nearest that would have been obeyed"""

    number = 6
    name = "out_of_range"
    meaning = """\
there is no such setting or place; the value is outside its range, or not 0 for a command without a value; or the bus has no room for the rates. RefusedValue, right after the answer, has the refused value and the nearest that would have been obeyed"""


class NoSuchChannel(RefusalError):
    """the board has no such channel"""

    number = 7
    name = "no_such_channel"
    meaning = """\
the board has no such channel"""


class NotLeaseHolder(RefusalError):
    """another session holds the lease: another master's, or a later one of yours"""

    number = 8
    name = "not_lease_holder"
    meaning = """\
another session holds the lease: another master's, or a later one of yours"""


class NoLease(RefusalError):
    """no master holds the lease: it was never claimed, or it ended"""

    number = 9
    name = "no_lease"
    meaning = """\
no master holds the lease: it was never claimed, or it ended"""


class WrongCounter(RefusalError):
    """the frame is a repetition, or more than three frames before it were lost. The next one is obeyed"""

    number = 10
    name = "wrong_counter"
    meaning = """\
the frame is a repetition, or more than three frames before it were lost. The next one is obeyed"""


class QueueFull(RefusalError):
    """more commands than the loop can take at once"""

    number = 11
    name = "queue_full"
    meaning = """\
more commands than the loop can take at once"""


class ClaimAgain(RefusalError):
    """the claim did not repeat the board's last number, or came too late. granted has the number to repeat"""

    number = 12
    name = "claim_again"
    meaning = """\
the claim did not repeat the board's last number, or came too late. granted has the number to repeat"""


class ProtocolMismatch(RefusalError):
    """the frame is of another version of the protocol"""

    number = 13
    name = "protocol_mismatch"
    meaning = """\
the frame is of another version of the protocol"""


class Unsuitable(RefusalError):
    """to tune: the prepared controller contradicts itself, or is unstable on the muscle that is known; the prepared estimator does not run in its arithmetic. To scale in a joint, whose scale is configured, and for a channel of a bundle that does not lead"""

    number = 14
    name = "unsuitable"
    meaning = """\
to tune: the prepared controller contradicts itself, or is unstable on the muscle that is known; the prepared estimator does not run in its arithmetic. To scale in a joint, whose scale is configured, and for a channel of a bundle that does not lead"""


class Infeasible(RefusalError):
    """to a knot of a trajectory: the way to it needs more power than there is, or faster cooling"""

    number = 15
    name = "infeasible"
    meaning = """\
to a knot of a trajectory: the way to it needs more power than there is, or faster cooling"""


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
