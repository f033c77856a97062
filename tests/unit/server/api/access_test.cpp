// Who may do what: every role on every route, cookies, groups of machines, and what is noted of it.
#include <set>

#include "server/identity/permission.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

constexpr std::array kRoles{"viewer", "operator", "programmer", "approver", "administrator"};

class Access : public ApiTest {
 protected:
  /// A path of this pattern. What it names is not there, so that nothing happens to what is.
  static std::string path_of(std::string pattern, const std::string& user) {
    const bool is_own =
        pattern.starts_with("/api/v1/users/{name}/") || pattern == "/api/v1/users/{name}";
    const auto replace = [&](const std::string& name, const std::string& value) {
      if (const auto at = pattern.find(name); at != std::string::npos)
        pattern.replace(at, name.size(), value);
    };
    replace("{name}", is_own ? user : "absent");
    for (const char* name : {"{id}", "{run}", "{group}", "{machine}", "{token}", "{job}"})
      replace(name, "absent");
    replace("{number}", "1");
    return pattern;
  }
  api::Response as(const std::string& token, const std::string& method, const std::string& path,
                   const std::string& body = "") {
    return call(method, path, {.body = body, .headers = {}, .token = token});
  }
  /// With the cookie that a sign-in of this user gave.
  api::Response by_cookie(const std::string& cookie, const std::string& method,
                          const std::string& path, std::map<std::string, std::string> headers) {
    headers["cookie"] = cookie;
    return call(method, path, {.body = "", .headers = std::move(headers), .token = ""});
  }
  /// The cookie of a page session, as a browser sends it back.
  std::string sign_in(const std::string& user) {
    const auto response = call("POST", "/api/v1/session",
                               {.body = Json{{"user", user}, {"password", "correct horse"}}.dump(),
                                .headers = {{"x-dripline", "1"}},
                                .token = ""});
    EXPECT_EQ(response.status, 201) << response.body;
    EXPECT_FALSE(json(response).contains("secret")) << "no script of the page reads it";
    const std::string cookie = header(response, "Set-Cookie");
    EXPECT_NE(cookie.find("HttpOnly; SameSite=Strict"), std::string::npos);
    return cookie.substr(0, cookie.find(';'));
  }
  void add_user(const std::string& name, const std::string& role, const Json& groups) {
    const auto response =
        post("/api/v1/users",
             {{"name", name}, {"role", role}, {"groups", groups}, {"password", "correct horse"}});
    ASSERT_EQ(response.status, 201) << response.body;
  }
  std::string token(const std::string& user, const Json& wanted) {
    const auto response = post("/api/v1/users/" + user + "/tokens", wanted);
    EXPECT_EQ(response.status, 201) << response.body;
    return json(response).value("secret", "");
  }
  Json last_audit() { return json(get("/api/v1/audit"))["entries"][0]; }
};

/// The lowest role that each permission needs, stated here once more: a change of the table in
/// server/identity has to be meant.
int lowest_role(const std::string& permission) {
  static const std::map<std::string, int> kLowest{{"open", -1},   {"signed_in", 0}, {"view", 0},
                                                  {"operate", 1}, {"program", 2},   {"set_up", 2},
                                                  {"approve", 3}, {"administer", 4}};
  return kLowest.at(permission);
}

TEST_F(Access, IsGivenToEachRoleOnEachRoute) {
  const Json document = json(get("/api/v1/openapi.json"));
  std::set<std::string> seen;
  for (std::size_t role = 0; role < kRoles.size(); ++role) {
    const std::string secret = token_of(kRoles[role]);
    for (const auto& [pattern, item] : document["paths"].items()) {
      for (const auto& [verb, operation] : item.items()) {
        std::string method;
        for (const char c : verb) method += static_cast<char>(c - 'a' + 'A');
        const std::string name = fmt::format("{} {}", method, pattern);
        const int lowest = lowest_role(operation.value("x-permission", "none"));
        seen.insert(operation.value("x-permission", "none"));
        const std::string user = lowest > 3 ? "absent" : std::string("a-") + kRoles[role];
        const std::string path = path_of(pattern, user);
        const auto response = as(secret, method, path);
        if (static_cast<int>(role) < lowest) {
          EXPECT_EQ(response.status, 403) << kRoles[role] << " " << name << response.body;
        } else {
          EXPECT_NE(response.status, 403) << kRoles[role] << " " << name << response.body;
          EXPECT_NE(response.status, 401) << kRoles[role] << " " << name << response.body;
          EXPECT_NE(response.status, 405) << kRoles[role] << " " << name << response.body;
        }
        if (role > 0) continue;
        const auto stranger = as("", method, path);
        EXPECT_EQ(stranger.status == 401, lowest >= 0) << name << stranger.body;
        EXPECT_EQ(as(std::string(64, 'f'), method, path).status == 401, lowest >= 0) << name;
      }
    }
  }
  EXPECT_EQ(seen.size(), 8u) << "every permission was tried";
}

TEST_F(Access, OfRolesIsAsTheDocumentsSay) {
  using enum identity::Permission;
  for (const auto permission :
       {Open, SignedIn, View, Operate, Program, SetUp, Approve, Administer}) {
    const auto role = identity::lowest_role(permission);
    const int lowest = lowest_role(std::string(identity::to_string(permission)));
    if (role) {
      EXPECT_EQ(static_cast<int>(*role), lowest) << identity::to_string(permission);
    } else {
      EXPECT_LE(lowest, 0);
    }
  }
}

// -- machines of groups ---------------------------------------------------------------------------

TEST_F(Access, ToAnotherGroupsMachineIsRefusedOnEveryRouteThatActsOnOne) {
  const std::string run = stored_run(1);  // on lathe-1
  storage::Port port;
  port.name = "line-1";
  port.machine = "lathe-1";
  ports::PortView view;
  view.port = port;
  ports_.views.push_back(view);
  EXPECT_EQ(call("PUT", "/api/v1/machine-groups/mills").status, 201);
  EXPECT_EQ(call("PUT", "/api/v1/machine-groups/mills/machines/mill-1").status, 200);
  add_user("milo", "approver", {"mills"});
  const std::string secret = token("milo", {{"name", "t"}});
  const std::string hold = R"({"action":"hold"})";
  const std::string start = R"({"machine":"lathe-1","program":"O0100"})";
  struct Try {
    std::string method, path, body;
  };
  const std::vector<Try> tries{
      {"POST", "/api/v1/machines/lathe-1/commands",
       R"({"action":"switch","name":"emergency_stop","value":0})"},
      {"POST", "/api/v1/machines/lathe-1/confirm-gateway", ""},
      {"POST", "/api/v1/machines/lathe-1/mdi", R"({"text":"G0 X1"})"},
      {"POST", "/api/v1/machines/lathe-1/datum", R"({"axis":"Z","value":0,"offset":"G54"})"},
      {"POST", "/api/v1/machines/lathe-1/jog", R"({"axis":"Z","distance":1,"unit":"mm"})"},
      {"POST", "/api/v1/machines/lathe-1/jog/hold", R"({"hold":"a1"})"},
      {"POST", "/api/v1/machines/lathe-1/touch-off",
       R"({"tool":3,"axis":"Z","value":0,"offset":"G54"})"},
      {"PUT", "/api/v1/machines/lathe-1/setup", "[[tool]]\nnumber = 1\n"},
      {"POST", "/api/v1/runs", start},
      {"POST", "/api/v1/runs/" + run + "/restart", "{}"},
      {"POST", "/api/v1/runs/" + run + "/commands", hold},
      {"POST", "/api/v1/ports/line-1/transfers", R"({"programs":["O0100"]})"},
      {"POST", "/api/v1/ports/line-1/receive", ""},
      {"POST", "/api/v1/ports/line-1/confirm-reset", ""},
      {"DELETE", "/api/v1/ports/line-1/transfers", ""},
      {"POST", "/api/v1/machines/lathe-1/offsets/1/approve", "{}"},
      {"POST", "/api/v1/machines/lathe-1/offsets/1/reject", "{}"},
      {"POST", "/api/v1/machines/lathe-1/offsets/evaluation", ""},
      {"PUT", "/api/v1/machines/lathe-1/offset-rules", ""},
      {"POST", "/api/v1/machines/lathe-1/jobs", R"({"program":"O0100"})"},
      {"PUT", "/api/v1/machines/lathe-1/jobs/1", R"({"place":1})"},
      {"DELETE", "/api/v1/machines/lathe-1/jobs/1", ""},
      {"POST", "/api/v1/machines/lathe-1/start-job", "{}"},
      {"PUT", "/api/v1/machines/lathe-1/setup/loaded", R"({"revision":1})"},
      {"PUT", "/api/v1/machines/lathe-1/job-hold", R"({"reason":"wide"})"},
      {"DELETE", "/api/v1/machines/lathe-1/job-hold", ""},
      {"PUT", "/api/v1/report-template-assignments/machine/lathe-1/bore", ""},
      {"DELETE", "/api/v1/report-template-assignments/machine/lathe-1/bore", ""},
  };
  std::size_t guarded = 0;
  for (const auto& row : api::route_permissions())
    guarded += row.machine == api::MachineIn::Nowhere ? 0 : 1;
  EXPECT_EQ(tries.size(), guarded) << "every route that acts on a machine";
  for (const auto& [method, path, body] : tries)
    expect_error(as(secret, method, path, body), 403, "denied", "lathe-1");
  EXPECT_TRUE(machines_.commands.empty() && machines_.started.empty()) << "nothing went out";
  EXPECT_TRUE(machines_.positions.empty() && machines_.confirmed.empty()) << "nor this";
  // With the machine in his group the same requests go through to the handlers.
  EXPECT_EQ(call("PUT", "/api/v1/machine-groups/mills/machines/lathe-1").status, 200);
  for (const auto& [method, path, body] : tries)
    EXPECT_NE(as(secret, method, path, body).status, 403) << path;
}

TEST_F(Access, OfATokenEndsWithItsOwnersRights) {
  show_machine("lathe-1");
  add_user("anna", "programmer", {"all"});
  const std::string secret = token("anna", {{"name", "mes"}, {"role", "operator"}});
  const std::string body = R"({"action":"switch","name":"x","value":1})";
  const std::string path = "/api/v1/machines/lathe-1/commands";
  EXPECT_NE(as(secret, "POST", path, body).status, 403);
  EXPECT_EQ(as(secret, "POST", "/api/v1/uploads").status, 403) << "the token's role";
  EXPECT_EQ(
      call("PUT", "/api/v1/users/anna", {.body = R"({"role":"viewer"})", .headers = {}}).status,
      200);
  EXPECT_EQ(as(secret, "POST", path, body).status, 403) << "the owner's role";
  EXPECT_EQ(as(secret, "GET", "/api/v1/machines").status, 200);
  EXPECT_EQ(call("DELETE", "/api/v1/users/anna").status, 204);
  EXPECT_EQ(as(secret, "GET", "/api/v1/machines").status, 401);
}

/// Otherwise an author could approve what he sent himself, under another one's name.
TEST_F(Access, ToAnUploadHasOnlyWhoBeganIt) {
  add_user("bert", "programmer", {"all"});
  add_user("carl", "approver", {"all"});
  const std::string bert = token("bert", {{"name", "t"}}), carl = token("carl", {{"name", "t"}});
  const auto begun = as(bert, "POST", "/api/v1/uploads", R"({"program":"O1"})");
  ASSERT_EQ(begun.status, 201) << begun.body;
  const std::string upload = "/api/v1/uploads/" + json(begun).value("id", "");
  const std::string content = upload + "/content?offset=0";
  for (const auto& [method, path] :
       std::vector<std::pair<std::string, std::string>>{{"GET", upload},
                                                        {"PUT", content},
                                                        {"POST", upload + "/commit"},
                                                        {"POST", upload + "/attach"},
                                                        {"DELETE", upload}})
    expect_error(as(carl, method, path, method == "PUT" ? "M30\n" : ""), 404, "not_found", "carl");
  EXPECT_EQ(json(as(bert, "GET", upload)).value("received", 9), 0);
  EXPECT_EQ(as(bert, "PUT", content, "G0 X1.\nM30\n").status, 200);
}

// -- cookies --------------------------------------------------------------------------------------

TEST_F(Access, ByCookieNeedsTheHeaderOfOurPageForChanges) {
  add_user("anna", "programmer", {"all"});
  const std::string cookie = sign_in("anna");
  const std::string upload = "/api/v1/uploads";
  EXPECT_EQ(by_cookie(cookie, "GET", "/api/v1/machines", {}).status, 200);
  expect_error(by_cookie(cookie, "POST", upload, {}), 403, "denied", "X-Dripline");
  EXPECT_EQ(by_cookie(cookie, "POST", upload, {{"x-dripline", "1"}}).status, 400) << "passed";
  EXPECT_EQ(
      by_cookie(cookie, "POST", upload, {{"x-dripline", "1"}, {"sec-fetch-site", "cross-site"}})
          .status,
      403);
  EXPECT_EQ(
      by_cookie(cookie, "POST", upload, {{"x-dripline", "1"}, {"sec-fetch-site", "same-origin"}})
          .status,
      400);
  EXPECT_EQ(by_cookie(cookie + "; " + cookie, "GET", "/api/v1/machines", {}).status, 401);
  EXPECT_EQ(by_cookie(cookie, "DELETE", "/api/v1/session", {}).status, 403);
  const auto out = by_cookie(cookie, "DELETE", "/api/v1/session", {{"x-dripline", "1"}});
  EXPECT_EQ(out.status, 204);
  EXPECT_NE(header(out, "Set-Cookie").find("Max-Age=0"), std::string::npos);
  EXPECT_EQ(by_cookie(cookie, "GET", "/api/v1/machines", {}).status, 401);
}

TEST_F(Access, BySignInForACookieNeedsTheHeaderToo) {
  add_user("anna", "viewer", Json::array());
  const std::string body = R"({"user":"anna","password":"correct horse"})";
  EXPECT_EQ(as("", "POST", "/api/v1/session", body).status, 403)
      << "no other site signs a browser in";
}

TEST_F(Access, BySignInIsLimitedAndTellsNothing) {
  add_user("anna", "viewer", Json::array());
  const auto attempt = [&](const std::string& user, const std::string& password) {
    return as("", "POST", "/api/v1/session",
              Json{{"user", user}, {"password", password}, {"bearer", true}}.dump());
  };
  const auto wrong = attempt("anna", "wrong password");
  expect_error(wrong, 401, "denied", "do not belong together");
  EXPECT_EQ(attempt("stranger", "wrong password").body, wrong.body);
  int limited = 0;
  for (int i = 0; i < 20; ++i) limited += attempt("anna", "wrong").status == 429 ? 1 : 0;
  EXPECT_EQ(limited, 11);
  const auto right = attempt("anna", "correct horse");
  EXPECT_EQ(right.status, 429);
  EXPECT_NE(header(right, "Retry-After"), "");
  EXPECT_EQ(attempt("stranger", std::string(2000, 'x')).status, 413);
  EXPECT_EQ(as("", "POST", "/api/v1/session", std::string(1 << 20, 'x')).status, 413);
}

TEST_F(Access, OfBodiesWithoutALengthIsRefusedToStrangers) {
  EXPECT_EQ(call("POST", "/api/v1/session",
                 {.body = "{}", .headers = {{"content-length", ""}}, .token = ""})
                .status,
            413);
}

// -- the audit trail ------------------------------------------------------------------------------

TEST_F(Access, IsInTheAuditTrailWithUserTokenAndAddress) {
  add_user("anna", "programmer", {"all"});
  const std::string secret = token("anna", {{"name", "cam-office"}});
  ASSERT_EQ(as(secret, "PUT", "/api/v1/machines/lathe-1/setup?control=centurion",
               "[[tool]]\nnumber = 1\n")
                .status,
            201);
  auto entry = last_audit();
  EXPECT_EQ(entry["action"], "setup.save");
  EXPECT_EQ(entry["who"], "anna");
  EXPECT_EQ(entry["credential"], "cam-office");
  EXPECT_EQ(entry["address"], "192.0.2.1");
  EXPECT_EQ(as(secret, "GET", "/api/v1/users").status, 403);
  accounts_->refusals().flush();
  entry = last_audit();
  EXPECT_EQ(entry["action"], "access.refused");
  EXPECT_EQ(entry["who"], "anna");
  EXPECT_EQ(entry["subject"], "GET /api/v1/users");
  EXPECT_EQ(entry["detail"], "anna has the role programmer: this needs administrator");
  EXPECT_EQ(as("0123", "GET", "/api/v1/users").status, 401);
  accounts_->refusals().flush();
  entry = last_audit();
  EXPECT_EQ(entry["subject"], "a token that is not valid");
  EXPECT_EQ(entry["address"], "192.0.2.1");
}

TEST_F(Access, NeverWritesASecretIntoTheAuditTrail) {
  add_user("anna", "programmer", {"all"});
  const std::string secret = token("anna", {{"name", "mes"}});
  sign_in("anna");
  (void)as("", "POST", "/api/v1/session",
           R"({"user":"anna","password":"wrong horse","bearer":true})");
  accounts_->refusals().flush();
  const std::string trail = get("/api/v1/audit").body;
  for (const std::string& text : {secret, std::string("correct horse"), std::string("wrong horse")})
    EXPECT_EQ(trail.find(text), std::string::npos);
}

/// A body that is wrong is answered without repeating what may be a password.
TEST_F(Access, NeverAnswersWithThePassword) {
  for (const char* body :
       {R"({"user":"anna","password":"correct horse","other":1})", R"({"password":"correct horse")",
        R"({"user":1,"password":"correct horse"})",
        R"({"user":"anna","password":["correct horse"]})"})
    EXPECT_EQ(as("", "POST", "/api/v1/session", body).body.find("correct horse"), std::string::npos)
        << body;
}

}  // namespace
}  // namespace dripline::server_test
