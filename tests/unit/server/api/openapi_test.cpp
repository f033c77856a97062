// The description of the API against the API: every route is described, everything described is a
// route, and the real answers follow the schemas.
#include <fmt/format.h>

#include <set>

#include "tests/support/child_process.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class OpenApi : public ApiTest {
 protected:
  OpenApi() : document_(json(get("/api/v1/openapi.json"))) {}

  /// The schema of an answer; null when it is described as something other than JSON.
  Json schema_of(const std::string& method, const std::string& pattern, int status) {
    std::string verb;
    for (const char c : method) verb += static_cast<char>(c - 'A' + 'a');
    const Json& responses = document_["paths"][pattern][verb]["responses"];
    const std::string own = std::to_string(status);
    const std::string key = status < 400 || responses.contains(own) ? own : "default";
    EXPECT_TRUE(responses.contains(key)) << method << " " << pattern << " " << status;
    const Json content = responses.value(key, Json::object()).value("content", Json::object());
    return content.value("application/json", Json::object()).value("schema", Json(nullptr));
  }
  void expect_described(const std::string& method, const std::string& pattern,
                        const api::Response& response) {
    covered_.insert(method + " " + pattern);
    const Json schema = schema_of(method, pattern, response.status);
    if (schema.is_null() || response.status == 204) return;
    const Json answer = json(response);
    EXPECT_EQ(test_support::schema_violation(document_, schema, answer), "")
        << method << " " << pattern << " " << answer.dump();
  }

  void expect_ports_described() {
    const auto put =
        call("PUT", "/api/v1/ports/line-1",
             {.body = R"({"machine":"mill-3","address":"/dev/ttyS0"})", .headers = {}});
    EXPECT_EQ(put.status, 201) << put.body;
    expect_described("PUT", "/api/v1/ports/{name}", put);
    ports_.traffic.push_back({"line-1", clock_.now(), ports::TrafficKind::Sent, "M30", ""});
    expect_described("GET", "/api/v1/ports", get("/api/v1/ports"));
    expect_described("GET", "/api/v1/ports/{name}", get("/api/v1/ports/line-1"));
    expect_described("POST", "/api/v1/ports/{name}/test",
                     call("POST", "/api/v1/ports/line-1/test"));
    expect_described("POST", "/api/v1/ports/{name}/transfers",
                     post("/api/v1/ports/line-1/transfers", {{"programs", {"O1", "O2@3"}}}));
    ports_.views[0].transfer =
        ports::PortTransfer{.id = "transfer-1", .programs = {"O1 revision 1"}};
    expect_described("GET", "/api/v1/ports/{name}", get("/api/v1/ports/line-1"));
    expect_described("DELETE", "/api/v1/ports/{name}/transfers",
                     call("DELETE", "/api/v1/ports/line-1/transfers"));
    expect_described("POST", "/api/v1/ports/{name}/receive",
                     call("POST", "/api/v1/ports/line-1/receive"));
    expect_described("POST", "/api/v1/ports/{name}/test-rules",
                     post("/api/v1/ports/line-1/test-rules", {{"text", "O1"}}));
    expect_described("GET", "/api/v1/ports/{name}/recording",
                     get("/api/v1/ports/line-1/recording"));
    expect_line_described("Traffic", body(get("/api/v1/ports/line-1/recording")));
    expect_described("GET", "/api/v1/ports/{name}/traffic", get("/api/v1/ports/line-1/traffic"));
    expect_described("GET", "/api/v1/port-templates", get("/api/v1/port-templates"));
    expect_described("DELETE", "/api/v1/ports/{name}", call("DELETE", "/api/v1/ports/line-1"));
  }
  /// What comes as lines or events is described by a schema without being an answer.
  void expect_line_described(const std::string& schema, const std::string& line) {
    EXPECT_EQ(test_support::schema_violation(document_, document_["components"]["schemas"][schema],
                                             Json::parse(line)),
              "");
  }
  void expect_backups_described() {
    set_up_backups();
    const auto backups = [this] { return get("/api/v1/backups"); };
    const auto wait = [&](auto holds) {
      EXPECT_TRUE(test_support::eventually([&] { return holds(json(backups())); }));
    };
    expect_described("POST", "/api/v1/backups", call("POST", "/api/v1/backups"));
    wait([](const Json& state) { return state["work"].is_null() && !state["last"].is_null(); });
    expect_described("GET", "/api/v1/backups", backups());
    const std::string id = json(backups())["backups"][0]["id"];
    expect_described("POST", "/api/v1/backups/{id}/verify",
                     call("POST", "/api/v1/backups/" + id + "/verify"));
    wait([](const Json& state) { return state["backups"][0]["verified"].is_string(); });
    expect_described("GET", "/api/v1/backups", backups());
    expect_described("DELETE", "/api/v1/backups/{id}", call("DELETE", "/api/v1/backups/" + id));
    expect_described("GET", "/api/v1/metrics", get("/api/v1/metrics"));
  }
  void expect_accounts_described() {
    const std::string user = "/api/v1/users/{name}";
    expect_described("POST", "/api/v1/users",
                     post("/api/v1/users", {{"name", "anna"},
                                            {"role", "operator"},
                                            {"groups", {"all"}},
                                            {"password", "correct horse"}}));
    const auto login =
        post("/api/v1/session",
             {{"user", "anna"}, {"password", "correct horse"}, {"bearer", true}, {"hours", 1}});
    EXPECT_EQ(login.status, 201) << login.body;
    expect_described("POST", "/api/v1/session", login);
    const std::string secret = json(login).value("secret", "");
    const Call of_anna{.body = {}, .headers = {}, .token = secret};
    expect_described("GET", "/api/v1/session", call("GET", "/api/v1/session", of_anna));
    expect_described("GET", "/api/v1/session", get("/api/v1/session"));
    expect_described("GET", "/api/v1/users", get("/api/v1/users"));
    expect_described("GET", user, get("/api/v1/users/anna"));
    expect_described(
        "PUT", user,
        call("PUT", "/api/v1/users/anna", {.body = R"({"locked":false})", .headers = {}}));
    expect_described("POST", user + "/tokens",
                     post("/api/v1/users/anna/tokens",
                          {{"name", "mes"}, {"role", "viewer"}, {"groups", {"all"}}, {"days", 7}}));
    expect_described("GET", user + "/tokens", get("/api/v1/users/anna/tokens"));
    EXPECT_EQ(json(get("/api/v1/users/anna/tokens"))["tokens"].size(), 2u);
    expect_described("DELETE", user + "/tokens/{token}",
                     call("DELETE", "/api/v1/users/anna/tokens/mes"));
    expect_described("DELETE", "/api/v1/session", call("DELETE", "/api/v1/session", of_anna));
    expect_described("PUT", user + "/password",
                     call("PUT", "/api/v1/users/anna/password",
                          {.body = R"({"password":"another horse"})", .headers = {}}));
    const std::string group = "/api/v1/machine-groups/{group}";
    for (const int status : {201, 200}) {
      const auto put = call("PUT", "/api/v1/machine-groups/lathes");
      EXPECT_EQ(put.status, status);
      expect_described("PUT", group, put);
    }
    expect_described("PUT", group + "/machines/{machine}",
                     call("PUT", "/api/v1/machine-groups/lathes/machines/lathe-1"));
    expect_described("GET", "/api/v1/machine-groups", get("/api/v1/machine-groups"));
    expect_described("DELETE", group + "/machines/{machine}",
                     call("DELETE", "/api/v1/machine-groups/lathes/machines/lathe-1"));
    expect_described("DELETE", group, call("DELETE", "/api/v1/machine-groups/lathes"));
    expect_described("DELETE", user, call("DELETE", "/api/v1/users/anna"));
  }
  void expect_setups_described() {
    const std::string path = "/api/v1/machines/lathe-1/setup";
    const Call text{.body = "[[tool]]\nnumber = 1\n", .headers = {}};
    for (const int status : {201, 200}) {
      const auto put = call("PUT", path + "?comment=first", text);
      EXPECT_EQ(put.status, status) << put.body;
      expect_described("PUT", "/api/v1/machines/{name}/setup", put);
    }
    expect_described("GET", "/api/v1/machines/{name}/setup", get(path));
    expect_described("GET", "/api/v1/machines/{name}/setups", get(path + "s"));
  }
  void expect_memory_described() {
    storage::Record record;
    record.machine = "lathe-1";
    record.epoch = 77;
    record.number = 1;
    record.time = clock_.now();
    record.run = "line-1";
    record.kind = "message";
    record.device = "memory";
    record.text = R"({"part":1,"parts":1,"cells":{"P10":[7.5,0],"#500":[null,null]}})";
    storage::RecordBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 77;
    batch.records = {record};
    ASSERT_TRUE(store_->records.store(batch));
    const std::string path = "/api/v1/machines/lathe-1/memory";
    const Json memories = json(get(path))["memories"];
    ASSERT_EQ(memories.size(), 1u);
    EXPECT_EQ(memories[0]["run"], "line-1");
    EXPECT_EQ(memories[0]["program"], nullptr);
    EXPECT_EQ(memories[0]["cells"].size(), 2u);
    expect_described("GET", "/api/v1/machines/{name}/memory", get(path));
    EXPECT_EQ(get(path + "?run=line-1").status, 200);
    EXPECT_EQ(get(path + "?run=r9").status, 404);
    EXPECT_EQ(get("/api/v1/machines/absent/memory").status, 404);
  }
  void expect_judgment_described() {
    for (const std::string number : {"1", "2"}) {
      const auto upload = programs_->begin(
          {.program = "O3", .control = "centurion", .comment = {}, .is_held = true}, "mill-3");
      ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of("N" + number + "\n")));
      ASSERT_TRUE(programs_->commit(upload->id, std::nullopt, "mill-3"));
    }
    expect_described("GET", "/api/v1/programs", get("/api/v1/programs"));
    expect_imports_described();
    expect_jobs_described();
    expect_folders_and_webhooks_described();
    const std::string path = "/api/v1/programs/{name}/revisions/{number}/";
    expect_described("POST", path + "accept",
                     call("POST", "/api/v1/programs/O3/revisions/1/accept"));
    expect_described("POST", path + "reject",
                     call("POST", "/api/v1/programs/O3/revisions/2/reject"));
    // Accepted, it is a draft like any other.
    const Call comment{.body = R"({"comment":"why"})", .headers = {}};
    for (const std::string step :
         {"submit", "approve", "reject", "submit", "approve", "release", "withdraw"}) {
      const auto decided = call("POST", "/api/v1/programs/O3/revisions/1/" + step, comment);
      EXPECT_EQ(decided.status, 200) << step << decided.body;
      expect_described("POST", path + step, decided);
    }
    expect_described("GET", path + "states", get("/api/v1/programs/O3/revisions/1/states"));
    expect_described("GET", "/api/v1/release-policy", get("/api/v1/release-policy"));
  }

  void expect_imports_described() {
    push("O4", "N1\n");
    for (const std::string number : {"2", "3", "4"}) {
      const auto upload = programs_->begin(
          {.program = "O4", .control = "centurion", .comment = {}, .is_held = true},
          "machine mill-3");
      ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of("N" + number + "\n")));
      ASSERT_TRUE(programs_->commit(upload->id, std::nullopt, "machine mill-3"));
    }
    ASSERT_TRUE(store_->imports.set_class(
        "O4", 2, {.base = 1, .edit = "comment", .fault = "x", .time = clock_.now()}));
    const std::string path = "/api/v1/imports/{name}/{number}";
    expect_described("GET", "/api/v1/imports", get("/api/v1/imports"));
    expect_described("GET", path, get("/api/v1/imports/O4/2"));
    expect_described("POST", path + "/accept", call("POST", "/api/v1/imports/O4/2/accept"));
    const auto moved = post("/api/v1/imports/O4/3/accept", {{"as", "O5"}, {"comment", "variant"}});
    EXPECT_EQ(moved.status, 200) << moved.body;
    expect_described("POST", path + "/accept", moved);
    const auto rejected = post("/api/v1/imports/O4/4/reject", {{"reason", "scrap"}});
    EXPECT_EQ(rejected.status, 204) << rejected.body;
    expect_described("POST", path + "/reject", rejected);
    expect_described("GET", "/api/v1/imports", get("/api/v1/imports?state=decided"));
    for (const std::string number : {"2", "3", "4"})
      expect_described("GET", path, get("/api/v1/imports/O4/" + number));
  }

  void expect_jobs_described() {
    const std::string machine = "/api/v1/machines/{name}", lathe = "/api/v1/machines/lathe-1";
    add_machine("lathe-1");
    const auto added = post(lathe + "/jobs", {{"program", "O4"}, {"comment", "steel"}});
    EXPECT_EQ(added.status, 201) << added.body;
    expect_described("POST", machine + "/jobs", added);
    const auto pinned = post(lathe + "/jobs", {{"program", "O4"}, {"revision", 1}});
    const std::string job = lathe + "/jobs/" + json(pinned)["id"].dump();
    expect_described("PUT", machine + "/jobs/{job}",
                     call("PUT", job, {.body = R"({"place":1})", .headers = {}}));
    expect_described("POST", machine + "/start-job", post(lathe + "/start-job", Json::object()));
    expect_described(
        "PUT", machine + "/job-hold",
        call("PUT", lathe + "/job-hold", {.body = R"({"reason":"wide"})", .headers = {}}));
    expect_described("GET", machine + "/jobs", get(lathe + "/jobs"));
    expect_described("DELETE", machine + "/job-hold", call("DELETE", lathe + "/job-hold"));
    expect_described("DELETE", machine + "/jobs/{job}", call("DELETE", job));
    expect_described("GET", machine + "/jobs", get(lathe + "/jobs?state=closed"));
  }
  void expect_folders_and_webhooks_described() {
    storage::FolderFile file;
    file.folder = "cam";
    file.name = "1\n.nc";
    file.state = storage::FolderFileState::Failed;
    file.reason = "its name";
    file.taken = clock_.now();
    ASSERT_TRUE(store_->folders.begin(file));
    expect_described("GET", "/api/v1/folders", get("/api/v1/folders"));
    const auto files = get("/api/v1/folders/cam/files");
    EXPECT_EQ(json(files)["files"][0]["name"], "1%0A.nc");
    expect_described("GET", "/api/v1/folders/{name}/files", files);
    const std::string hook = "/api/v1/webhooks/{name}";
    const auto added = post("/api/v1/webhooks", {{"name", "erp"}, {"url", "http://erp/"}});
    EXPECT_EQ(added.status, 201) << added.body;
    EXPECT_EQ(json(added)["secret"].get<std::string>().size(), 64u);
    expect_described("POST", "/api/v1/webhooks", added);
    const auto listed = get("/api/v1/webhooks");
    EXPECT_EQ(listed.body.find("secret"), std::string::npos) << "shown once";
    expect_described("GET", "/api/v1/webhooks", listed);
    expect_described("POST", hook + "/test", call("POST", "/api/v1/webhooks/erp/test"));
    EXPECT_EQ(sender_.sent.size(), 1u);
    expect_described("DELETE", hook, call("DELETE", "/api/v1/webhooks/erp"));
  }

  Json document_;
  std::set<std::string> covered_;
};

TEST_F(OpenApi, NamesThePermissionOfEveryRoute) {
  std::size_t operations = 0;
  for (const auto& [path, item] : document_["paths"].items()) {
    for (const auto& [verb, operation] : item.items()) {
      std::string method;
      for (const char c : verb) method += static_cast<char>(c - 'a' + 'A');
      const auto* const row = api::find_permission(method, path);
      ASSERT_NE(row, nullptr) << method << " " << path << " has no row in route_permissions";
      EXPECT_EQ(operation.value("x-permission", ""), identity::to_string(row->permission))
          << method << " " << path;
      const bool is_open = operation.contains("security") && operation["security"].empty();
      EXPECT_EQ(is_open, row->permission == identity::Permission::Open) << method << " " << path;
      ++operations;
    }
  }
  EXPECT_EQ(operations, api::route_permissions().size()) << "a row without a route";
}

TEST_F(OpenApi, DescribesEveryRouteAndNothingElse) {
  std::set<std::string> described;
  for (const auto& [path, item] : document_["paths"].items()) {
    for (const auto& [verb, operation] : item.items()) {
      std::string method;
      for (const char c : verb) method += static_cast<char>(c - 'a' + 'A');
      described.insert(fmt::format("{} {}", method, path));
      EXPECT_TRUE(operation.contains("summary")) << method << " " << path;
    }
  }
  std::set<std::string> routed;
  for (const auto& route : api_->router().routes())
    routed.insert(route.method + " " + route.pattern);
  EXPECT_EQ(described, routed);
}

TEST_F(OpenApi, FitsTheRealAnswers) {
  const std::string run = stored_run(3);
  dds::Status status;
  status.machine = "lathe-1";
  status.run = run;
  status.axes = 0b111;
  status.modes.emplace().tool_axis = 2;
  status.modes->spindle = dds::SpindleState::Clockwise;
  status.coordinates =
      dds::Coordinates{.following_error = std::array<double, 9>{},
                       .program = dds::ProgramFrame{.mirrored = 1, .pole_axes = 3}};
  machines_.views[0].status = status;

  expect_described("GET", "/api/v1/health", get("/api/v1/health"));
  health_.report("", {library::Health::Level::Failed, "store", "not written", "disk full"});
  expect_described("GET", "/api/v1/health", get("/api/v1/health"));
  expect_described("GET", "/api/v1/ready", get("/api/v1/ready"));
  expect_described("GET", "/api/v1/openapi.json", get("/api/v1/openapi.json"));
  expect_described("GET", "/api/v1/server", get("/api/v1/server"));
  expect_described("GET", "/api/v1/programs", get("/api/v1/programs"));
  expect_described("GET", "/api/v1/programs/{name}", get("/api/v1/programs/O0100"));
  expect_described("GET", "/api/v1/programs/{name}/content", get("/api/v1/programs/O0100/content"));
  expect_described("GET", "/api/v1/programs/{name}/path", get("/api/v1/programs/O0100/path"));
  push("O0100-new", "G20\nG0 X9. (A)\nG31 Z1. F1.\nX[P7]\nM30\n");
  expect_described("GET", "/api/v1/programs/{name}/comparison",
                   get("/api/v1/programs/O0100/comparison?other=O0100-new"));
  expect_described("GET", "/api/v1/programs/{name}/comparison",
                   get("/api/v1/programs/O0100/comparison?other=O0100-new&by=motion"));
  const auto upload = post("/api/v1/uploads", {{"program", "O2"}, {"control", "centurion"}});
  expect_described("POST", "/api/v1/uploads", upload);
  const std::string path = "/api/v1/uploads/" + json(upload).value("id", "");
  expect_described("GET", "/api/v1/uploads/{id}", get(path));
  expect_described("PUT", "/api/v1/uploads/{id}/content",
                   call("PUT", path + "/content?offset=0", {.body = "M30\n", .headers = {}}));
  const auto commit = call("POST", path + "/commit");
  EXPECT_EQ(commit.status, 201);
  expect_described("POST", "/api/v1/uploads/{id}/commit", commit);
  const auto given_up = post("/api/v1/uploads", {{"program", "O2"}, {"control", "centurion"}});
  expect_described("DELETE", "/api/v1/uploads/{id}",
                   call("DELETE", "/api/v1/uploads/" + json(given_up).value("id", "")));
  expect_described("GET", "/api/v1/machines", get("/api/v1/machines"));
  expect_described("GET", "/api/v1/machines/{name}", get("/api/v1/machines/lathe-1"));
  expect_described("POST", "/api/v1/machines/{name}/commands",
                   post("/api/v1/machines/lathe-1/commands",
                        {{"action", "switch"}, {"name", "emergency_stop"}, {"value", 1}}));
  expect_described("POST", "/api/v1/runs",
                   post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0100"}}));
  expect_described("GET", "/api/v1/runs", get("/api/v1/runs"));
  expect_described("GET", "/api/v1/runs/{id}", get("/api/v1/runs/" + run));
  expect_described("GET", "/api/v1/runs/{id}/attestation",
                   get("/api/v1/runs/" + run + "/attestation"));
  expect_described("POST", "/api/v1/runs/{id}/restart",
                   post("/api/v1/runs/" + run + "/restart", {{"at", "executed"}}));
  expect_described("POST", "/api/v1/runs/{id}/commands",
                   post("/api/v1/runs/" + run + "/commands", {{"action", "hold"}}));
  expect_described("GET", "/api/v1/runs/{id}/records", get("/api/v1/runs/" + run + "/records"));
  expect_described("GET", "/api/v1/machine-reports", get("/api/v1/machine-reports"));
  expect_described("GET", "/api/v1/machines/{name}/report",
                   get("/api/v1/machines/lathe-1/report?format=json"));
  expect_described("GET", "/api/v1/reports", get("/api/v1/reports"));
  expect_described("GET", "/api/v1/reports/{run}", get("/api/v1/reports/" + run + "?format=json"));
  expect_described("GET", "/api/v1/audit", get("/api/v1/audit"));
  expect_described("GET", "/api/v1/audit/verification", get("/api/v1/audit/verification"));
  expect_described("POST", "/api/v1/audit/verification",
                   call("POST", "/api/v1/audit/verification"));
  expect_described("GET", "/api/v1/audit/export", get("/api/v1/audit/export"));
  expect_described("GET", "/api/v1/events", get("/api/v1/events"));
  expect_setups_described();
  expect_memory_described();
  expect_ports_described();
  expect_judgment_described();
  expect_described("POST", "/api/v1/programs/{name}/copy",
                   post("/api/v1/programs/O2/copy", {{"to", "O20"}, {"revision", 1}}));
  expect_described("POST", "/api/v1/programs/{name}/rename",
                   post("/api/v1/programs/O20/rename", {{"to", "O21"}}));
  expect_described("DELETE", "/api/v1/programs/{name}", call("DELETE", "/api/v1/programs/O2"));
  expect_accounts_described();
  expect_backups_described();
  for (const auto& route : api_->router().routes()) {
    EXPECT_TRUE(covered_.contains(route.method + " " + route.pattern))
        << route.method << " " << route.pattern << " is not covered by this test";
  }
}

TEST_F(OpenApi, ListsTheWordsOfEveryEnumeration) {
  const auto expect_words = [this](const std::string& schema, const std::string& member,
                                   std::span<const std::string_view> words) {
    Json expected = Json::array();
    for (const std::string_view word : words) {
      if (word != "unknown") expected.push_back(word);  // shown as null
    }
    EXPECT_EQ(document_["components"]["schemas"][schema]["properties"][member]["enum"], expected)
        << schema << "." << member;
  };
  expect_words("Status", "execution", words_of(dds::Execution{}));
  expect_words("Status", "mode", words_of(dds::ControllerMode{}));
  expect_words("Status", "remote_enable", words_of(dds::RemoteEnable{}));
  expect_words("Status", "waits_for", words_of(dds::WaitsFor{}));
  expect_words("ActiveModes", "motion", words_of(dds::MotionKind{}));
  expect_words("ActiveModes", "compensation", words_of(dds::CompensationSide{}));
  expect_words("ActiveModes", "feed_unit", words_of(dds::FeedUnit{}));
  expect_words("ActiveModes", "spindle", words_of(dds::SpindleState{}));
  expect_words("Record", "kind", words_of(dds::RecordKind{}));
}

TEST_F(OpenApi, FitsTheErrorsOfEveryStatus) {
  expect_described("GET", "/api/v1/server",
                   call("GET", "/api/v1/server", {.body = {}, .headers = {}, .token = "wrong"}));
  expect_described("GET", "/api/v1/runs/{id}", get("/api/v1/runs/none"));
  expect_described("POST", "/api/v1/runs", call("POST", "/api/v1/runs"));
  expect_described("POST", "/api/v1/uploads",
                   post("/api/v1/uploads", {{"program", "O1"}, {"control", "fagor"}}));
}

TEST_F(OpenApi, IsRefusedWithAKeywordThatIsNotChecked) {
  EXPECT_NE(test_support::schema_violation(document_, Json{{"type", "string"}, {"oneOf", 1}}, "x"),
            "");
}

}  // namespace
}  // namespace dripline::server_test
