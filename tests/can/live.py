"""A simulated board in real time, and masters that command it over socketcand.

Nothing here is judged by wall-clock time: a busy machine may stop any of the programs for a second. A command may
then expire, or a lease end; masters notice and begin again.
"""

import contextlib
import os
import pathlib
import re
import signal
import subprocess
import time
import typing

import can
import cantools

import e2e

PROTOCOL = cantools.database.load_file(pathlib.Path(__file__).resolve().parents[2] / "firmware/io/can/supercoil.dbc")
COMMAND = PROTOCOL.get_message_by_name("Command")
SETTING_WRITE = PROTOCOL.get_message_by_name("SettingWrite")
SETTING_READ = PROTOCOL.get_message_by_name("SettingRead")
FROM_BOARD = {message.frame_id: message for message in PROTOCOL.messages if "Board" in message.senders}
DEADLINE_S = 120.0  # for what takes a second on an idle machine
TRIES = 5
can.log.setLevel("CRITICAL")  # it warns of each frame that TCP brings in two parts
with contextlib.suppress(PermissionError):  # root, as in a container: fewer commands expire, so it ends sooner
    os.setpriority(os.PRIO_PROCESS, 0, -15)


class Simulator:
    def __init__(self, folder, scenario="bench", *options):
        self.out = pathlib.Path(folder) / "out"
        self.process = subprocess.Popen(
            [os.environ["SUPERCOIL_SIM"], "run", scenario, "--real-time", "--can", "socketcand:0", "--out", self.out,
             *options],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        first = self.process.stdout.readline()
        self.port = int(re.fullmatch(r"serving can0 on 127\.0\.0\.1:(\d+) by the socketcand protocol\n", first)[1])

    def end(self, how=signal.SIGINT):
        """Its exit status; a second call only returns it again."""
        if self.process.returncode is None:
            self.process.send_signal(how)
            self.process.communicate(timeout=DEADLINE_S)
        return self.process.returncode


def join(port):
    """A bus. python-can needs < ok > alone, and fails when it was kept from reading it for too long; and a simulator
    that serves the max number of programs notices a moment later that one has gone."""
    for _ in range(TRIES):
        try:
            return can.Bus(interface="socketcand", host="127.0.0.1", port=port, channel="can0")
        except can.CanError as error:
            reason = error
            time.sleep(0.2)
    raise reason


class ReceivedMessage(typing.NamedTuple):
    message: str
    signals: dict
    time_s: float  # on the bus, by the board's clock


class Master:
    def __init__(self, port, name=0x1234):
        self.bus = join(port)
        self.name = self.session = name
        self.counter = 0
        self.commands_made = 0
        self.newest = {}  # signals of each message
        self.answers = []
        self.faults = []

    def data(self, opcode, value=0.0):
        """The data of the next command."""
        self.counter = (self.counter + 1) % 16
        self.commands_made += 1
        return e2e.protected(COMMAND.frame_id, COMMAND.encode(
            {"crc": 0, "counter": self.counter, "opcode": opcode, "session": self.session, "value": value}))

    def send(self, data):
        self.bus.send(can.Message(arbitration_id=COMMAND.frame_id, data=data, is_extended_id=False))

    def receive(self):
        """The board's next message, or None: it was somebody else's."""
        frame = self.bus.recv(DEADLINE_S)
        if frame is None:
            raise AssertionError("the board is silent")
        if frame.arbitration_id not in FROM_BOARD:
            return None
        message = FROM_BOARD[frame.arbitration_id]
        signals = {name: value if isinstance(value, (int, float)) else str(value)
                   for name, value in message.decode(frame.data).items()}
        self.newest[message.name] = signals
        if message.name == "Acknowledge":
            self.answers.append(signals)
        if message.name == "Emergency" and signals["fault"] != "none":
            self.faults.append(signals["fault"])
        return ReceivedMessage(message.name, signals, frame.timestamp)

    def receive_until(self, wanted):
        """The first message that is wanted."""
        end = time.monotonic() + DEADLINE_S
        while time.monotonic() < end:
            received = self.receive()
            if received and wanted(received):
                return received
        raise AssertionError("never heard")

    def receive_next(self, message, count=1):
        """The board sends them at known rates, so counting them is waiting by its clock."""
        for _ in range(count):
            received = self.receive_until(lambda received: received.message == message)
        return received

    def request(self, opcode, value=0.0):
        """A command's answer."""
        self.send(self.data(opcode, value))
        mine = {"opcode": opcode, "counter": self.counter, "session": self.session}
        return self.receive_until(
            lambda received: received.message == "Acknowledge" and mine.items() <= received.signals.items())

    def receive_setting(self, counter, name):
        mine = {"counter": counter, "setting": name, "session_low": counter and self.session & 0xFF}
        return self.receive_until(
            lambda received: received.message == "Setting" and mine.items() <= received.signals.items()).signals

    def write_setting(self, name, value):
        self.counter = self.counter % 15 + 1  # never 0, which is a read's
        self.bus.send(can.Message(arbitration_id=SETTING_WRITE.frame_id, is_extended_id=False, data=e2e.protected(
            SETTING_WRITE.frame_id, SETTING_WRITE.encode({"crc": 0, "counter": self.counter, "setting": name,
                                                          "session": self.session, "value": value}))))
        return self.receive_setting(self.counter, name)

    def read_setting(self, name):
        self.bus.send(can.Message(arbitration_id=SETTING_READ.frame_id, is_extended_id=False,
                                  data=SETTING_READ.encode({"setting": name})))
        return self.receive_setting(0, name)

    def refusal(self, opcode, value=0.0):
        return self.request(opcode, value).signals["refusal"]

    def claim(self):
        """Claims the lease, or keeps it; why it was refused."""
        answer = self.request("lease").signals
        if answer["refusal"] == "claim_again":
            answer = self.request("lease", answer["granted"]).signals
        if answer["refusal"] == "none":
            self.session = answer["granted"]
        return answer["refusal"]

    def steer(self, position_m):
        """Commands a position, or does what must be done before; whether it was obeyed."""
        refusal = self.refusal("position", position_m)
        if refusal == "none":
            self.receive_next("Measurement", 4)
            return True
        if refusal == "no_lease":
            self.session = self.name
            self.claim()
        else:
            state = self.receive_next("Status").signals["state"]
            if state in ("fault", "disarmed"):
                self.request("reset" if state == "fault" else "arm")
        return False

    def steer_until(self, position_m, reached):
        for _ in range(1000):
            if self.steer(position_m) and reached(self):
                return
        raise AssertionError(f"not reached: {self.newest}, {self.answers[-5:]}, {self.faults}")
