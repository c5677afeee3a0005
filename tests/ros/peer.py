"""A peer of supercoil-ros on DDS that shares no code with it: types and bytes are rosbags', Cyclone carries them.

On loopback only, in a domain of its own."""

import os
import time

from cyclonedds._clayer import ddspy_take, ddspy_write
from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import annotations, make_idl_struct, types
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

LOOPBACK = """<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>20</MaxAutoParticipantIndex><Peers><Peer Address="127.0.0.1"/></Peers></Discovery></Domain>
</CycloneDDS>"""
ANY_STATE = 0x7F
AGAIN_S = 2.0
BASES = {"bool": bool, "string": str, "octet": types.byte, "byte": types.byte, **{
    name: getattr(types, name) for name in ("int32", "uint32", "int64", "uint64", "uint8", "float64")}}
# std_srvs is in neither store. What rmw_cyclonedds puts before a request or response is in front.
TRIGGER = {
    "std_srvs/srv/Trigger_Request": "uint64 client\nint64 sequence\nuint8 structure_needs_at_least_one_member",
    "std_srvs/srv/Trigger_Response": "uint64 client\nint64 sequence\nbool success\nstring message"}


def store_of(release):
    store = get_typestore(release)
    for name, text in TRIGGER.items():
        definition, = get_types_from_msg(text, name).values()
        store.register({name: definition})
    return store


STORES = {release.name: store_of(release) for release in (Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY)}


def on_dds(name):
    package, kind, own = name.split("/")
    return f"{package}::{kind}::dds_::{own}_"


def idl_of(store, name, known):
    """Its type for Cyclone, from rosbags' definition: Cyclone matches it with the bridge's, member by member."""
    def of(node):
        kind, what = node
        if kind == Nodetype.BASE:
            return BASES[what[0]]
        if kind == Nodetype.NAME:
            return idl_of(store, what, known)
        return types.sequence[of(what[0])]
    if name not in known:
        fields = {field: of(node) for field, node in store.fielddefs[name][1]}
        known[name] = annotations.final(make_idl_struct(name.split("/")[-1], on_dds(name), fields))
    return known[name]


def quality(reliable=True):
    return Qos(Policy.Reliability.Reliable(duration(seconds=1)) if reliable else Policy.Reliability.BestEffort,
               Policy.History.KeepLast(10), Policy.DataRepresentation(use_cdrv0_representation=True))


class Writer:
    def __init__(self, peer, topic, kind, reliable):
        self.peer, self.kind = peer, kind
        self.dds = DataWriter(peer.participant, peer.topic(topic, kind), qos=quality(reliable))

    def write(self, message):
        self.write_bytes(bytes(self.peer.store.serialize_cdr(message, self.kind)))

    def write_bytes(self, data):
        ddspy_write(self.dds._ref, data)

    def matched(self):
        return len(self.dds.get_matched_subscriptions())


class Reader:
    def __init__(self, peer, topic, kind):
        self.peer, self.kind = peer, kind
        self.dds = DataReader(peer.participant, peer.topic(topic, kind), qos=quality())

    def take_bytes(self):
        return [data for data, info in ddspy_take(self.dds._ref, ANY_STATE, 100) if info.valid_data]

    def take(self):
        return [self.peer.store.deserialize_cdr(data, self.kind) for data in self.take_bytes()]


class Peer:
    """Its writers and readers stay until it ends, as with a node: none is made or deleted on the way."""

    def __init__(self, domain, release="ROS2_JAZZY"):
        os.environ["CYCLONEDDS_URI"] = LOOPBACK
        self.store = STORES[release]
        self.participant = DomainParticipant(domain)
        self._types = {}
        self._ends = {}
        self._requests = 0

    def topic(self, name, kind):
        return Topic(self.participant, name, idl_of(self.store, kind, self._types))

    def message(self, name, *values):
        return self.store.types[name](*values)

    def header(self, seconds=0.0):
        whole = int(seconds)
        stamp = self.message("builtin_interfaces/msg/Time", whole, int(1e9 * (seconds - whole)))
        return self.message("std_msgs/msg/Header", stamp, "")

    def _end(self, *made_of):
        if made_of not in self._ends:
            make, *how = made_of
            self._ends[made_of] = make(self, *how)
        return self._ends[made_of]

    def writer(self, topic, kind, reliable=True):
        return self._end(Writer, topic, kind, reliable)

    def reader(self, topic, kind):
        return self._end(Reader, topic, kind)

    def call(self, service, within_s):
        """success and message of a Trigger service; an answer to somebody else is not taken for ours."""
        requests = self.writer(f"rq{service}Request", "std_srvs/srv/Trigger_Request")
        replies = self.reader(f"rr{service}Reply", "std_srvs/srv/Trigger_Response")
        end = time.monotonic() + within_s
        while not (requests.matched() and replies.dds.get_matched_publications()):
            if time.monotonic() > end:
                raise TimeoutError(f"{service} is not there")
            time.sleep(0.005)
        client, asked_s, mine = 0x1122334455667788, 0.0, set()
        while time.monotonic() < end:
            if time.monotonic() - asked_s > AGAIN_S:  # a server that was killed is still known for a while
                self._requests += 1
                mine.add(self._requests)
                requests.write(self.message("std_srvs/srv/Trigger_Request", client, self._requests, 0))
                asked_s = time.monotonic()
            for reply in replies.take():
                if reply.client == client and reply.sequence in mine:
                    return reply.success, reply.message
            time.sleep(0.005)
        raise TimeoutError(f"{service} does not answer")
