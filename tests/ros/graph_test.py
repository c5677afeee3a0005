"""What the bridge knows of its peers on DDS, on loopback."""

import os
import time
import unittest

from peer import LOOPBACK, Peer, Writer

os.environ["CYCLONEDDS_URI"] = LOOPBACK

from supercoil.ros.graph import Graph
from supercoil.ros.messages import Bool

WITHIN_S = 60.0
KIND = "std_msgs/msg/Bool"


class Known(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        domain = 1 + os.getpid() % 200
        cls.graph, cls.peer = Graph(domain), Peer(domain)

    def wait(self, wanted):
        end = time.monotonic() + WITHIN_S
        while not (seen := wanted()):
            self.assertLess(time.monotonic(), end, "never seen")
            time.sleep(0.005)
        return seen

    def test_a_publisher_is_known_until_it_disappears(self):
        subscription = self.graph.subscription("/known", Bool, (True,))
        for _ in range(20):  # handles are random: with and without a sign
            writer = Writer(self.peer, "rt/known", KIND, reliable=True)
            self.wait(writer.matched)
            writer.write(self.peer.message(KIND, True))
            (message, publisher), = self.wait(subscription.take)
            self.assertTrue(message.data)
            self.assertTrue(subscription.has(publisher))
            del writer
            self.wait(lambda publisher=publisher: not subscription.has(publisher))

    def test_best_effort_publishers_are_received_if_requested(self):
        both = self.graph.subscription("/both", Bool, (True, False))
        reliable = self.graph.subscription("/reliable", Bool, (True,))
        requested = self.peer.writer("rt/both", KIND, reliable=False)
        unrequested = self.peer.writer("rt/reliable", KIND, reliable=False)
        last = self.peer.writer("rt/reliable", KIND)
        self.wait(lambda: requested.matched() and last.matched())
        for writer in (requested, unrequested):
            writer.write(self.peer.message(KIND, True))
        last.write(self.peer.message(KIND, False))
        self.wait(both.take)
        self.assertEqual([message.data for message, _ in self.wait(reliable.take)], [False])

    def test_both_readers_keep_the_order_of_sending(self):
        both = self.graph.subscription("/order", Bool, (True, False))
        reliable, other = (self.peer.writer("rt/order", KIND, reliable=each) for each in (True, False))
        self.wait(lambda: reliable.matched() == 2 and other.matched() == 1)
        other.write(self.peer.message(KIND, False))  # only the second reader has it
        reliable.write(self.peer.message(KIND, True))
        self.wait(lambda: [len(reader.read(10)) for reader in both._readers] == [1, 2])
        self.assertEqual([message.data for message, _ in both.take()], [False, True, True])


if __name__ == "__main__":
    unittest.main()
