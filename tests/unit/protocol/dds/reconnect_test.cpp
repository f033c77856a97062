#include "network.hpp"

namespace dripline::dds::test {
namespace {

class Reconnect : public Network {
 protected:
  /// Messages pass in both directions.
  void expect_working(TestServer& server, TestGateway& gateway, std::uint64_t mark) {
    ASSERT_TRUE(gateway.endpoint->write(record("lathe-1", mark)));
    auto got = server.records.take();
    ASSERT_TRUE(got);
    EXPECT_EQ(got->number, mark);
    ASSERT_TRUE(server.endpoint->write(RecordAck{"lathe-1", 7, mark}));
    auto ack = gateway.acks.take();
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->number, mark);
  }
};

TEST_F(Reconnect, GatewayMeetsANewServer) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());
  ASSERT_EQ(gateway->server.take(), true);
  server.reset();
  EXPECT_EQ(gateway->server.take(), false);
  EXPECT_FALSE(gateway->endpoint->is_connected());
  server = open_server();
  EXPECT_EQ(server->announces.take(), announce("lathe-1"));
  EXPECT_EQ(gateway->server.take(), true);
  expect_working(*server, *gateway, 1);
}

TEST_F(Reconnect, GatewayStartedFirstMeetsTheServer) {
  open_server();  // finds a free domain, then is gone
  auto gateway = open_gateway("lathe-1");
  EXPECT_FALSE(gateway->endpoint->is_connected());
  auto server = open_server();
  EXPECT_EQ(server->announces.take(), announce("lathe-1"));
  EXPECT_EQ(gateway->server.take(), true);
  expect_working(*server, *gateway, 1);
}

TEST_F(Reconnect, ServerReportsThatAGatewayLeftAndCameBack) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1", 1);
  ASSERT_TRUE(server->announces.take());
  gateway.reset();
  EXPECT_EQ(server->lost.take(), "lathe-1");
  const auto written = server->endpoint->write(RecordAck{"lathe-1", 7, 1});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::NotFound);
  gateway = open_gateway("lathe-1", 2);
  EXPECT_EQ(server->announces.take(), announce("lathe-1", 2));
  ASSERT_EQ(gateway->server.take(), true);
  expect_working(*server, *gateway, 2);
}

/// It is not acknowledged: the gateway repeats it, as the status publisher does.
TEST_F(Reconnect, ALateServerGetsTheLastStatusWhenItIsRepeated) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  Status status;
  status.machine = "lathe-1";
  for (status.line = 1; status.line <= 3; ++status.line) {
    ASSERT_TRUE(gateway->endpoint->write(status));
  }
  server.reset();
  server = open_server();
  std::optional<Status> got;
  for (int tries = 0; tries < 200 && !got; ++tries) {
    ASSERT_TRUE(gateway->endpoint->write(status));
    got = server->statuses.take(50ms);
  }
  ASSERT_TRUE(got);
  EXPECT_EQ(*got, status);
}

TEST_F(Reconnect, ANewServerIsNotHandedOldRecordsOrCommands) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1", 1);
  ASSERT_TRUE(server->announces.take());
  ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 1)));
  ASSERT_TRUE(server->records.take());
  Command command;
  command.machine = "lathe-1";
  command.id = "order-1";
  ASSERT_TRUE(server->endpoint->write(command));
  ASSERT_TRUE(gateway->commands.take());
  gateway.reset();
  gateway = open_gateway("lathe-1", 2);
  ASSERT_EQ(gateway->server.take(), true);
  ASSERT_EQ(server->announces.take(), announce("lathe-1", 2));  // the first one is gone by now
  expect_working(*server, *gateway, 2);
  EXPECT_EQ(gateway->commands.size(), 0U);
  EXPECT_EQ(server->records.size(), 0U);
}

}  // namespace
}  // namespace dripline::dds::test
