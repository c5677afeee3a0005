"""Names of ROS 2, and the matching names of DDS."""

import re

_TOKEN = r"[A-Za-z_][A-Za-z0-9_]*"
_NAME = re.compile(rf"~?/?{_TOKEN}(/{_TOKEN})*")


def checked(name: str, what: str) -> str:
    """what: "joint", for the error message."""
    if not re.fullmatch(_TOKEN, name):
        raise ValueError(f"{what} {name!r}: must be letters, digits and _, and begin with no digit")
    return name


def resolved(name: str, node: str) -> str:
    """joint_states becomes /joint_states, ~/arm becomes /NODE/arm."""
    if not _NAME.fullmatch(name) or (name.startswith("~") and not name.startswith("~/")):
        raise ValueError(f"topic {name!r}: must be names of letters, digits and _ with / between them, as "
                         "/joint_states or ~/joint_commands")
    if name.startswith("~/"):
        return f"/{node}{name[1:]}"
    return name if name.startswith("/") else f"/{name}"


def topic(name: str) -> str:
    return f"rt{name}"


def request(service: str) -> str:
    return f"rq{service}Request"


def response(service: str) -> str:
    return f"rr{service}Reply"
