"""Publishers, subscriptions and services as rmw_cyclonedds makes them: names, quality of service, user data."""

import asyncio
import logging
import secrets
import struct
from collections.abc import Awaitable, Callable, Sequence
from typing import Generic, TypeVar

from cyclonedds.core import DDSException, Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from supercoil.ros import messages, names

_log = logging.getLogger("supercoil.ros")
M = TypeVar("M", bound=IdlStruct)

_DEPTH = 10  # ROS's default, also for services
_CLIENT_WITHIN_S = 0.1
_POLL_PERIOD_S = 0.005
# How many messages of a flood are taken at once: the rest is older than what matters.
_MAX_AT_ONCE = 100
_HANDLE = 0xFFFFFFFFFFFFFFFF


def _quality(reliable: bool, user_data: str) -> Qos:
    return Qos(Policy.Reliability.Reliable(duration(milliseconds=100)) if reliable else Policy.Reliability.BestEffort,
               Policy.History.KeepLast(_DEPTH), Policy.Durability.Volatile,
               Policy.DataRepresentation(use_cdrv0_representation=True), Policy.Userdata(user_data.encode()))


def _type_hash(kind: type[IdlStruct]) -> str:
    known = messages.TYPE_HASHES.get(kind)
    return f"typehash={known};" if known else ""


def _taken(reader: DataReader[M]) -> list[M]:
    try:
        return reader.take(_MAX_AT_ONCE)
    except (DDSException, ValueError, struct.error) as error:
        _log.warning("damaged messages are skipped: %s", error)
        return []


class Publisher(Generic[M]):
    def __init__(self, writer: DataWriter[M]) -> None:
        self._writer = writer

    def write(self, message: M) -> None:
        """A message that Cyclone refuses is logged, and is no reason to let go of the muscles."""
        try:
            self._writer.write(message)
        except DDSException as error:
            _log.warning("a %s was not sent: %s", type(message).__name__, error)

    def has_readers(self) -> bool:
        return bool(self._writer.get_matched_subscriptions())


class Subscription(Generic[M]):
    """A best-effort reader hears every publisher; a reliable one only reliable publishers, but all they send."""

    def __init__(self, kind: type[M], readers: list[DataReader[M]]) -> None:
        self._kind = kind
        self._readers = readers

    def take(self) -> list[tuple[M, int]]:
        """Messages since the last call, and their publishers, in the order in which they were sent. Samples that are
        not of the type are left out."""
        found = []
        for reader in self._readers:
            for message in _taken(reader):
                if isinstance(message, self._kind):
                    info = message.sample_info  # type: ignore[attr-defined]
                    # Cyclone gives this handle as a signed number, and others as unsigned.
                    found.append((info.source_timestamp, message, info.publication_handle & _HANDLE))
        return [(message, publisher) for _, message, publisher in sorted(found, key=lambda each: each[0])]

    def has(self, publisher: int) -> bool:
        """Whether the publisher still exists."""
        return any(handle & _HANDLE == publisher for reader in self._readers
                   for handle in reader.get_matched_publications())


Answer = Callable[[], Awaitable[tuple[bool, str]]]


class Trigger:
    """A service of std_srvs/srv/Trigger."""

    def __init__(self, requests: DataReader[messages.TriggerRequest], responses: Publisher[messages.TriggerResponse],
                 answer: Answer) -> None:
        self._requests = requests
        self._responses = responses
        self._answer = answer
        self._running: set[asyncio.Task[None]] = set()

    def serve(self) -> None:
        """Begins to answer the requests that have arrived."""
        for request in _taken(self._requests):
            if isinstance(request, messages.TriggerRequest):
                task = asyncio.create_task(self._respond(request))
                self._running.add(task)
                task.add_done_callback(self._running.discard)

    async def _respond(self, request: messages.TriggerRequest) -> None:
        try:
            success, message = await self._answer()
        except Exception as error:  # a client waits for an answer
            _log.exception("a service failed")
            success, message = False, f"{type(error).__name__}: {error}"
        # A client that has just joined may not hear the answer yet.
        for _ in range(int(_CLIENT_WITHIN_S / _POLL_PERIOD_S)):
            if self._responses.has_readers():
                break
            await asyncio.sleep(_POLL_PERIOD_S)
        self._responses.write(messages.TriggerResponse(request.client, request.sequence, success, message))


class Graph:
    def __init__(self, domain: int) -> None:
        self._participant = DomainParticipant(domain)

    def publisher(self, name: str, kind: type[M]) -> Publisher[M]:
        topic = Topic(self._participant, names.topic(name), kind)
        return Publisher(DataWriter(self._participant, topic, qos=_quality(True, _type_hash(kind))))

    def subscription(self, name: str, kind: type[M], reliable: Sequence[bool]) -> Subscription[M]:
        topic = Topic(self._participant, names.topic(name), kind)
        return Subscription(kind, [DataReader(self._participant, topic, qos=_quality(each, _type_hash(kind)))
                                   for each in reliable])

    def service(self, name: str, answer: Answer) -> Trigger:
        # From this a client knows that request and response belong to one server.
        identity = "serviceid=" + ".".join(f"{byte:x}" for byte in secrets.token_bytes(16)) + ";"
        requests = Topic(self._participant, names.request(name), messages.TriggerRequest)
        responses = Topic(self._participant, names.response(name), messages.TriggerResponse)
        return Trigger(DataReader(self._participant, requests, qos=_quality(True, identity)),
                       Publisher(DataWriter(self._participant, responses, qos=_quality(True, identity))), answer)
