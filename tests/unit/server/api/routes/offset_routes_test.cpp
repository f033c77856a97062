#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class OffsetRoutes : public ApiTest {
 protected:
  static constexpr const char* kRules =
      "[[rule]]\nname = \"D40\"\ncharacteristic = \"D40\"\ntarget = \"T3.wear.X\"\nmax_step = "
      "0.1\n";

  OffsetRoutes() {
    show_machine("lathe-1");
    EXPECT_TRUE(setups_->save({.machine = "lathe-1",
                               .control = "centurion",
                               .text = "units = \"mm\"\n[[tool]]\nnumber = 3\n",
                               .comment = {}},
                              "meyer"));
  }

  std::uint64_t propose(double new_value) {
    const auto rules =
        call("PUT", "/api/v1/machines/lathe-1/offset-rules", {.body = kRules, .headers = {}});
    EXPECT_EQ(rules.status, 200) << rules.body;
    storage::OffsetProposal proposal;
    proposal.machine = "lathe-1";
    proposal.rule = "D40";
    proposal.target = "T3.wear.X";
    proposal.unit = "mm";
    proposal.new_value = new_value;
    proposal.base = 1;
    proposal.created = clock_.now();
    proposal.reasons = R"(["mean deviation +0.02"])";
    return store_->offsets.propose(proposal)->proposal.id;
  }
  std::string path(std::uint64_t id, const std::string& verb) const {
    return fmt::format("/api/v1/machines/lathe-1/offsets/{}/{}", id, verb);
  }
};

TEST_F(OffsetRoutes, ListShowAndApprove) {
  const auto id = propose(-0.01);
  const auto listed = json(get("/api/v1/offsets?state=pending"));
  ASSERT_EQ(listed["offsets"].size(), 1U);
  EXPECT_EQ(listed["offsets"][0]["reasons"][0], "mean deviation +0.02");
  EXPECT_EQ(json(get(fmt::format("/api/v1/offsets/{}", id)))["new_value"], -0.01);
  const auto applied = post(path(id, "approve"), {{"comment", "measured twice"}});
  ASSERT_EQ(applied.status, 200) << applied.body;
  EXPECT_EQ(json(applied)["state"], "applied");
  EXPECT_EQ(json(applied)["setup"], 2);
  EXPECT_EQ(json(applied)["who"], "admin");
  expect_error(post(path(id, "approve"), Json::object()), 409, "conflict", "is applied already");
  const auto history = json(get("/api/v1/machines/lathe-1/offset-history?target=T3"));
  ASSERT_EQ(history["history"].size(), 1U) << history.dump();
  EXPECT_EQ(history["history"][0]["value"], -0.01);
  EXPECT_EQ(history["history"][0]["proposal"]["id"], id);
  EXPECT_EQ(history["history"][0]["archived"], 0);
  EXPECT_TRUE(history["history"][0]["archives"].empty());
  EXPECT_TRUE(history["history"][0]["uncounted"].empty());
}

TEST_F(OffsetRoutes, RejectWantsAReason) {
  const auto id = propose(-0.01);
  expect_error(post(path(id, "reject"), Json::object()), 400, "syntax",
               "a rejection needs a reason");
  const auto rejected = post(path(id, "reject"), {{"comment", "a chip"}});
  ASSERT_EQ(rejected.status, 200) << rejected.body;
  EXPECT_EQ(json(rejected)["state"], "rejected");
}

TEST_F(OffsetRoutes, AnotherMachinesProposalIsNotFound) {
  show_machine("lathe-2");
  const auto id = propose(-0.01);
  expect_error(post(fmt::format("/api/v1/machines/lathe-2/offsets/{}/approve", id), Json::object()),
               404, "not_found", "machine lathe-2 has no offset proposal");
}

TEST_F(OffsetRoutes, AProgrammerMayLookAndNotApprove) {
  const auto id = propose(-0.01);
  const std::string token = token_of("programmer");
  EXPECT_EQ(call("GET", "/api/v1/offsets", {.body = {}, .headers = {}, .token = token}).status,
            200);
  EXPECT_EQ(call("POST", path(id, "approve"), {.body = "{}", .headers = {}, .token = token}).status,
            403);
  EXPECT_EQ(call("POST", path(id, "approve"),
                 {.body = "{}", .headers = {}, .token = token_of("approver")})
                .status,
            200);
}

TEST_F(OffsetRoutes, RulesAreStoredAndEvaluated) {
  const std::string rules = "/api/v1/machines/lathe-1/offset-rules";
  expect_error(get(rules), 404, "not_found", "no offset rules");
  expect_error(call("PUT", rules, {.body = "[[rule]]\n", .headers = {}}), 400, "syntax",
               "name is missing");
  const auto saved = call("PUT", rules, {.body = kRules, .headers = {}});
  ASSERT_EQ(saved.status, 200) << saved.body;
  EXPECT_EQ(json(get(rules))["text"], kRules);
  expect_error(call("PUT", rules,
                    {.body = "[[rule]]\nname = \"L\"\ncharacteristic = \"L\"\ntarget = "
                             "\"T99.wear.X\"\nmax_step = 1\n",
                     .headers = {}}),
               409, "conflict", "rule L: setup 1 of lathe-1 has no tool 99");
  const auto looked = json(post("/api/v1/machines/lathe-1/offsets/evaluation", Json::object()));
  ASSERT_EQ(looked["rules"].size(), 1U) << looked.dump();
  EXPECT_EQ(looked["rules"][0]["reasons"][0],
            "0 measurements under the value in force, 3 are needed");
  EXPECT_TRUE(looked["rules"][0]["proposal"].is_null());
}

TEST_F(OffsetRoutes, ChartsWantACharacteristicAndUnderstandTheirQuery) {
  const std::string chart = "/api/v1/measurements/chart";
  expect_error(get(chart), 400, "syntax", "'characteristic' is missing");
  expect_error(get(chart + "?characteristic=D40"), 404, "not_found",
               "nothing was measured of characteristic D40");
  expect_error(get(chart + "?characteristic=D40&kind=pie"), 400, "syntax", "chart 'pie'");
  expect_error(get(chart + "?characteristic=D40&colour=red"), 400, "syntax", "'colour'");
  expect_error(get(chart + "?characteristic=D40&width=99999"), 413, "limit_exceeded", "width");
  expect_error(get(chart + "?characteristic=D40&last=0"), 413, "limit_exceeded", "last");
}

}  // namespace
}  // namespace dripline::server_test
