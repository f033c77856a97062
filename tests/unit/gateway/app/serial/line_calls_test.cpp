#include "gateway/app/serial/line_calls.hpp"

#include <gtest/gtest.h>

namespace dripline::gateway {
namespace {

using dds::LineCallAction;

TEST(LineCalls, KeepTheLatestUntilItIsAnswered) {
  const SteadyTime now{};
  LineCalls calls("O9998");
  EXPECT_FALSE(calls.call());
  calls.add(LineCallAction::Send, "O15", now);
  calls.add(LineCallAction::Program, "", now);
  ASSERT_TRUE(calls.call());
  EXPECT_EQ(calls.call()->number, 2U);
  EXPECT_EQ(calls.call()->reply, "O9998");
  calls.end(1);
  EXPECT_TRUE(calls.call()) << "an answer to the one before";
  calls.end(2);
  EXPECT_FALSE(calls.call());
}

/// A server that comes back later must not begin what was meant an hour ago.
TEST(LineCalls, AreVoidAfterAMinute) {
  const SteadyTime now{};
  LineCalls calls("O9998");
  calls.add(LineCallAction::Send, "O15", now);
  calls.poll(now + LineCalls::kLife - std::chrono::seconds(1));
  EXPECT_TRUE(calls.call());
  calls.poll(now + LineCalls::kLife);
  EXPECT_FALSE(calls.call());
}

}  // namespace
}  // namespace dripline::gateway
