"""Every layer includes only what it may (docs/architecture.md).

The build enforces this between our own layers and for libraries with CMake targets; header-only system libraries and
the operating system's headers it cannot see, so their includes are read here. Nor can it see a file of tests that no list
of sources names, and that therefore never runs.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# What a step must not touch, in std.
OS_IN_STD = {"thread", "mutex", "filesystem", "fstream", "iostream", "chrono", "future", "memory", "vector", "string",
             "map", "condition_variable"}
ALLOWED = {
    "control": ["supercoil/control/", "Eigen/", "unsupported/Eigen/"],
    "identification": ["supercoil/control/", "supercoil/identification/", "Eigen/", "unsupported/Eigen/", "tl/"],
    "hal/include": ["supercoil/hal/"],
    "hal/linux": ["supercoil/hal/", "supercoil/hal_linux/", "tl/", "gpiod.h", "fcntl.h", "linux/", "net/if.h", "pthread.h",
                  "sched.h", "sys/", "unistd.h"],
    "firmware": ["supercoil/control/", "supercoil/hal/", "board/", "can_client/", "config/", "loop/", "modes/", "plot/", "program/",
                 "recorder/", "storage/", "supercoil.h", "supervisor/", "telemetry/", "boost/circular_buffer.hpp",
                 "boost/crc.hpp", "boost/lockfree/", "toml++/", "tl/", "fcntl.h", "sys/", "unistd.h"],
    "host_sim/plant": ["supercoil/control/", "plant/"],
}
# What a program inside a layer may include beside that.
OF_PROGRAMS = {
    "firmware/linux_board": ["linux_board/", "supercoil/hal_linux/"],
    "firmware/daemon": ["daemon/", "linux_board/", "CLI/", "supercoil/hal_linux/", "malloc.h", "poll.h"],
    "firmware/daemon/latency": ["daemon/", "supercoil/hal_linux/", "nlohmann/"],
    "firmware/can_client": ["can_client/"],
    "firmware/program": ["CLI/"],
    "firmware/operator/identify": ["operator/", "operator/identify/", "supercoil/identification/", "CLI/", "nlohmann/json.hpp"],
    "firmware/operator": ["operator/", "CLI/", "nlohmann/json.hpp", "poll.h"],
    "firmware/operator/bus": ["operator/bus/", "boost/asio/", "supercoil/hal_linux/socket_can.hpp"],
    "firmware/operator/monitor": ["operator/bus/", "operator/monitor/", "boost/asio/", "boost/beast/", "httplib.h",
                                  "nlohmann/json.hpp"],
    "firmware/operator/doctor": ["operator/doctor/", "linux_board/", "nlohmann/json.hpp", "supercoil/hal_linux/"],
}
INCLUDE = re.compile(r'^\s*#include\s+[<"]([^>"]+)[>"]', re.M)


def problems():
    for layer, allowed in ALLOWED.items():
        files = [f for f in (ROOT / layer).rglob("*") if f.suffix in {".hpp", ".cpp"}]
        if not files:
            yield f"{layer}: no files: has it moved?"
        for file in files:
            here = allowed + OF_PROGRAMS.get(str(file.parent.relative_to(ROOT)), [])
            for include in INCLUDE.findall(file.read_text()):
                of_std = "/" not in include and "." not in include
                if of_std and not (layer == "control" and include in OS_IN_STD):
                    continue
                if not any(include.startswith(prefix) for prefix in here):
                    yield f"{file.relative_to(ROOT)}: {layer} may not include {include}"


def never_run():
    lists = {file.parent: file.read_text() for file in (ROOT / "tests").rglob("CMakeLists.txt")}
    for file in (ROOT / "tests").rglob("*_test.cpp"):
        if not any(str(file.relative_to(folder)) in text for folder, text in lists.items() if folder in file.parents):
            yield f"{file.relative_to(ROOT)}: no CMakeLists.txt names it: its tests never run"


if __name__ == "__main__":
    found = [*problems(), *never_run()]
    print("\n".join(found) or "every include is allowed, and every file of tests is built")
    sys.exit(bool(found))
