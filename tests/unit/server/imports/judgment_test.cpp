#include "server/imports/judgment.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dripline::imports {
namespace {

using Json = nlohmann::json;

/// An edit of comments alone of the newest revision, from a machine with a setup: the clearest
/// case.
class Judgment : public testing::Test {
 protected:
  Judgment() {
    base.number = 4;
    revision.number = 5;
    revision.comment = "punched by lathe-1";
    comparison = {{"class", "comment"}, {"motion", {{"conditions", Json::array()}}}};
  }
  std::string judge() {
    const auto policy = library::ReleasePolicy::parse(policy_text);
    EXPECT_TRUE(policy) << policy.error().what;
    return reason_to_wait(*policy, {.revision = revision,
                                    .base = base,
                                    .newest = newest,
                                    .comparison = comparison,
                                    .has_setup = has_setup})
        .value_or("");
  }

  storage::Revision base, revision;
  std::uint64_t newest = 4;
  bool has_setup = true;
  Json comparison;
  std::string policy_text = "[imports]\naccept_at_once = [\"comment\", \"feed_and_speed\"]";
};

TEST_F(Judgment, AcceptsWhatThePolicyNames) {
  EXPECT_EQ(judge(), "");
  comparison["class"] = "feed_and_speed";
  EXPECT_EQ(judge(), "");
}

TEST_F(Judgment, LeavesEverythingToAPersonWithoutAPolicy) {
  policy_text = "";
  EXPECT_EQ(judge(), "the policy leaves edits of class comment to a person");
}

TEST_F(Judgment, LeavesOtherClassesToAPerson) {
  for (const char* edit : {"none", "same_motion", "offsets", "geometry", "other"}) {
    comparison["class"] = edit;
    EXPECT_NE(judge(), "") << edit;
  }
  comparison.erase("class");
  EXPECT_NE(judge(), "");
}

TEST_F(Judgment, LeavesADamagedTextToAPerson) {
  revision.comment = "punched by lathe-1; DAMAGED 2 times, first: parity";
  EXPECT_EQ(judge(), "it came over a line with faults");
}

TEST_F(Judgment, LeavesAnEditOfWhatIsNotTheNewestToAPerson) {
  newest = 6;
  EXPECT_EQ(judge(), "revision 6 is newer than revision 4, with which it was compared");
}

TEST_F(Judgment, LeavesAnEditOfAWithdrawnRevisionToAPerson) {
  base.state = storage::RevisionState::Withdrawn;
  EXPECT_EQ(judge(), "revision 4 was withdrawn");
}

TEST_F(Judgment, LeavesItToAPersonWhenTheComparisonMetAnAlarm) {
  comparison["motion"]["conditions"] = {{{"kind", "probe"}, {"line", 3}, {"text", "?"}}};
  EXPECT_EQ(judge(), "") << "a probe is the machine's business";
  for (const char* kind : {"alarm", "fault"}) {
    comparison["motion"]["conditions"][0] = {{"kind", kind}, {"line", 7}, {"text", "NC0107"}};
    EXPECT_EQ(judge(), fmt::format("the comparison met an {} at line 7: NC0107", kind));
  }
  comparison.erase("motion");
  EXPECT_EQ(judge(), "it was not compared by motion");
}

TEST_F(Judgment, AcceptsOnlyCommentsOfAMachineWithoutSetup) {
  has_setup = false;
  EXPECT_EQ(judge(), "");
  comparison["class"] = "feed_and_speed";
  EXPECT_EQ(judge(), "the machine has no setup with which motion can be compared");
}

}  // namespace
}  // namespace dripline::imports
