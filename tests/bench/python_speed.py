"""How fast the Python package is. It reports, and judges nothing.

Commands with answers a second over socketcand on loopback, and the part of a core that telemetry of eight nodes takes.

    SUPERCOIL_SIM=build/release/bin/supercoil-sim .venv/bin/python tests/bench/python_speed.py

It finds the package in firmware/python.
"""

import asyncio
import pathlib
import socket
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "firmware" / "python"))
import supercoil
from supercoil import codec
from supercoil.generated import messages

COMMANDS = 2000
AT_ONCE = 8
NODES = range(1, 9)
SECONDS = 10.0
SLOT_S = 0.001


async def commands(at_once):
    """Commands a second when this many tasks give them, and the part of a core that this took."""
    async with supercoil.Simulation("bench", deadline_s=60.0) as simulation:
        muscle = simulation.muscle
        await muscle.arm()

        async def one():
            for _ in range(COMMANDS // at_once):
                await muscle.set_position(0.001)
        begin, used = time.monotonic(), time.process_time()
        await asyncio.gather(*(one() for _ in range(at_once)))
        took_s = time.monotonic() - begin
        return COMMANDS / took_s, (time.process_time() - used) / took_s


def frames_of_a_second():
    """Text of each millisecond's frames: every node's messages at their usual rates, spread over their periods."""
    slots = [[] for _ in range(1000)]
    periodic = [layout for layout in codec.LAYOUTS.values() if layout.cycle_ms]
    for node in NODES:
        for place, layout in enumerate(periodic):
            values = {"protocol_version": supercoil.PROTOCOL_VERSION} if layout.base == messages.STATUS else {}
            data = codec.encode(layout, values).hex().upper()
            for at in range((7 * node + place) % layout.cycle_ms, 1000, layout.cycle_ms):
                slots[at].append(f"< frame {layout.base | node:03X} 1.000000 {data} >")
    return ["".join(slot).encode() for slot in slots], sum(map(len, slots))


def serve():
    """What a socketcand server of eight boards sends; in a process of its own."""
    listener = socket.create_server(("127.0.0.1", 0))
    print(listener.getsockname()[1], flush=True)
    slots, _ = frames_of_a_second()
    while True:
        client, _ = listener.accept()
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            client.sendall(b"< hi >")
            for _ in ("open", "rawmode"):
                if not client.recv(100):
                    break
                client.sendall(b"< ok >")
            else:
                time.sleep(0.2)
                begin, sent = time.monotonic(), 0
                while True:
                    while sent * SLOT_S <= time.monotonic() - begin:
                        client.sendall(slots[sent % 1000])
                        sent += 1
                    time.sleep(SLOT_S / 4)
        except OSError:
            client.close()


async def telemetry(address):
    """Frames a second received from eight nodes, and the part of a core that this took."""
    muscles = [await supercoil.Muscle(address, node).connect() for node in NODES]
    recordings = [muscle.record().start() for muscle in muscles]
    begin, used = time.monotonic(), time.process_time()
    await asyncio.sleep(SECONDS)
    took_s, core = time.monotonic() - begin, time.process_time() - used
    received = sum(len(recording.frames) for recording in recordings)
    for muscle in muscles:
        await muscle.close()
    return received / took_s, core / took_s


def main():
    if sys.argv[1:] == ["--serve"]:
        return serve()
    for at_once in (1, AT_ONCE):
        rate, core = asyncio.run(commands(at_once))
        print(f"commands with answers, {at_once} at once: {rate:.0f} a second, {100 * core:.0f} % of a core")
    server = subprocess.Popen([sys.executable, __file__, "--serve"], stdout=subprocess.PIPE, text=True)
    try:
        rate, core = asyncio.run(telemetry(f"socketcand:{server.stdout.readline().strip()}"))
    finally:
        server.kill()
        server.communicate()
    print(f"telemetry of {len(NODES)} nodes, kept: {rate:.0f} of {frames_of_a_second()[1]} frames a second, "
          f"{100 * core:.0f} % of a core")


if __name__ == "__main__":
    main()
