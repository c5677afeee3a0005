"""The code that is mutated, and the test programs that are nearest to it."""

import dataclasses
import functools
import subprocess


@dataclasses.dataclass(frozen=True)
class Area:
    name: str
    patterns: tuple  # of files, relative to the root
    programs: tuple  # built and run in this order until one notices


WHOLE_FIRMWARE = ("core_tests", "config_tests", "loop_tests", "fault_matrix")
AREAS = (
    Area("supervisor", ("firmware/core/supervisor/**/*",), WHOLE_FIRMWARE),
    Area("board", ("firmware/core/board/*",), (*WHOLE_FIRMWARE, "storage_tests")),  # has the tests of learned
    Area("loop", ("firmware/core/loop/*",), WHOLE_FIRMWARE),
    Area("telemetry commands",
         (*(f"firmware/io/telemetry/{name}.*" for name in ("can_endpoint", "commands", "leases", "opcodes", "run_settings")),
          *(f"firmware/io/can/{name}.*" for name in ("codec", "e2e", "nodes"))),
         ("telemetry_tests", "can_client_tests", "loop_tests")),
    Area("storage", ("firmware/io/storage/*",), ("storage_tests",)),
    Area("Linux HAL", ("hal/linux/**/*",), ("hal_linux_tests", "gpio_tests", "bus_tests", "can_tests")),
)


@functools.cache
def not_built():
    """The file for the version of libgpiod that is not installed."""
    newer = subprocess.run(["pkg-config", "--atleast-version=2", "libgpiod"]).returncode == 0
    return f"gpio_chip_v{1 if newer else 2}.cpp"


def files_of(area, root):
    found = {path for pattern in area.patterns for path in root.glob(pattern)
             if path.suffix in (".cpp", ".hpp") and path.name != not_built()}
    return sorted(str(path.relative_to(root)) for path in found)
