#include "server/api/events/event_hub.hpp"

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

Event machine_event(std::string machine, std::string data) {
  return {.kind = "machine", .machine = std::move(machine), .data = std::move(data)};
}

TEST(EventHub, SendsAMachineWholeAndThenItsChanges) {
  EventHub hub;
  const auto changes = hub.subscribe({}, Interest::Form::Changes);
  const auto whole = hub.subscribe({});
  hub.publish(machine_event("m1", R"({"name":"m1","a":1,"b":1})"));
  EXPECT_EQ(changes->take(),
            "event: machine\ndata: {\"version\":1,\"name\":\"m1\",\"a\":1,\"b\":1}\n\n");
  hub.publish(machine_event("m1", R"({"name":"m1","a":1,"b":2})"));
  EXPECT_EQ(changes->take(),
            "event: change\ndata: {\"after\":1,\"version\":2,\"name\":\"m1\",\"b\":2}\n\n");
  EXPECT_EQ(whole->take(), "event: machine\ndata: {\"name\":\"m1\",\"a\":1,\"b\":2}\n\n");
  hub.publish(machine_event("m1", R"({"name":"m1","a":1})"));
  EXPECT_EQ(changes->take(), "event: machine\ndata: {\"version\":3,\"name\":\"m1\",\"a\":1}\n\n")
      << "it has other members";
  hub.publish(machine_event("m1", R"({"name":"m1","a":1})"));
  EXPECT_EQ(changes->take(), "") << "nothing has changed";
}

TEST(EventHub, SendsASlowListenerAllThatHasChangedSinceItsLastVersion) {
  EventHub hub;
  const auto slow = hub.subscribe({}, Interest::Form::Changes);
  hub.publish(machine_event("m1", R"({"name":"m1","a":1,"b":1,"c":1})"));
  slow->take();
  hub.publish(machine_event("m1", R"({"name":"m1","a":2,"b":1,"c":1})"));
  hub.publish(machine_event("m1", R"({"name":"m1","a":2,"b":2,"c":1})"));
  EXPECT_EQ(slow->take(),
            "event: change\ndata: {\"after\":1,\"version\":3,\"name\":\"m1\",\"a\":2,\"b\":2}\n\n");
}

TEST(EventHub, SendsWholeStatesToAListenerThatComesBackAfterItWasCutOff) {
  EventHub hub;
  auto listener = hub.subscribe({}, Interest::Form::Changes);
  hub.publish(machine_event("m1", R"({"name":"m1","a":1})"));
  listener->take();
  for (std::size_t i = 0; i <= EventSubscription::kMaxEvents; ++i)
    hub.publish({.kind = "record", .machine = "m1", .data = "{}"});
  hub.publish(machine_event("m1", R"({"name":"m1","a":2})"));
  ASSERT_TRUE(listener->is_closed());
  EXPECT_EQ(listener->take(), "");
  listener = hub.subscribe({}, Interest::Form::Changes);
  hub.show(*listener, "m1", [] { return R"({"name":"m1","a":3})"; });
  EXPECT_EQ(listener->take(), "event: machine\ndata: {\"version\":3,\"name\":\"m1\",\"a\":3}\n\n");
}

TEST(EventHub, ShowsNothingOlderThanWhatWasPublishedSince) {
  EventHub hub;
  const auto listener = hub.subscribe({});
  hub.publish(machine_event("m1", "new"));
  hub.show(*listener, "m1", []() -> std::string { return "old"; });
  EXPECT_EQ(listener->take(), "event: machine\ndata: new\n\n");
  const auto later = hub.subscribe({});
  hub.show(*later, "m1", []() -> std::string { return "newer"; });
  EXPECT_EQ(later->take(), "event: machine\ndata: newer\n\n") << "published before it began";
}

TEST(EventHub, KnowsWhoReceivesTheStateOfAMachine) {
  EventHub hub;
  EXPECT_FALSE(hub.has_listeners("m1"));
  const auto port = hub.subscribe_port("m1");
  const auto one = hub.subscribe("m1");
  EXPECT_TRUE(hub.has_listeners("m1"));
  EXPECT_FALSE(hub.has_listeners("m2"));
  const auto all = hub.subscribe({});
  EXPECT_TRUE(hub.has_listeners("m2"));
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
