// The states of revisions over the API: which role may take which step, and what is shown of it.
#include "protocol/base/signature.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

constexpr std::array kRoles{"viewer", "operator", "programmer", "approver", "administrator"};

class ReleaseRoutes : public ApiTest {
 protected:
  api::Response step(const std::string& token, const std::string& program, const std::string& name,
                     const Json& body = Json::object()) {
    return call("POST", "/api/v1/programs/" + program + "/revisions/1/" + name,
                {.body = body.dump(), .headers = {}, .token = token});
  }
  void use(const std::string& policy) {
    use_policy(policy);
    make_api(&ports_);
  }
};

/// Every role x every step, from a state where the step is there to be taken.
TEST_F(ReleaseRoutes, EachStepIsForTheRolesThePolicyNames) {
  use("[release]\nrole = \"administrator\"\n[submit]\nrole = \"approver\"");
  struct Step {
    const char* name;
    std::vector<const char*> before;
    std::size_t lowest;
  };
  const std::vector<Step> steps{{"submit", {}, 3},
                                {"approve", {"submit"}, 3},
                                {"reject", {"submit"}, 3},
                                {"release", {"submit", "approve"}, 4},
                                {"withdraw", {}, 3}};
  for (const Step& wanted : steps) {
    for (std::size_t role = 0; role < kRoles.size(); ++role) {
      const std::string program = fmt::format("{}-{}", wanted.name, kRoles[role]);
      push(program, "M2\n");
      for (const char* before : wanted.before)
        ASSERT_EQ(step(kSecret, program, before).status, 200) << program;
      const auto response = step(token_of(kRoles[role]), program, wanted.name);
      EXPECT_EQ(response.status, role < wanted.lowest ? 403 : 200) << program << response.body;
    }
  }
}

TEST_F(ReleaseRoutes, ShowWhatWasDecidedAndItsSignature) {
  push("O0100", "M2\n");
  ASSERT_EQ(step(kSecret, "O0100", "submit", {{"comment", "deeper groove"}}).status, 200);
  const auto approved = step(token_of("approver"), "O0100", "approve");
  EXPECT_EQ(json(approved)["state"], "approved");
  const auto released = json(step(kSecret, "O0100", "release"));
  EXPECT_EQ(released["state"], "released");
  EXPECT_EQ(released["released"], to_iso8601(clock_.now()));
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["action"], "program.release");
  const auto shown = json(call("GET", "/api/v1/programs/O0100/revisions/1/states",
                               {.body = {}, .headers = {}, .token = token_of("viewer")}));
  EXPECT_EQ(shown["state"], "released");
  ASSERT_EQ(shown["steps"].size(), 3u);
  EXPECT_EQ(shown["steps"][0]["comment"], "deeper groove");
  EXPECT_EQ(shown["steps"][1]["who"], "a-approver");
  const auto key = parse_public_key(shown["public_key"].get<std::string>()).value();
  for (const auto& decision : shown["steps"]) {
    const auto signature = parse_signature(decision["signature"].get<std::string>()).value();
    const std::string text = decision["text"];
    EXPECT_TRUE(is_signed_by(key, text, signature)) << "anybody can check it, elsewhere too";
    EXPECT_FALSE(is_signed_by(key, text + " ", signature));
  }
}

TEST_F(ReleaseRoutes, NobodyApprovesHisOwnWhereFourEyesAreAskedFor) {
  use("[approve]\nfour_eyes = true");
  const std::string token = token_of("approver");
  const Call of_approver{
      .body = R"({"program":"P","control":"centurion"})", .headers = {}, .token = token};
  const std::string id = json(call("POST", "/api/v1/uploads", of_approver))["id"];
  const std::string upload = "/api/v1/uploads/" + id;
  ASSERT_EQ(
      call("PUT", upload + "/content?offset=0", {.body = "M2\n", .headers = {}, .token = token})
          .status,
      200);
  ASSERT_EQ(call("POST", upload + "/commit", {.body = "{}", .headers = {}, .token = token}).status,
            201);
  ASSERT_EQ(step(token, "P", "submit").status, 200);
  expect_error(step(token, "P", "approve"), 403, "denied", "asks for another");
  accounts_->refusals().flush();
  const auto audited = json(get("/api/v1/audit"))["entries"][0];
  EXPECT_EQ(audited["action"], "access.refused");
  EXPECT_EQ(audited["subject"], "approve P revision 1");
  EXPECT_EQ(step(kSecret, "P", "approve").status, 200);
}

TEST_F(ReleaseRoutes, RefuseWhatIsNoStep) {
  push("P", "M2\n");
  expect_error(step(kSecret, "P", "release"), 409, "conflict", "is draft");
  expect_error(step(kSecret, "absent", "submit"), 404, "not_found", "absent");
  expect_error(step(kSecret, "P", "submit", {{"coment", "x"}}), 400, "syntax", "coment");
  expect_error(step(kSecret, "P", "reject"), 409, "conflict", "in force");
  expect_error(call("POST", "/api/v1/programs/P/revisions/x/submit"), 400, "syntax", "'x'");
}

TEST_F(ReleaseRoutes, AStartCarriesTheRoleOfWhoStarts) {
  show_machine("lathe-1");
  push("O0100", "M2\n");
  for (const char* role : {"operator", "programmer"}) {
    (void)call("POST", "/api/v1/runs",
               {.body = R"({"machine":"lathe-1","program":"O0100"})",
                .headers = {},
                .token = token_of(role)});
    ASSERT_FALSE(machines_.started.empty());
    EXPECT_EQ(storage::to_string(machines_.started.back().role), role);
  }
}

TEST_F(ReleaseRoutes, ThePolicyIsShown) {
  use("runs = \"release\"\n[prove_out]\nmachines = [\"mill-3\"]\n[approve]\nfour_eyes = true");
  const auto policy = json(get("/api/v1/release-policy"));
  EXPECT_EQ(policy["runs"], "release");
  EXPECT_EQ(policy["prove_out"]["machines"], Json({"mill-3"}));
  EXPECT_EQ(policy["steps"]["approve"]["four_eyes"], true);
  EXPECT_EQ(policy["steps"]["release"]["from"], Json({"approved"}));
}

}  // namespace
}  // namespace dripline::server_test
