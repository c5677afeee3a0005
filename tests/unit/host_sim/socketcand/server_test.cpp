// What a poll does, and what it leaves for the next one.
#include "socketcand/server.hpp"

#include <string>

#include <sys/resource.h>
#include <unistd.h>

#include <CppUTest/TestHarness.h>
#include <boost/asio/write.hpp>

using namespace supercoil;
using namespace supercoil::host_sim;
using boost::asio::ip::tcp;

TEST_GROUP(SocketcandServer) {
  std::size_t delivered = 0;
  std::unique_ptr<SocketcandServer> server =
      SocketcandServer::listen(0, "can0", [this](const hal::CanFrame&) { ++delivered; }).value();
  boost::asio::io_context io;
  tcp::socket client{io};

  void connect() {
    client.connect({boost::asio::ip::address_v4::loopback(), server->port()});
  }
  void send(const std::string& text) {
    boost::asio::write(client, boost::asio::buffer(text));
  }
  /// The text that has arrived after this many polls.
  std::string receive(int polls) {
    for (int i = 0; i < polls; ++i)
      server->poll();
    std::string text(client.available(), ' ');
    client.read_some(boost::asio::buffer(text));
    return text;
  }
};

TEST(SocketcandServer, APollReadsAtMostOneBufferPerClient) {
  connect();
  server->poll();
  std::string flood;
  while (flood.size() < 32768)
    flood += "< send 1 0 >";
  send("< open can0 >" + flood);
  server->poll();
  server->poll();
  CHECK(delivered <= 2 * 1024 / 12);
  for (int i = 0; i < 100; ++i)
    server->poll();
  LONGS_EQUAL(flood.size() / 12, delivered);
}

TEST(SocketcandServer, AnOkIsSentAloneAndFramesFollowWithTheNextWord) {
  connect();
  send("< open can0 >< rawmode >");
  STRCMP_EQUAL("< hi >< ok >< ok >", receive(4).c_str());
  hal::CanFrame frame;
  frame.id = 0x123;
  server->send(frame, {});
  STRCMP_EQUAL("", receive(4).c_str());
  send("< echo >");
  STRCMP_EQUAL("< frame 123 0000000000.000000  >< echo >", receive(4).c_str());
  server->send(frame, {});
  STRCMP_EQUAL("< frame 123 0000000000.000000  >", receive(4).c_str());
}

/// Independently of this machine's clock.
TEST(SocketcandServer, AClientsFrameIsStampedByTheBoardsClock) {
  connect();
  tcp::socket other(io);
  other.connect({boost::asio::ip::address_v4::loopback(), server->port()});
  for (tcp::socket* each : {&client, &other})
    boost::asio::write(*each, boost::asio::buffer(std::string("< open can0 >< rawmode >< echo >")));
  receive(8);
  hal::CanFrame frame;
  frame.id = 0x123;
  server->send(frame, std::chrono::seconds(7));
  boost::asio::write(other, boost::asio::buffer(std::string("< send 201 0 >")));
  STRCMP_EQUAL("< frame 123 0000000007.000000  >< frame 201 0000000007.000000  >",
               receive(8).c_str());
}

/// Every attempt to accept fails at once then: a poll must not retry until one succeeds.
TEST(SocketcandServer, APollEndsWithoutFreeDescriptors) {
  connect();
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const int next = dup(0);
  close(next);
  const rlimit none_free{static_cast<rlim_t>(next), before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none_free);
  for (int i = 0; i < 10; ++i)
    server->poll();
  const std::size_t clients = server->clients();
  // Under UBSan the check itself needs a descriptor.
  setrlimit(RLIMIT_NOFILE, &before);
  LONGS_EQUAL(0, clients);
  for (int i = 0; i < 1000 && server->clients() == 0; ++i) {
    usleep(10'000);
    server->poll();
  }
  LONGS_EQUAL(1, server->clients());
}
