#include "server/api/event_hub.hpp"

#include <gtest/gtest.h>

namespace dripline::api {
namespace {

TEST(EventHub, GivesEveryListenerItsMachinesEvents) {
  EventHub hub;
  const auto all = hub.subscribe({});
  const auto one = hub.subscribe("m1");
  hub.publish({.kind = "run", .machine = "m1", .data = "{}"});
  hub.publish({.kind = "run", .machine = "m2", .data = "[]"});
  EXPECT_EQ(all->take(), "event: run\ndata: {}\n\nevent: run\ndata: []\n\n");
  EXPECT_EQ(one->take(), "event: run\ndata: {}\n\n");
}

TEST(EventHub, KeepsOnlyTheLatestStateOfAMachine) {
  EventHub hub;
  const auto listener = hub.subscribe({});
  for (int i = 0; i < 10'000; ++i) {
    hub.publish({.kind = "machine", .machine = "m1", .data = std::to_string(i)});
  }
  EXPECT_EQ(listener->take(), "event: machine\ndata: 9999\n\n");
}

TEST(EventHub, HasTheStateOfThousandsOfMachinesForASlowListener) {
  EventHub hub;
  const auto slow = hub.subscribe({});
  constexpr int kMachines = 4096;
  const std::string state(2048, 'x');  // with all of them more than kMaxBytes
  hub.publish({.kind = "run", .machine = "m1", .data = "{}"});
  for (const std::string& data : {state, state + "y"}) {
    for (int i = 0; i < kMachines; ++i)
      hub.publish({.kind = "machine", .machine = "m" + std::to_string(i), .data = data});
  }
  ASSERT_FALSE(slow->is_closed());
  const std::string text = slow->take();
  EXPECT_TRUE(text.starts_with("event: run\n")) << "the order stays";
  const std::size_t frame = std::string("event: machine\ndata: \n\n").size();
  EXPECT_EQ(text.size(), std::string("event: run\ndata: {}\n\n").size() +
                             kMachines * (frame + state.size() + 1));
  hub.publish({.kind = "machine", .machine = "m7", .data = "{}"});
  EXPECT_EQ(slow->take(), "event: machine\ndata: {}\n\n");
}

TEST(EventHub, CutsOffAListenerThatIsTooSlow) {
  EventHub hub;
  const auto slow = hub.subscribe({});
  const auto quick = hub.subscribe({});
  int woken = 0;
  slow->on_ready([&] { ++woken; });
  for (std::size_t i = 0; i <= EventSubscription::kMaxEvents; ++i) {
    hub.publish({.kind = "record", .machine = "m1", .data = "{}"});
    quick->take();
  }
  EXPECT_TRUE(slow->is_closed());
  EXPECT_EQ(woken, 2);  // when the first event came and when it was cut off
  EXPECT_TRUE(slow->take().empty());
  EXPECT_FALSE(quick->is_closed());
}

TEST(EventHub, GivesAPortsListenerThatPortOnly) {
  EventHub hub;
  const auto port = hub.subscribe_port("line-1");
  const auto all = hub.subscribe({});
  hub.publish({.kind = "run", .machine = "m1", .data = "{}"});
  hub.publish({.kind = "traffic", .data = "1", .port = "line-1"});
  hub.publish({.kind = "traffic", .data = "2", .port = "line-2"});
  EXPECT_EQ(port->take(), "event: traffic\ndata: 1\n\n");
  EXPECT_EQ(all->take(), "event: run\ndata: {}\n\n");
  EXPECT_TRUE(hub.has_port_listeners("line-1"));
  EXPECT_FALSE(hub.has_port_listeners("line-2"));
}

TEST(EventHub, CountsWhatASlowListenerOfAPortLost) {
  EventHub hub;
  const auto slow = hub.subscribe_port("line-1");
  for (std::size_t i = 0; i < EventSubscription::kMaxEvents + 17; ++i) {
    hub.publish({.kind = "traffic", .data = "{}", .port = "line-1"});
  }
  EXPECT_FALSE(slow->is_closed());
  const std::string text = slow->take();
  EXPECT_TRUE(text.ends_with("event: traffic\ndata: {}\n\nevent: lost\ndata: {\"lost\":17}\n\n"));
  hub.publish({.kind = "traffic", .data = "{}", .port = "line-1"});
  EXPECT_EQ(slow->take(), "event: traffic\ndata: {}\n\n") << "and continues";
}

TEST(EventHub, KeepsNoMoreBytesForAPortThanAgreed) {
  EventHub hub;
  const auto slow = hub.subscribe_port("line-1");
  const std::string big(EventSubscription::kMaxBytes / 4 + 1, 'x');
  for (int i = 0; i < 5; ++i) hub.publish({.kind = "traffic", .data = big, .port = "line-1"});
  const std::string text = slow->take();
  EXPECT_LT(text.size(), EventSubscription::kMaxBytes + 1000);
  EXPECT_TRUE(text.ends_with("data: {\"lost\":2}\n\n"));
}

TEST(EventHub, TakesALimitedNumberOfListenersAndForgetsThoseThatWent) {
  EventHub hub;
  std::vector<std::shared_ptr<EventSubscription>> listeners;
  for (std::size_t i = 0; i < EventHub::kMaxSubscriptions; ++i) {
    listeners.push_back(hub.subscribe({}));
  }
  EXPECT_EQ(hub.subscribe({}), nullptr);
  listeners.pop_back();
  EXPECT_NE(hub.subscribe({}), nullptr);
}

}  // namespace
}  // namespace dripline::api
