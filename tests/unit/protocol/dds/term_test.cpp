// Several servers that share a library: a gateway has the one with the highest term, and never
// again one with a lower term than it had.
#include "network.hpp"

namespace dripline::dds::test {
namespace {

constexpr auto kQuiet = 700ms;  // in which nothing may come

class Term : public Network {
 protected:
  struct Gateway : TestGateway {
    Inbox<std::pair<std::uint64_t, std::uint64_t>> stale;
  };
  /// `place`: servers of one domain listen at ports of their own.
  std::unique_ptr<TestServer> open_server_of(std::uint64_t term, int place) {
    options_.term = term;
    options_.port = 0;
    if (place == 0) return open_server();
    options_.port = static_cast<std::uint16_t>(7410 + 250 * options_.domain + 60 * place);
    auto server = std::make_unique<TestServer>();
    auto opened = ServerEndpoint::open(options_, server->handlers());
    if (!opened) throw std::runtime_error(opened.error().what);
    server->endpoint = std::move(*opened);
    return server;
  }
  std::unique_ptr<Gateway> open_gateway_of_all() {
    const auto first = 7410 + 250 * options_.domain;
    options_.server = fmt::format("127.0.0.1,127.0.0.1:{},127.0.0.1:{}", first + 60, first + 120);
    auto gateway = std::make_unique<Gateway>();
    auto handlers = gateway->handlers();
    handlers.on_stale_server = [raw = gateway.get()](std::uint64_t term, std::uint64_t seen) {
      raw->stale.put({term, seen});
    };
    auto opened = GatewayEndpoint::open(options_, "lathe-1", std::move(handlers));
    if (!opened) throw std::runtime_error(opened.error().what);
    gateway->endpoint = std::move(*opened);
    EXPECT_TRUE(gateway->endpoint->write(announce("lathe-1")));
    return gateway;
  }
  static Command command(const std::string& id, CommandAction action) {
    Command m;
    m.machine = "lathe-1";
    m.id = id;
    m.action = action;
    return m;
  }
  /// Nothing of this server is delivered, stops included. That it may be written is no question.
  static void expect_refused(TestServer& server, TestGateway& gateway) {
    (void)server.endpoint->write(command("c1", CommandAction::Start));
    (void)server.endpoint->write(command("c2", CommandAction::Hold));
    (void)server.endpoint->write(block_data("lathe-1", 0, 100));
    (void)server.endpoint->write(RecordAck{"lathe-1", 7, 1});
    EXPECT_FALSE(gateway.commands.take(kQuiet));
    EXPECT_FALSE(gateway.blocks.take(1ms));
    EXPECT_FALSE(gateway.acks.take(1ms));
  }
  static void expect_heard(TestServer& server, TestGateway& gateway, std::uint64_t term) {
    ASSERT_TRUE(server.endpoint->write(command("c9", CommandAction::Hold)));
    const auto got = gateway.commands.take();
    ASSERT_TRUE(got);
    EXPECT_EQ(got->term, term);
    ASSERT_TRUE(server.endpoint->write(block_data("lathe-1", 0, 100)));
    const auto block = gateway.blocks.take();
    ASSERT_TRUE(block);
    EXPECT_EQ(block->term, term);
  }
};

TEST_F(Term, AHigherOneTakesOverAtOnceFromAServerThatIsAlive) {
  auto old = open_server_of(5, 0);
  auto gateway = open_gateway_of_all();
  ASSERT_TRUE(old->announces.take());
  expect_heard(*old, *gateway, 5);
  auto next = open_server_of(9, 1);
  ASSERT_TRUE(next->announces.take());
  EXPECT_EQ(old->lost.take(), "lathe-1") << "it learns that it has the machine no more";
  expect_refused(*old, *gateway);
  expect_heard(*next, *gateway, 9);
  EXPECT_EQ(gateway->stale.take(), std::pair(std::uint64_t{5}, std::uint64_t{9}));
  EXPECT_FALSE(gateway->stale.take(kQuiet)) << "once";
}

TEST_F(Term, ALowerOneIsNotTakenWhenTheOtherIsGone) {
  auto old = open_server_of(5, 0);
  auto gateway = open_gateway_of_all();
  ASSERT_TRUE(old->announces.take());
  auto next = open_server_of(9, 1);
  ASSERT_TRUE(next->announces.take());
  ASSERT_TRUE(old->lost.take());
  next.reset();
  EXPECT_FALSE(old->announces.take(2s));
  expect_refused(*old, *gateway);
  EXPECT_FALSE(gateway->endpoint->is_connected());
  auto third = open_server_of(10, 2);
  ASSERT_TRUE(third->announces.take());
  expect_heard(*third, *gateway, 10);
}

/// As of an older version, or of a SQLite file.
TEST_F(Term, AServerWithoutOneIsNotTakenAfterOneThatHasOne) {
  auto next = open_server_of(9, 0);
  auto gateway = open_gateway_of_all();
  ASSERT_TRUE(next->announces.take());
  expect_heard(*next, *gateway, 9);
  auto none = open_server_of(0, 1);
  next.reset();
  EXPECT_FALSE(none->announces.take(2s));
  expect_refused(*none, *gateway);
}

TEST_F(Term, WithoutTermsTheFirstServerIsKeptAsEver) {
  auto first = open_server_of(0, 0);
  auto gateway = open_gateway_of_all();
  ASSERT_TRUE(first->announces.take());
  auto second = open_server_of(0, 1);
  EXPECT_FALSE(second->announces.take(kQuiet));
  expect_heard(*first, *gateway, 0);
  first.reset();
  EXPECT_TRUE(second->announces.take());
  expect_heard(*second, *gateway, 0);
  EXPECT_EQ(gateway->stale.size(), 0u);
}

}  // namespace
}  // namespace dripline::dds::test
