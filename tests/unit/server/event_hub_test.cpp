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
