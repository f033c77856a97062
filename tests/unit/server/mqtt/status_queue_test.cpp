#include "server/mqtt/status_queue.hpp"

#include <gtest/gtest.h>

namespace dripline::mqtt {
namespace {

using std::chrono::milliseconds;

machines::MachineView state_of(const std::string& machine, const std::string& description = "") {
  machines::MachineView made;
  made.machine.name = machine;
  made.machine.description = description;
  return made;
}

TEST(StatusQueue, HasTheLatestOfEachMachine) {
  StatusQueue queue(milliseconds(500));
  const SteadyTime now{std::chrono::seconds(100)};
  EXPECT_FALSE(queue.next_due());
  EXPECT_TRUE(queue.note(state_of("a", "old")));
  EXPECT_FALSE(queue.note(state_of("a", "new"))) << "one waited";
  EXPECT_TRUE(queue.note(state_of("b")));
  EXPECT_LE(queue.next_due().value(), now);
  EXPECT_EQ(queue.take(now)->machine.description, "new");
  EXPECT_EQ(queue.take(now)->machine.name, "b");
  EXPECT_FALSE(queue.take(now));
}

TEST(StatusQueue, KeepsALaterStateThanOneThatIsAdded) {
  StatusQueue queue(milliseconds(500));
  queue.add(state_of("a", "known"));
  EXPECT_EQ(queue.take(SteadyTime{})->machine.description, "known");
  queue.note(state_of("a", "new"));
  queue.add(state_of("a", "known"));
  EXPECT_EQ(queue.take(SteadyTime{} + milliseconds(500))->machine.description, "new");
}

TEST(StatusQueue, LetsOnePassInEachInterval) {
  StatusQueue queue(milliseconds(500));
  const SteadyTime now{std::chrono::seconds(100)};
  queue.note(state_of("a"));
  ASSERT_TRUE(queue.take(now));
  queue.note(state_of("a", "second"));
  EXPECT_FALSE(queue.take(now + milliseconds(499)));
  EXPECT_EQ(queue.next_due(), now + milliseconds(500));
  queue.note(state_of("a", "third"));
  EXPECT_EQ(queue.take(now + milliseconds(500))->machine.description, "third");
  EXPECT_FALSE(queue.next_due());
}

TEST(StatusQueue, LetsNoMachineWaitForAnother) {
  StatusQueue queue(milliseconds(0));
  const SteadyTime now{std::chrono::seconds(100)};
  std::string order;
  for (int i = 0; i < 4; ++i) {
    queue.note(state_of("a"));
    queue.note(state_of("b"));
    order += queue.take(now)->machine.name;
  }
  EXPECT_EQ(order, "abab");
}

}  // namespace
}  // namespace dripline::mqtt
