// The real answers follow the schemas of the description, and every route gives one here.
#include "clients/tools/studies/gauge_study_of.hpp"
#include "tests/unit/server/api/openapi_programs.hpp"

namespace dripline::server_test {
namespace {

class OpenApiAnswers : public ProgramAnswers {
 protected:
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
    expect_described("POST", "/api/v1/ports/{name}/confirm-reset",
                     call("POST", "/api/v1/ports/line-1/confirm-reset"));
    expect_described("POST", "/api/v1/ports/{name}/test-rules",
                     post("/api/v1/ports/line-1/test-rules", {{"text", "O1"}}));
    expect_described("GET", "/api/v1/ports/{name}/recording",
                     get("/api/v1/ports/line-1/recording"));
    expect_line_described("Traffic", body(get("/api/v1/ports/line-1/recording")));
    expect_described("GET", "/api/v1/ports/{name}/traffic", get("/api/v1/ports/line-1/traffic"));
    expect_described("GET", "/api/v1/port-templates", get("/api/v1/port-templates"));
    expect_described("DELETE", "/api/v1/ports/{name}", call("DELETE", "/api/v1/ports/line-1"));
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
    expect_described("GET", "/api/v1/certificates", get("/api/v1/certificates"));
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
    const std::string loaded = "/api/v1/machines/{name}/setup/loaded";
    const auto state = [&](const char* body) {
      return call("PUT", path + "/loaded", {.body = body, .headers = {}});
    };
    expect_described("PUT", loaded, state(R"({"revision":1})"));
    expect_described("GET", loaded, get(path + "/loaded"));
    expect_described("PUT", loaded, state("{}"));
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

  void expect_archives_described() {
    set_up_archives();
    clock_.advance(std::chrono::hours(48));
    const auto made = call("POST", "/api/v1/archives");
    EXPECT_EQ(made.status, 200) << made.body;
    expect_described("POST", "/api/v1/archives", made);
    EXPECT_FALSE(json(get("/api/v1/archives"))["archives"].empty());
    expect_described("GET", "/api/v1/archives", get("/api/v1/archives"));
    const Json archive = json(get("/api/v1/archives"))["archives"][0];
    const auto rows = get("/api/v1/archives/" + archive["id"].dump() + "/rows");
    EXPECT_FALSE(json(rows)["rows"].empty()) << rows.body;
    expect_described("GET", "/api/v1/archives/{id}/rows", rows);
  }
  void expect_offsets_described() {
    const std::string machine = "/api/v1/machines/{name}", lathe = "/api/v1/machines/lathe-1";
    const Call rules{.body =
                         "[[rule]]\nname = \"X\"\ncharacteristic = \"X\"\ntarget = "
                         "\"T3.wear.X\"\nmax_step = 0.1\n",
                     .headers = {}};
    EXPECT_EQ(
        call("PUT", lathe + "/setup", {.body = "[[tool]]\nnumber = 3\n", .headers = {}}).status,
        201);
    const auto saved = call("PUT", lathe + "/offset-rules", rules);
    EXPECT_EQ(saved.status, 200) << saved.body;
    expect_described("PUT", machine + "/offset-rules", saved);
    expect_described("GET", machine + "/offset-rules", get(lathe + "/offset-rules"));
    const auto looked = call("POST", lathe + "/offsets/evaluation");
    EXPECT_EQ(looked.status, 200) << looked.body;
    expect_described("POST", machine + "/offsets/evaluation", looked);
    storage::OffsetProposal proposal;
    proposal.machine = "lathe-1";
    proposal.rule = "X";
    proposal.target = "T3.wear.X";
    proposal.unit = "mm";
    proposal.reasons = R"(["mean deviation +0.02"])";
    for (const std::string step : {"reject", "approve"}) {
      proposal.new_value -= 0.01;
      proposal.base = store_->setups.find("lathe-1", std::nullopt)->number;
      const auto kept = store_->offsets.propose(proposal);
      ASSERT_TRUE(kept) << kept.error().what;
      const std::string id = fmt::to_string(kept->proposal.id);
      expect_described("GET", "/api/v1/offsets/{id}", get("/api/v1/offsets/" + id));
      const auto decided = post(lathe + "/offsets/" + id + "/" + step, {{"comment", "a chip"}});
      EXPECT_EQ(decided.status, 200) << decided.body;
      expect_described("POST", machine + "/offsets/{id}/" + step, decided);
      expect_described("GET", "/api/v1/offsets/{id}", get("/api/v1/offsets/" + id));
    }
    expect_described("GET", "/api/v1/offsets", get("/api/v1/offsets"));
    const auto history = get(lathe + "/offset-history");
    EXPECT_FALSE(json(history)["history"].empty()) << history.body;
    expect_described("GET", machine + "/offset-history", history);
    expect_described("GET", "/api/v1/runs/{id}/offsets", get("/api/v1/runs/run-1/offsets"));
  }
  static std::string gauge_study() {
    std::vector<measurement::Measurement> all;
    for (const std::string machine : {"gauge-1", "gauge-2"}) {
      for (const std::string part : {"a", "b", "a", "b"}) {
        measurement::Measurement one;
        one.machine = machine;
        one.serial = part;
        one.actual = static_cast<double>(all.size() * all.size());
        all.push_back(one);
      }
    }
    const auto study = studies::study_gauge(all, studies::GaugeMethod::Ranges, 2.0);
    EXPECT_TRUE(study) << study.error().what;
    return studies::to_json(*study).dump();
  }
  void expect_measurements_described() {
    const std::string one = "/api/v1/report-templates/{name}",
                      all = "/api/v1/report-template-assignments",
                      assignment = all + "/{scope}/{subject}/{template}";
    const Call text{.body = "[[line]]\nform = 'X{actual}, {q}'\ncharacteristic = 'X'\n",
                    .headers = {}};
    expect_described("PUT", one, call("PUT", "/api/v1/report-templates/bore", text));
    expect_described("PUT", assignment, call("PUT", all + "/machine/lathe-1/bore"));
    expect_described("GET", "/api/v1/report-templates", get("/api/v1/report-templates"));
    expect_described("GET", one, get("/api/v1/report-templates/bore"));
    expect_described("GET", all, get(all));
    ASSERT_TRUE(store_->runs.set_state("run-1", storage::RunState::Aborted, "test"));
    const std::string run = "/api/v1/runs/{id}/measurements";
    const auto derived = call("POST", "/api/v1/runs/run-1/measurements");
    EXPECT_EQ(derived.status, 200) << derived.body;
    expect_described("POST", run, derived);
    EXPECT_FALSE(json(get("/api/v1/measurements"))["measurements"].empty());
    expect_described("GET", "/api/v1/measurements", get("/api/v1/measurements"));
    expect_described("GET", "/api/v1/characteristics", get("/api/v1/characteristics"));
    expect_described("GET", "/api/v1/parts", get("/api/v1/parts"));
    const std::string chart = get("/api/v1/measurements/chart?characteristic=X").body;
    EXPECT_NE(chart.find("<svg"), std::string::npos) << chart;
    expect_described("GET", "/api/v1/measurements/chart",
                     get("/api/v1/measurements/chart?characteristic=X"));
    const auto capability =
        get("/api/v1/measurements/capability?characteristic=X&lower=0&upper=10");
    EXPECT_EQ(capability.status, 200) << capability.body;
    expect_described("GET", "/api/v1/measurements/capability", capability);
    expect_described("GET", "/api/v1/measurements/gauge",  // of one machine it is refused
                     get("/api/v1/measurements/gauge?characteristic=X"));
    expect_line_described("GaugeStudy", gauge_study());
    const auto trial = call("POST", "/api/v1/runs/run-1/template-trial", text);
    EXPECT_FALSE(json(trial)["shown"][0]["events"].empty()) << trial.body;
    expect_described("POST", "/api/v1/runs/{id}/template-trial", trial);
    expect_described("GET", "/api/v1/parts/{id}", get("/api/v1/parts/1"));
    expect_described("GET", "/api/v1/report-findings", get("/api/v1/report-findings"));
    expect_described("GET", "/api/v1/runs/{id}", get("/api/v1/runs/run-1"));
    expect_described("DELETE", assignment, call("DELETE", all + "/machine/lathe-1/bore"));
    expect_described("DELETE", one, call("DELETE", "/api/v1/report-templates/bore"));
  }
};

TEST_F(OpenApiAnswers, FitsTheRealAnswers) {
  const std::string run = stored_run(6);
  dds::Status status;
  status.machine = "lathe-1";
  status.run = run;
  status.axes = 0b111;
  status.modes.emplace().tool_axis = 2;
  status.modes->spindle = dds::SpindleState::Clockwise;
  status.screen = dds::Screen{.position = dds::PositionDisplay::Actual, .block = "M30"};
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
  share_library({"dncd 7 on srv-2"});
  expect_described("GET", "/api/v1/server", get("/api/v1/server"));
  expect_described("POST", "/api/v1/server/drain", post("/api/v1/server/drain", Json::object()));
  expect_described("GET", "/api/v1/programs", get("/api/v1/programs"));
  expect_described("GET", "/api/v1/programs/{name}", get("/api/v1/programs/O0100"));
  expect_described("GET", "/api/v1/programs/{name}/content", get("/api/v1/programs/O0100/content"));
  expect_described("GET", "/api/v1/programs/{name}/path", get("/api/v1/programs/O0100/path"));
  push("O0100-new", "G20\nG0 X9. (A)\nG31 Z1. F1.\nX[P7]\nM30\n");
  expect_described("GET", "/api/v1/programs/{name}/comparison",
                   get("/api/v1/programs/O0100/comparison?other=O0100-new"));
  expect_described("GET", "/api/v1/programs/{name}/comparison",
                   get("/api/v1/programs/O0100/comparison?other=O0100-new&by=motion"));
  expect_described("GET", "/api/v1/programs/{name}/check", get("/api/v1/programs/O0100/check"));
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
  expect_described("GET", "/api/v1/machines/{name}/values",
                   get("/api/v1/machines/lathe-1/values?beginning=P"));
  expect_described("POST", "/api/v1/machines/{name}/commands",
                   post("/api/v1/machines/lathe-1/commands",
                        {{"action", "switch"}, {"name", "emergency_stop"}, {"value", 1}}));
  machines_.views.front().machine.gateway_version = "1";
  expect_described(
      "POST", "/api/v1/machines/{name}/datum",
      post("/api/v1/machines/lathe-1/datum", {{"axis", "Z"}, {"value", 0}, {"offset", "G54"}}));
  expect_described(
      "POST", "/api/v1/machines/{name}/touch-off",
      post("/api/v1/machines/lathe-1/touch-off",
           {{"tool", 3}, {"axis", "X"}, {"value", 40.02}, {"unit", "mm"}, {"offset", "G54"}}));
  expect_described("POST", "/api/v1/machines/{name}/jog",
                   post("/api/v1/machines/lathe-1/jog",
                        {{"axis", "X"}, {"distance", -1.5}, {"unit", "mm"}, {"feed", 300}}));
  expect_described("POST", "/api/v1/machines/{name}/jog/hold",
                   post("/api/v1/machines/lathe-1/jog/hold", {{"hold", "a1"}}));
  expect_described("POST", "/api/v1/machines/{name}/confirm-gateway",
                   call("POST", "/api/v1/machines/lathe-1/confirm-gateway"));
  expect_described("DELETE", "/api/v1/machines/{name}", call("DELETE", "/api/v1/machines/mill-9"));
  expect_described("GET", "/api/v1/machines/{name}/playback",
                   get("/api/v1/machines/lathe-1/playback?axes=XZ"));
  expect_described("POST", "/api/v1/machines/{name}/mdi",
                   post("/api/v1/machines/lathe-1/mdi", {{"text", "G0 X1"}}));
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
  expect_library_described();
  expect_jobs_described();
  expect_folders_and_webhooks_described();
  expect_described("POST", "/api/v1/programs/{name}/copy",
                   post("/api/v1/programs/O2/copy", {{"to", "O20"}, {"revision", 1}}));
  expect_described("POST", "/api/v1/programs/{name}/rename",
                   post("/api/v1/programs/O20/rename", {{"to", "O21"}}));
  expect_described("DELETE", "/api/v1/programs/{name}", call("DELETE", "/api/v1/programs/O2"));
  expect_accounts_described();
  expect_backups_described();
  expect_measurements_described();
  expect_offsets_described();
  expect_archives_described();
  for (const auto& route : api_->router().routes()) {
    EXPECT_TRUE(covered_.contains(route.method + " " + route.pattern))
        << route.method << " " << route.pattern << " is not covered by this test";
  }
}

}  // namespace
}  // namespace dripline::server_test
