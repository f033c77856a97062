#include "gateway/interpreter/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dripline::interpreter {
namespace {

TEST(Registry, AnUnknownControlIsNotFoundAndNamed) {
  const auto found = find_dialect("no-such-control");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::NotFound);
  EXPECT_THAT(found.error().what, testing::HasSubstr("no-such-control"));
  for (const Dialect& dialect : dialects()) {
    EXPECT_THAT(found.error().what, testing::HasSubstr(std::string(dialect.name)));
  }
}

TEST(Registry, EveryDialectIsFoundByItsNameAndComplete) {
  for (const Dialect& dialect : dialects()) {
    const auto found = find_dialect(dialect.name);
    ASSERT_TRUE(found) << dialect.name;
    EXPECT_EQ(*found, &dialect) << "two dialects of one name";
    EXPECT_NE(dialect.likelihood, nullptr);
    EXPECT_NE(dialect.make, nullptr);
    EXPECT_FALSE(dialect.title.empty());
  }
}

/// Row: CEN-052.
TEST(Registry, TheCenturionsFeedKnobHasStepsOfTenPercentUpTo150) {
  const auto dialect = find_dialect("centurion");
  ASSERT_TRUE(dialect);
  EXPECT_EQ((*dialect)->feed_override_switch.step, 0.1);
  EXPECT_EQ((*dialect)->feed_override_switch.most, 1.5);
  EXPECT_FALSE((*dialect)->feed_override_switch.fastest);
}

TEST(Registry, AnEmptyProgramIsNoControlsForSure) {
  EXPECT_NE(detect_dialect("", "program").size(), 1U);
}

TEST(Snapshot, EqualStatesHaveEqualDigestsAndOthersDoNot) {
  const Snapshot base{"one", 1, {std::byte{1}, std::byte{2}}};
  Snapshot other = base;
  EXPECT_EQ(base.digest(), other.digest());
  other.bytes[1] = std::byte{3};
  EXPECT_NE(base.digest(), other.digest());
  other = base;
  other.version = 2;
  EXPECT_NE(base.digest(), other.digest());
  other = base;
  other.dialect = "two";
  EXPECT_NE(base.digest(), other.digest());
}

}  // namespace
}  // namespace dripline::interpreter
