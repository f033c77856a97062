// Hot folders, job queues, webhooks and client certificates over the API.
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class JobRoutes : public ApiTest {
 protected:
  JobRoutes() {
    add_machine("lathe-1");
    push("O1", "N10 G0 X1.\nM2\n");
    machines::MachineView view;
    view.machine = store_->machines.find("lathe-1").value();
    machines_.views.push_back(view);
  }
  std::uint64_t add(const Json& body = {{"program", "O1"}}) {
    const auto added = post(path_, body);
    EXPECT_EQ(added.status, 201) << added.body;
    return json(added).value("id", std::uint64_t{0});
  }
  Json queue(const std::string& state = "open") { return json(get(path_ + "?state=" + state)); }
  const std::string path_ = "/api/v1/machines/lathe-1/jobs";
};

TEST_F(JobRoutes, AddMoveAndRemove) {
  const auto first = add({{"program", "O1"}, {"quantity", 25}, {"comment", "steel"}});
  const auto second = add({{"program", "O1"}, {"revision", 1}, {"place", 1}});
  auto jobs = queue()["jobs"];
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs[0]["id"], second);
  EXPECT_EQ(jobs[1]["quantity"], 25);
  EXPECT_EQ(jobs[1]["state"], "waiting");
  EXPECT_EQ(jobs[1]["author"], "admin");
  const auto moved =
      call("PUT", fmt::format("{}/{}", path_, first), {.body = R"({"place":1})", .headers = {}});
  EXPECT_EQ(moved.status, 200) << moved.body;
  EXPECT_EQ(queue()["jobs"][0]["id"], first);
  EXPECT_EQ(call("DELETE", fmt::format("{}/{}", path_, first)).status, 204);
  EXPECT_EQ(queue("closed")["jobs"][0]["state"], "removed");
  expect_error(call("DELETE", path_ + "/x"), 400, "syntax", "'x'");
  expect_error(call("DELETE", path_ + "/99"), 404, "not_found", "99");
  expect_error(get("/api/v1/machines/mill-9/jobs"), 404, "not_found", "mill-9");
}

TEST_F(JobRoutes, AreRefusedForWhatMayNotRun) {
  expect_error(post(path_, {{"program", "O9"}}), 404, "not_found", "O9");
  expect_error(post(path_, {{"program", "O1"}, {"quantity", 0}}), 413, "limit_exceeded",
               "quantity is 0");
  push("T1", "BEGIN PGM 1 MM\nEND PGM 1 MM\n", "tnc155");
  expect_error(post(path_, {{"program", "T1"}}), 422, "unsupported", "tnc155");
  use_policy("runs = \"release\"");
  make_api(&ports_);
  expect_error(post(path_, {{"program", "O1"}}), 409, "conflict", "released revisions only");
}

TEST_F(JobRoutes, StartIsAStartOfTheNextJob) {
  const auto first = add({{"program", "O1"}, {"revision", 1}}), second = add();
  machines_.run.id = "r1";
  const auto started = post("/api/v1/machines/lathe-1/start-job", Json::object());
  ASSERT_EQ(started.status, 201) << started.body;
  ASSERT_EQ(machines_.started.size(), 1u);
  EXPECT_EQ(machines_.started[0].program, "O1");
  EXPECT_EQ(machines_.started[0].revision, 1u);
  EXPECT_EQ(machines_.started[0].job, first);
  EXPECT_EQ(machines_.started[0].author, "admin");
  EXPECT_NE(store_->audit.list({.limit = 1})->at(0).detail.find("job 1"), std::string::npos);
  EXPECT_EQ(post("/api/v1/machines/lathe-1/start-job", {{"job", second}}).status, 201);
  EXPECT_EQ(machines_.started[1].job, second);
  expect_error(post("/api/v1/machines/lathe-1/start-job", {{"job", 99}}), 404, "not_found", "99");
}

TEST_F(JobRoutes, SayWhatTheyCountAndWhatWasMeasured) {
  add();
  EXPECT_EQ(queue()["jobs"][0]["counts"], "made");
  add({{"program", "O1"}, {"quantity", 5}, {"counts", "good"}});
  const Json good = queue()["jobs"][1];
  EXPECT_EQ(good["counts"], "good");
  for (const char* verdict : {"good", "rework", "scrap", "unknown"}) EXPECT_EQ(good[verdict], 0);
  expect_error(post(path_, {{"program", "O1"}, {"counts", "bad"}}), 400, "syntax",
               "counts is 'bad': made or good");
}

TEST_F(JobRoutes, AHeldQueueIsShownAndStartsNothing) {
  add();
  const std::string hold = "/api/v1/machines/lathe-1/job-hold";
  expect_error(call("PUT", hold, {.body = R"({"reason":" "})", .headers = {}}), 400, "syntax",
               "reason");
  EXPECT_EQ(call("PUT", hold, {.body = R"({"reason":"bore is wide"})", .headers = {}}).status, 204);
  EXPECT_EQ(queue()["hold"]["reason"], "bore is wide");
  EXPECT_EQ(queue()["hold"]["who"], "admin");
  expect_error(post("/api/v1/machines/lathe-1/start-job", Json::object()), 409, "conflict",
               "bore is wide");
  EXPECT_TRUE(machines_.started.empty());
  EXPECT_EQ(call("DELETE", hold).status, 204);
  EXPECT_TRUE(queue()["hold"].is_null());
  expect_error(call("DELETE", hold), 404, "not_found", "not held");
}

TEST_F(JobRoutes, PublishEveryChangeOfTheQueue) {
  const auto events = events_.subscribe({"lathe-1"});
  const auto of_another = events_.subscribe({"mill-3"});
  const auto next = [&] {
    const std::string text = events->take(), head = "event: job\ndata: ";
    EXPECT_EQ(text.substr(0, head.size()), head);
    return text.size() < head.size() ? Json() : Json::parse(text.substr(head.size()));
  };
  const auto id = add({{"program", "O1"}, {"quantity", 5}});
  const Json added = next();
  EXPECT_EQ(added["machine"], "lathe-1");
  EXPECT_EQ(added["change"], "added");
  EXPECT_EQ(added["job"]["quantity"], 5);
  EXPECT_TRUE(added["hold"].is_null());
  const std::string job = fmt::format("{}/{}", path_, id);
  call("PUT", job, {.body = R"({"place":1})", .headers = {}});
  EXPECT_EQ(next()["change"], "moved");
  const std::string hold = "/api/v1/machines/lathe-1/job-hold";
  call("PUT", hold, {.body = R"({"reason":"bore is wide"})", .headers = {}});
  const Json held = next();
  EXPECT_EQ(held["change"], "held");
  EXPECT_EQ(held["hold"]["reason"], "bore is wide");
  EXPECT_TRUE(held["job"].is_null());
  call("DELETE", hold);
  EXPECT_EQ(next()["change"], "released");
  call("DELETE", job);
  const Json removed = next();
  EXPECT_EQ(removed["change"], "removed");
  EXPECT_EQ(removed["job"]["state"], "removed");
  EXPECT_EQ(of_another->take(), "");
}

TEST_F(JobRoutes, PublishNothingThatWasRefused) {
  const auto events = events_.subscribe({});
  expect_error(post(path_, {{"program", "O9"}}), 404, "not_found", "O9");
  call("DELETE", path_ + "/99");
  call("DELETE", "/api/v1/machines/lathe-1/job-hold");
  EXPECT_EQ(events->take(), "");
}

TEST_F(JobRoutes, NoJobIsNotFound) {
  expect_error(post("/api/v1/machines/lathe-1/start-job", Json::object()), 404, "not_found",
               "no job waits");
}

/// The API with a client's certificate in front of it.
class CertificateAccess : public ApiTest {
 protected:
  CertificateAccess() {
    const auto admin = accounts_->find({identity::PresentedSecret::From::Bearer, kSecret}, "");
    EXPECT_TRUE(accounts_->users().add(*admin, {.name = "anna", .role = identity::Role::Operator}));
  }
  api::Response with_certificate(const std::string& user, const std::string& method,
                                 const std::string& target,
                                 std::map<std::string, std::string> headers = {}) {
    api::Request request;
    request.method = method;
    request.target = api::parse_target(target).value();
    request.headers = std::move(headers);
    request.headers.emplace("content-length", "0");
    request.address = "192.0.2.7";
    request.certificate = {
        {.user = user, .serial = "0A1B", .expires = clock_.now() + std::chrono::hours(1)}};
    return api_->handle(std::move(request));
  }
};

TEST_F(CertificateAccess, IsTheUserOfItsNameWithHisRights) {
  const auto session = json(with_certificate("anna", "GET", "/api/v1/session"));
  EXPECT_EQ(session["user"], "anna");
  EXPECT_EQ(session["role"], "operator");
  EXPECT_EQ(session["credential"], "certificate 0A1B");
  EXPECT_EQ(with_certificate("anna", "GET", "/api/v1/users").status, 403);
  EXPECT_EQ(with_certificate("stranger", "GET", "/api/v1/session").status, 401);
}

TEST_F(CertificateAccess, IsNamedBySerialInTheAuditTrail) {
  with_certificate("anna", "GET", "/api/v1/users");
  accounts_->refusals().flush();
  const auto entries = store_->audit.list({});
  const auto refused =
      std::ranges::find(*entries, std::string("access.refused"), &storage::AuditEntry::action);
  ASSERT_NE(refused, entries->end());
  EXPECT_EQ(refused->who.name, "anna");
  EXPECT_EQ(refused->who.credential, "certificate 0A1B");
  EXPECT_EQ(refused->who.address, "192.0.2.7");
}

TEST_F(CertificateAccess, EndsWithRevocationExpiryAndTheUser) {
  accounts_->revoke_certificates({"0A1B"});
  EXPECT_EQ(with_certificate("anna", "GET", "/api/v1/session").status, 401);
  accounts_->revoke_certificates({"0A1C"});
  EXPECT_EQ(with_certificate("anna", "GET", "/api/v1/session").status, 200);
  identity::Caller caller;
  caller.user = "anna";
  caller.certificate = "0A1B";
  caller.expires = clock_.now() + std::chrono::hours(1);
  EXPECT_TRUE(accounts_->is_valid(caller));
  clock_.advance(std::chrono::hours(2));
  EXPECT_FALSE(accounts_->is_valid(caller)) << "an event stream ends too";
  const auto admin = accounts_->find({identity::PresentedSecret::From::Bearer, kSecret}, "");
  ASSERT_TRUE(accounts_->users().remove(*admin, "anna"));
  EXPECT_EQ(with_certificate("anna", "GET", "/api/v1/session").status, 401);
}

/// A browser shows the certificate for any site's page.
TEST_F(CertificateAccess, ChangesNothingForAnotherSitesPage) {
  const std::string path = "/api/v1/machines/lathe-1/job-hold";
  EXPECT_EQ(with_certificate("admin", "DELETE", path, {{"origin", "https://evil"}}).status, 403);
  EXPECT_EQ(with_certificate("admin", "DELETE", path,
                             {{"sec-fetch-site", "cross-site"}, {"x-dripline", "1"}})
                .status,
            403);
  EXPECT_EQ(with_certificate("admin", "DELETE", path).status, 404) << "a program's request";
  EXPECT_EQ(with_certificate("admin", "DELETE", path,
                             {{"sec-fetch-site", "same-origin"}, {"x-dripline", "1"}})
                .status,
            404);
}

TEST_F(CertificateAccess, ASecretThatIsSentIsJudgedInstead) {
  EXPECT_EQ(with_certificate("anna", "GET", "/api/v1/session",
                             {{"authorization", std::string("Bearer ") + std::string(64, 'x')}})
                .status,
            401);
  EXPECT_EQ(json(with_certificate("anna", "GET", "/api/v1/session",
                                  {{"authorization", std::string("Bearer ") + kSecret}}))["user"],
            "admin");
}

TEST_F(ApiTest, WebhooksAreChecked) {
  expect_error(post("/api/v1/webhooks", {{"name", "erp"}, {"url", "ftp://erp/"}}), 400, "syntax",
               "ftp://erp/");
  expect_error(post("/api/v1/webhooks",
                    {{"name", "erp"}, {"url", "http://erp/"}, {"kinds", {"everything"}}}),
               400, "syntax", "everything");
  expect_error(get("/api/v1/folders/other/files"), 404, "not_found", "other");
}

}  // namespace
}  // namespace dripline::server_test
