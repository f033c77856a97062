// Gateways and servers that do not have the same number of cells.
#include "network.hpp"
#include "protocol/dds/configuration.hpp"

namespace dripline::dds::test {
namespace {

class Cells : public Network {
 protected:
  Cells() { options_.cells = 16; }
  /// One whose gateway looks in another cell when it knows of eight only.
  static std::string machine() {
    for (int i = 0;; ++i) {
      std::string name = fmt::format("mill-{}", i);
      if (cell_of(name, 8) != cell_of(name, 16)) return name;
    }
  }
  /// Commands reach it, and its records the server.
  static void expect_talk(TestServer& server, TestGateway& gateway) {
    ASSERT_TRUE(server.announces.take());
    ASSERT_TRUE(gateway.endpoint->write(record(machine(), 1)));
    EXPECT_EQ(server.records.take(), record(machine(), 1));
    ASSERT_TRUE(server.endpoint->write(RecordAck{machine(), 7, 1}));
    EXPECT_EQ(gateway.acks.take(), (RecordAck{machine(), 7, 1}));
  }
};

TEST_F(Cells, TheSameNumberOfBothIsMet) {
  auto server = open_server();
  auto gateway = open_gateway(machine());
  expect_talk(*server, *gateway);
}

TEST_F(Cells, AGatewayThatKnowsOfFewerIsMet) {
  auto server = open_server();
  options_.cells = 8;
  auto gateway = open_gateway(machine());
  expect_talk(*server, *gateway);
}

TEST_F(Cells, AGatewayThatKnowsOfMoreFindsNoServer) {
  options_.cells = 8;
  auto server = open_server();
  options_.cells = 16;
  auto gateway = open_gateway(machine());
  EXPECT_FALSE(server->announces.take(1s));
  EXPECT_FALSE(gateway->endpoint->is_connected());
}

/// As in one cell: the machine keeps its gateway, and its successor waits until that is lost.
TEST_F(Cells, AMachineIsInOneOfThemAtATime) {
  auto server = open_server();
  auto first = open_gateway(machine(), 1);
  ASSERT_EQ(server->announces.take()->session, 1U);
  options_.cells = 8;
  auto second = open_gateway(machine(), 2);
  EXPECT_EQ(server->rivals.take(), true);
  EXPECT_FALSE(server->announces.take(300ms));
  ASSERT_TRUE(second->endpoint->write(record(machine(), 9)));
  EXPECT_FALSE(server->records.take(300ms));
  first.reset();
  EXPECT_EQ(server->rivals.take(), false);
  ASSERT_EQ(server->announces.take()->session, 2U);
  ASSERT_TRUE(server->endpoint->write(RecordAck{machine(), 7, 1}));
  EXPECT_EQ(second->acks.take(), (RecordAck{machine(), 7, 1}));
}

}  // namespace
}  // namespace dripline::dds::test
