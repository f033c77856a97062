#include "server/library/release_policy.hpp"

#include <gtest/gtest.h>

namespace dripline::library {
namespace {

using storage::RevisionState;
using storage::RevisionStep;
using storage::Role;

TEST(ReleasePolicy, WithoutAWordIsWhatWasAlwaysSo) {
  const auto policy = ReleasePolicy::parse("");
  ASSERT_TRUE(policy) << policy.error().what;
  EXPECT_FALSE(policy->runs_released_only);
  EXPECT_TRUE(policy->prove_out_machines.empty());
  EXPECT_EQ(policy->rule(RevisionStep::Submit).role, Role::Programmer);
  EXPECT_EQ(policy->rule(RevisionStep::Release).from,
            (std::set<RevisionState>{RevisionState::Approved}));
  EXPECT_FALSE(policy->rule(RevisionStep::Approve).needs_four_eyes);
}

TEST(ReleasePolicy, IsReadFromItsFile) {
  const std::string text = R"(
runs = "release"
[prove_out]
machines = ["mill-3"]
role = "operator"
[approve]
four_eyes = true
comment = true
[release]
role = "administrator"
from = ["draft", "approved"]
)";
  const auto policy = ReleasePolicy::parse(text);
  ASSERT_TRUE(policy) << policy.error().what;
  EXPECT_TRUE(policy->runs_released_only);
  EXPECT_TRUE(policy->prove_out_machines.contains("mill-3"));
  EXPECT_EQ(policy->prove_out_role, Role::Operator);
  EXPECT_TRUE(policy->rule(RevisionStep::Approve).needs_four_eyes);
  EXPECT_TRUE(policy->rule(RevisionStep::Approve).needs_comment);
  EXPECT_EQ(policy->rule(RevisionStep::Release).role, Role::Administrator);
  EXPECT_EQ(policy->rule(RevisionStep::Release).from.size(), 2u);
  EXPECT_EQ(policy->digest, sha256(text));
}

TEST(ReleasePolicy, NamesWhatIsAcceptedFromMachinesAtOnce) {
  EXPECT_TRUE(ReleasePolicy::parse("")->accept_at_once.empty());
  const auto policy =
      ReleasePolicy::parse("[imports]\naccept_at_once = [\"comment\", \"offsets\"]");
  ASSERT_TRUE(policy) << policy.error().what;
  EXPECT_EQ(policy->accept_at_once, (std::set<std::string>{"comment", "offsets"}));
}

struct Wrong {
  const char *name, *text, *part;
};
class WrongPolicy : public testing::TestWithParam<Wrong> {};

/// A word that is not understood may be the one that was to keep a machine from running something.
TEST_P(WrongPolicy, IsRefusedWithItsPlace) {
  const auto policy = ReleasePolicy::parse(GetParam().text);
  ASSERT_FALSE(policy);
  EXPECT_NE(policy.error().what.find(GetParam().part), std::string::npos) << policy.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , WrongPolicy,
    testing::Values(
        Wrong{"no_toml", "runs = ", "line 1"},
        Wrong{"rule_of_runs", "\nruns = \"released\"", "line 2: runs must be open or release"},
        Wrong{"type_of_runs", "runs = true", "open or release"},
        Wrong{"unknown_key", "run = \"release\"", "line 1: run must be one of"},
        Wrong{"unknown_key_of_a_step", "[approve]\nfour-eyes = true", "line 2: four-eyes"},
        Wrong{"flag", "[approve]\nfour_eyes = \"yes\"", "four_eyes must be true or false"},
        Wrong{"role_below_the_api", "[release]\nrole = \"programmer\"", "at least approver"},
        Wrong{"unknown_role", "[release]\nrole = \"boss\"", "boss"},
        Wrong{"unknown_state", "[approve]\nfrom = [\"review\"]", "review"},
        Wrong{"release_of_what_was_withdrawn", "[release]\nfrom = [\"withdrawn\"]",
              "release is no step from withdrawn"},
        Wrong{"rejection_of_what_is_released", "[reject]\nfrom = [\"released\"]", "no step from"},
        Wrong{"viewer_proves_out", "[prove_out]\nrole = \"viewer\"", "at least operator"},
        Wrong{"machine", "[prove_out]\nmachines = [\"a b\"]", "a b"},
        Wrong{"key_of_imports", "[imports]\naccept = []", "line 2: accept must be"},
        Wrong{"class_for_a_person", "[imports]\naccept_at_once = [\"geometry\"]", "'geometry'"},
        Wrong{"unknown_class", "[imports]\naccept_at_once = [\"comments\"]", "'comments'"},
        Wrong{"step_is_no_table", "approve = true", "approve must be a table"}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::library
