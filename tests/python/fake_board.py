"""A board that answers by a script, on a virtual bus of python-can: for what the simulated board does not do."""

import threading

import can

from supercoil import PROTOCOL_VERSION, codec, e2e
from supercoil.generated import messages

NODE = 5
SESSION = 77  # that Leased grants


class FakeBoard:
    """obey(opcode name, value, session) -> (refusal, granted), or None: no answer."""

    def __init__(self, channel, obey=lambda *_: (0, 0), version=PROTOCOL_VERSION, **status):
        self.obey = obey
        self.version = version
        self.status = status
        self.bus = can.Bus(interface="virtual", channel=channel)
        self.commands = []
        self.tuned = []
        self.refuse_tuning = 0
        self.damage_answers = False
        # Knot or Play -> what Trajectory reports, or None: no answer.
        self.playback = lambda *_: None
        self.trajectory = []
        self.synced = []
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def end(self):
        self._ended.set()
        self._thread.join()
        self.bus.shutdown()

    def send(self, base, protected=False, **values):
        identifier = base | NODE
        data = codec.encode(codec.LAYOUTS[base], values)
        if protected:
            data = e2e.protected(identifier, data)
            if self.damage_answers:
                data = data[:-1] + bytes([data[-1] ^ 1])
        self.bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))

    def _run(self):
        while not self._ended.is_set():
            self.send(messages.STATUS, protocol_version=self.version, **self.status)
            frame = self.bus.recv(0.02)
            while frame is not None:
                self._take(frame)
                frame = self.bus.recv(0.0)

    def _take(self, frame):
        if frame.arbitration_id == messages.TUNING_WRITE | NODE:
            write = codec.decode(messages.TUNING_WRITE, bytes(frame.data))
            assert e2e.is_intact(frame.arbitration_id, bytes(frame.data))
            self.tuned.append((write.tunable.name, write.value, write.session_low, write.counter))
            # A read's answer and another value's come first.
            for counter, tunable, refusal in ((0, write.tunable, 9), (write.counter, 30, 9),
                                              (write.counter, write.tunable, self.refuse_tuning)):
                self.send(messages.TUNING, protected=True, counter=counter, place=write.place, tunable=tunable,
                          refusal=refusal, set=0, value=write.value)
        if frame.arbitration_id == messages.SYNC | 1:
            assert e2e.is_intact(frame.arbitration_id, bytes(frame.data))
            self.synced.append(codec.decode(messages.SYNC, bytes(frame.data)).sync)
        if frame.arbitration_id in (messages.KNOT | NODE, messages.PLAY | NODE):
            self._take_trajectory(frame)
        if frame.arbitration_id != messages.COMMAND | NODE:
            return
        command = codec.decode(messages.COMMAND, bytes(frame.data))
        assert e2e.is_intact(frame.arbitration_id, bytes(frame.data))
        self.commands.append((command.opcode.name, command.value, command.session, command.counter))
        answer = self.obey(command.opcode.name, command.value, command.session)
        if answer is not None:
            self.send(messages.ACKNOWLEDGE, protected=True, counter=command.counter, opcode=command.opcode,
                      session=command.session, refusal=answer[0], granted=answer[1])

    def _take_trajectory(self, frame):
        base = frame.arbitration_id & codec.BASE_MASK
        received = codec.decode(base, bytes(frame.data))
        session = SESSION if base == messages.KNOT else received.session
        of_checksum = (session,) if base == messages.KNOT else ()
        assert frame.data[0] == e2e.checksum(frame.arbitration_id, bytes(frame.data), *of_checksum)
        self.trajectory.append(received)
        if (answer := self.playback(received)) is not None:
            self.send(messages.TRAJECTORY, protected=True, counter=received.counter, session_low=session & 0xFF,
                      answers=1 if base == messages.KNOT else 2, **answer)


class Leased:
    """A board that grants SESSION after one claim_again with number 1234; all else is obeyed."""

    def __init__(self):
        self.leased = False
        self.refuse = {}  # opcode -> refusals to come

    def __call__(self, opcode, value, session):
        if waiting := self.refuse.get(opcode):
            return waiting.pop(0), 0
        if opcode == "lease":
            if value == -1.0:
                self.leased = False
            elif not self.leased and value != 1234:
                return messages.names.Refusal.claim_again, 1234
            else:
                self.leased = True
            return 0, SESSION
        if opcode == "disarm":
            return 0, 0
        if not self.leased:
            return messages.names.Refusal.no_lease, 0
        return (0, 0) if session == SESSION else (messages.names.Refusal.not_lease_holder, 0)
