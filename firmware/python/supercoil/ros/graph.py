"""Publishers, subscriptions and services as rmw_cyclonedds makes them: names, quality of service, user data."""

import asyncio
import logging
import secrets
from collections.abc import Awaitable, Callable, Iterator, Sequence
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

_DEPTH = 10  # of ROS's default, and of its services
_CLIENT_WITHIN_S = 0.1
_LOOK_EVERY_S = 0.005
# How many of a flood one look takes: the rest is older than what matters.
_MOST_AT_ONCE = 100
_HANDLE = 0xFFFFFFFFFFFFFFFF


def _quality(reliable: bool, user_data: str) -> Qos:
    return Qos(Policy.Reliability.Reliable(duration(milliseconds=100)) if reliable else Policy.Reliability.BestEffort,
               Policy.History.KeepLast(_DEPTH), Policy.Durability.Volatile,
               Policy.DataRepresentation(use_cdrv0_representation=True), Policy.Userdata(user_data.encode()))


def _type_hash(kind: type[IdlStruct]) -> str:
    known = messages.TYPE_HASHES.get(kind)
    return f"typehash={known};" if known else ""


class Subscription(Generic[M]):
    """A best-effort reader hears every publisher; a reliable one hears reliable publishers only, but all they say."""

    def __init__(self, kind: type[M], readers: list[DataReader[M]]) -> None:
        self._kind = kind
        self._readers = readers

    def take(self) -> Iterator[tuple[M, int]]:
        """What has come since, and whose it is. What is no message of the type is left out."""
        for reader in self._readers:
            try:
                taken = reader.take(_MOST_AT_ONCE)
            except (DDSException, ValueError) as error:
                _log.warning("damaged messages are left out: %s", error)
                continue
            for message in taken:
                if isinstance(message, self._kind):
                    # Cyclone gives this one with a sign, and others without.
                    yield message, message.sample_info.publication_handle & _HANDLE  # type: ignore[attr-defined]

    def has(self, publisher: int) -> bool:
        """Whether it is still there."""
        return any(handle & _HANDLE == publisher for reader in self._readers
                   for handle in reader.get_matched_publications())


Answer = Callable[[], Awaitable[tuple[bool, str]]]


class Trigger:
    """A service of std_srvs/srv/Trigger."""

    def __init__(self, requests: DataReader[messages.TriggerRequest], responses: DataWriter[messages.TriggerResponse],
                 answer: Answer) -> None:
        self._requests = requests
        self._responses = responses
        self._answer = answer
        self._running: set[asyncio.Task[None]] = set()

    def serve(self) -> None:
        """Begins to answer the requests that came since."""
        for request in self._requests.take(_MOST_AT_ONCE):
            if isinstance(request, messages.TriggerRequest):
                task = asyncio.create_task(self._respond(request))
                self._running.add(task)
                task.add_done_callback(self._running.discard)

    async def _respond(self, request: messages.TriggerRequest) -> None:
        success, message = await self._answer()
        # A client that is new here may not hear the answer yet.
        for _ in range(int(_CLIENT_WITHIN_S / _LOOK_EVERY_S)):
            if self._responses.get_matched_subscriptions():
                break
            await asyncio.sleep(_LOOK_EVERY_S)
        self._responses.write(messages.TriggerResponse(request.client, request.sequence, success, message))


class Graph:
    def __init__(self, domain: int) -> None:
        self._participant = DomainParticipant(domain)

    def publisher(self, name: str, kind: type[M]) -> DataWriter[M]:
        topic = Topic(self._participant, names.topic(name), kind)
        return DataWriter(self._participant, topic, qos=_quality(True, _type_hash(kind)))

    def subscription(self, name: str, kind: type[M], reliable: Sequence[bool]) -> Subscription[M]:
        topic = Topic(self._participant, names.topic(name), kind)
        return Subscription(kind, [DataReader(self._participant, topic, qos=_quality(each, _type_hash(kind)))
                                   for each in reliable])

    def service(self, name: str, answer: Answer) -> Trigger:
        # By it a client knows that request and response belong to one server.
        identity = "serviceid=" + ".".join(f"{byte:x}" for byte in secrets.token_bytes(16)) + ";"
        requests = Topic(self._participant, names.request(name), messages.TriggerRequest)
        responses = Topic(self._participant, names.response(name), messages.TriggerResponse)
        return Trigger(DataReader(self._participant, requests, qos=_quality(True, identity)),
                       DataWriter(self._participant, responses, qos=_quality(True, identity)), answer)
