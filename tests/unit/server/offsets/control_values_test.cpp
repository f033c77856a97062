#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

/// Rules for machines whose controls have other values than a lathe's.
class ControlValues : public OffsetsTest {
 protected:
  Result<storage::OffsetRules> put(const std::string& machine, const std::string& target) {
    return offsets_->save_rules(
        machine,
        fmt::format("[[rule]]\nname = \"W\"\ncharacteristic = \"D40\"\ntarget = \"{}\"\n"
                    "gain = 1\nmax_step = 0.1\n",
                    target),
        "anna");
  }
};

TEST_F(ControlValues, ARuleForWhatTheControlHasNotIsRefusedWithWhatItHas) {
  add_machine("mill-3", "tnc155");
  for (const char* target : {"T3.wear.radius", "T3.wear.Z", "T3.wear.X", "T3.X"}) {
    const auto refused = put("mill-3", target);
    ASSERT_FALSE(refused) << target;
    EXPECT_EQ(refused.error().code, Errc::Unsupported);
    const std::string key = std::string(target).substr(3);
    EXPECT_EQ(refused.error().what,
              fmt::format("rule W: target {}: tnc155 has no {} of a tool, so a correction of it "
                          "would do nothing; it has length, Z, radius",
                          target, key));
  }
  EXPECT_FALSE(store_->offsets.rules("mill-3")) << "nothing is stored";
  EXPECT_TRUE(put("mill-3", "T3.radius"));
  EXPECT_TRUE(put("mill-3", "T3.length"));
  EXPECT_TRUE(put("mill-3", "datum.Z"));
}

TEST_F(ControlValues, AControlThatTakesNothingOfASetupHasNothingToCorrect) {
  add_machine("mill-1704", "tektronix-1704");
  EXPECT_NE(put("mill-1704", "T3.radius").error().what.find("has no tools in its setup"),
            std::string::npos);
  EXPECT_NE(put("mill-1704", "G54.X").error().what.find("has no offsets in its setup"),
            std::string::npos);
  EXPECT_NE(put("mill-1704", "#5").error().what.find("has no variables in its setup"),
            std::string::npos);
}

/// A rule that an earlier version stored.
TEST_F(ControlValues, AStoredRuleThatCanDoNothingProposesNothing) {
  use_rules();
  auto machine = *store_->machines.find("lathe-1");
  machine.control = "tnc155";
  ASSERT_TRUE(store_->machines.save(machine));
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto looked = offsets_->look("lathe-1");
  ASSERT_TRUE(looked) << looked.error().what;
  EXPECT_FALSE(looked->front().proposal);
  EXPECT_NE(looked->front().outcome.reasons.back().find("tnc155 has no wear.X of a tool"),
            std::string::npos);
}

TEST_F(ControlValues, NorIsItsProposalApproved) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto id = only_proposal().id;
  auto machine = *store_->machines.find("lathe-1");
  machine.control = "tnc155";
  ASSERT_TRUE(store_->machines.save(machine));
  const auto refused = offsets_->approve({.id = id, .who = "anna", .time = {}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("tnc155 has no wear.X of a tool"), std::string::npos);
}

}  // namespace
}  // namespace dripline::offsets
