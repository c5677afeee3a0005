"""Every layer includes only what it is allowed to (docs/architecture.md).

The build enforces this between our own layers and for libraries with CMake targets. It cannot see header-only system
libraries and the operating system's headers, so this test reads their includes. It also finds test files that no list
of sources names, which would never run, and dead links among the fuzz targets' seeds.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Parts of std that a step must not use.
OS_IN_STD = {"thread", "mutex", "filesystem", "fstream", "iostream", "chrono", "future", "memory", "vector", "string",
             "map", "condition_variable"}
CORE = ["supercoil/control/", "supercoil/hal/", "board/", "loop/", "modes/", "supervisor/", "boost/circular_buffer.hpp",
        "boost/lockfree/"]
IO = ["can/", "can_client/", "config/", "plot/", "recorder/", "storage/", "telemetry/", "text/", "boost/crc.hpp", "toml++/",
      "tl/", "fcntl.h", "sys/", "unistd.h"]
ALLOWED = {
    "control": ["supercoil/control/", "Eigen/"],
    "identification": ["supercoil/control/", "supercoil/identification/", "Eigen/", "unsupported/Eigen/", "tl/"],
    "hal/include": ["supercoil/hal/", "tl/"],
    "hal/linux": ["supercoil/hal/", "supercoil/hal_linux/", "tl/", "gpiod.h", "fcntl.h", "linux/", "net/if.h", "pthread.h",
                  "sched.h", "sys/", "unistd.h"],
    "firmware/core": CORE,
    "firmware/io": [*CORE, *IO],
    "firmware/apps": [*CORE, *IO, "apps/common/", "linux_board/", "supercoil/hal_linux/", "CLI/", "nlohmann/"],
    "host_sim/plant": ["supercoil/control/", "plant/"],
}
# What some subfolders may include in addition.
BESIDE = {
    "firmware/io/linux_board": ["linux_board/", "supercoil/hal_linux/"],
    "firmware/apps/supercoild": ["apps/supercoild/", "malloc.h", "poll.h"],
    "firmware/apps/supercoil": ["apps/supercoil/", "supercoil/identification/", "boost/asio/", "boost/beast/", "httplib.h", "poll.h",
                                "spawn.h"],
}
INCLUDE = re.compile(r'^\s*#include\s+[<"]([^>"]+)[>"]', re.M)


def problems():
    for layer, allowed in ALLOWED.items():
        files = [f for f in (ROOT / layer).rglob("*") if f.suffix in {".hpp", ".cpp"}]
        if not files:
            yield f"{layer}: no files: has it moved?"
        for file in files:
            folder = str(file.parent.relative_to(ROOT)) + "/"
            here = allowed + [prefix for beside, more in BESIDE.items() if folder.startswith(beside + "/") for prefix in more]
            for include in INCLUDE.findall(file.read_text()):
                of_std = "/" not in include and "." not in include
                if of_std and not (layer == "control" and include in OS_IN_STD):
                    continue
                if not any(include.startswith(prefix) for prefix in here):
                    yield f"{file.relative_to(ROOT)}: {layer} may not include {include}"


def dead_links():
    for file in (ROOT / "tests").rglob("*"):
        if file.is_symlink() and not file.exists():
            yield f"{file.relative_to(ROOT)}: leads to {file.readlink()}, which is not there"


def never_run():
    lists = {file.parent: file.read_text() for file in (ROOT / "tests").rglob("CMakeLists.txt")}
    for file in (ROOT / "tests").rglob("*_test.cpp"):
        if not any(str(file.relative_to(folder)) in text for folder, text in lists.items() if folder in file.parents):
            yield f"{file.relative_to(ROOT)}: no CMakeLists.txt names it: its tests never run"


if __name__ == "__main__":
    found = [*problems(), *never_run(), *dead_links()]
    print("\n".join(found) or "every include is allowed, every file of tests is built, and every link leads somewhere")
    sys.exit(bool(found))
