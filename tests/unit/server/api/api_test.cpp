// What the handlers answer, without sockets.
#include "tests/unit/server/api/api_fixture.hpp"

#include "server/api/views.hpp"
#include "server/machines/start_point.hpp"

namespace dripline::server_test {
namespace {

TEST_F(ApiHandlers, AskForTheToken) {
  expect_error(call("GET", "/api/v1/server", {.body = {}, .headers = {}, .token = "wrong"}), 401,
               "denied", "token");
  expect_error(call("GET", "/api/v1/nothing", {.body = {}, .headers = {}, .token = ""}), 401,
               "denied", "token");
  EXPECT_EQ(get("/api/v1/server").status, 200);
}

TEST_F(ApiHandlers, TellTheirHealthToEverybody) {
  EXPECT_EQ(call("GET", "/api/v1/health", {.body = {}, .headers = {}, .token = ""}).status, 200);
  EXPECT_EQ(call("GET", "/api/v1/openapi.json", {.body = {}, .headers = {}, .token = ""}).status,
            200);
}

TEST_F(ApiHandlers, SayWhatIsWrongWithAPathOrAMethod) {
  expect_error(get("/api/v1/nothing"), 404, "not_found", "/api/v1/nothing");
  const auto response = call("PATCH", "/api/v1/programs/O1");
  expect_error(response, 405, "unsupported", "PATCH");
  EXPECT_EQ(header(response, "Allow"), "GET, DELETE");
}

TEST_F(ApiHandlers, StartARunAndAuditIt) {
  const std::string run = stored_run(0);
  const auto response = post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0100"}});
  ASSERT_EQ(response.status, 201) << response.body;
  EXPECT_EQ(json(response)["id"], run);
  EXPECT_EQ(machines_.started.at(0).author, "admin");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["subject"], run);
}

TEST_F(ApiHandlers, SayOfATestRunThatItIsOne) {
  stored_run(0);
  machines_.notice = "test run: nothing moves";
  const auto detail = [&](bool asks) {
    Json body = {{"machine", "lathe-1"}, {"program", "O0100"}};
    if (asks) body["test"] = true;
    const auto response = post("/api/v1/runs", body);
    EXPECT_EQ(response.status, 201) << response.body;
    EXPECT_EQ(json(response)["notice"], "test run: nothing moves");
    return json(get("/api/v1/audit"))["entries"][0].value("detail", "");
  };
  EXPECT_EQ(detail(true), "test run of O0100 revision 1 on lathe-1");
  dds::Status status;
  status.switches.emplace();
  status.switches->test_run = dds::SwitchState::On;
  machines_.views.at(0).status = status;
  EXPECT_EQ(detail(false), "test run of O0100 revision 1 on lathe-1") << "by its switch";
}

TEST_F(ApiHandlers, SayWhyARunWasNotStarted) {
  stored_run(0);
  expect_error(post("/api/v1/runs", {{"machine", "lathe-9"}, {"program", "O0100"}}), 404,
               "not_found", "lathe-9");
  machines_.refusal = Error{Errc::Timeout, "machine 'lathe-1' is not connected"};
  expect_error(post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0100"}}), 504, "timeout",
               "not connected");
}

TEST_F(ApiHandlers, PassOrdersOn) {
  const std::string run = stored_run(0);
  const auto response =
      post("/api/v1/runs/" + run + "/commands", {{"action", "feed_override"}, {"value", 0.5}});
  EXPECT_EQ(response.status, 200) << response.body;
  EXPECT_EQ(json(response)["accepted"], true);
  EXPECT_EQ(machines_.commands.at(0).run, run);
  EXPECT_EQ(machines_.commands.at(0).action, dds::CommandAction::FeedOverride);
  EXPECT_EQ(machines_.commands.at(0).value, 0.5);
}

/// By it the machines know what was given before a stop, however long its entry in the trail took.
TEST_F(ApiHandlers, PassOnWhenAnOrderWasGiven) {
  const std::string run = stored_run(0);
  const auto begun = clock_.steady_now();
  clock_.advance(std::chrono::seconds(5));
  EXPECT_EQ(post("/api/v1/runs/" + run + "/commands", {{"action", "resume"}}).status, 200);
  EXPECT_EQ(machines_.commands.back().given, begun + std::chrono::seconds(5));
  (void)post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0100"}});
  EXPECT_EQ(machines_.started.back().given, begun + std::chrono::seconds(5));
  (void)post("/api/v1/machines/lathe-1/jog", {{"axis", "C"}, {"distance", 0.5}});
  ASSERT_TRUE(store_->runs.set_state(run, storage::RunState::Completed, ""));
  (void)post("/api/v1/machines/lathe-1/datum", {{"axis", "Z"}, {"value", 0}, {"offset", "G54"}});
  ASSERT_FALSE(machines_.positions.empty() || machines_.jogs.empty());
  EXPECT_EQ(machines_.jogs.back().given, begun + std::chrono::seconds(5));
  EXPECT_EQ(machines_.positions.back().given, begun + std::chrono::seconds(5));
}

/// By the header of a client that found no server at once, or looked its run up before.
TEST_F(ApiHandlers, TakeOrdersForAsOldAsTheirClientSays) {
  const std::string path = "/api/v1/runs/" + stored_run(0) + "/commands";
  const auto begun = clock_.steady_now();
  clock_.advance(std::chrono::seconds(5));
  const auto order = [&](const std::string& age) {
    const Call posted{.body = R"({"action":"resume"})", .headers = {{"dripline-age", age}}};
    EXPECT_EQ(call("POST", path, posted).status, 200) << age;
    return machines_.commands.back().given;
  };
  EXPECT_EQ(order("3000"), begun + std::chrono::seconds(2));
  for (const char* nothing : {"", "-3000", "soon", "99999999999999999999"})
    EXPECT_EQ(order(nothing), begun + std::chrono::seconds(5)) << nothing;
}

/// HD-195: the emergency stop is pressed and released where no run is.
TEST_F(ApiHandlers, PassOrdersToAMachinesPanelOn) {
  show_machine("lathe-1");
  const auto response = post("/api/v1/machines/lathe-1/commands",
                             {{"action", "switch"}, {"name", "emergency_stop"}, {"value", 1}});
  EXPECT_EQ(response.status, 200) << response.body;
  EXPECT_EQ(machines_.commands.at(0).run, "");
  EXPECT_EQ(machines_.commands.at(0).machine, "lathe-1");
  EXPECT_EQ(machines_.commands.at(0).argument, "emergency_stop");
  const Json entry = json(get("/api/v1/audit"))["entries"][0];
  EXPECT_EQ(entry["subject"], "lathe-1");
  EXPECT_EQ(entry["action"], "machine.switch");
  expect_error(post("/api/v1/machines/lathe-1/commands", {{"action", "resume"}}), 422,
               "unsupported", "resume");
  EXPECT_EQ(machines_.commands.size(), 1u);
}

TEST_F(ApiHandlers, KeepWhatIsKeyedInAndStartIt) {
  const std::string path = "/api/v1/machines/lathe-1/mdi";
  const auto key_in = [&](const std::string& text) { return post(path, {{"text", text}}); };
  const std::string before = stored_run(0);  // on lathe-1, a Centurion
  ASSERT_TRUE(store_->runs.set_state(before, storage::RunState::Completed, ""));
  machines_.views.front().machine.gateway_version = "1";
  const auto keyed_in = key_in("G0 X1");
  EXPECT_EQ(keyed_in.status, 201);
  EXPECT_TRUE(json(keyed_in)["notice"].is_null());
  ASSERT_EQ(machines_.started.size(), 1U);
  const machines::StartRequest start = machines_.started.front();
  EXPECT_TRUE(start.is_mdi);
  EXPECT_EQ(start.program, "MDI lathe-1");
  EXPECT_EQ(machines::start_argument(start), dds::kMdiStart);
  const auto kept = store_->programs.revision("MDI lathe-1", 1).value();
  EXPECT_EQ(kept.content, sha256("G0 X1\n"));
  EXPECT_EQ(kept.control, "centurion");
  const auto entry = json(get("/api/v1/audit"))["entries"][0];
  EXPECT_EQ(entry["action"], "run.mdi");
  EXPECT_EQ(entry["detail"], "lathe-1: G0 X1\\n");
  EXPECT_EQ(key_in("G0 X1\nG0 X2").status, 413) << "its MDI takes one block";
  EXPECT_EQ(key_in("").status, 400);
  EXPECT_EQ(key_in("G0 X\u00e4").status, 400);
  ASSERT_TRUE(store_->runs.create(run_of(kept, "run-9")));
  expect_error(key_in("G0 X9"), 409, "busy", "run-9");
  EXPECT_EQ(store_->programs.revisions("MDI lathe-1").value().size(), 1U) << "nothing was kept";
  machines_.views.front().machine.control = "prototrak-plus";
  EXPECT_EQ(key_in("G0 X1").status, 422) << "it has no MDI";
  machines_.views.front().machine.control = "centurion";
  machines_.views.front().machine.gateway_version.clear();
  EXPECT_EQ(key_in("G0 X1").status, 422) << "at the end of a line";
  EXPECT_EQ(machines_.started.size(), 1U);
}

TEST_F(ApiHandlers, GiveWhatTheOperatorHasToKnowOfHowMdiHasBegun) {
  ASSERT_TRUE(store_->runs.set_state(stored_run(0), storage::RunState::Completed, ""));
  machines_.views.front().machine.gateway_version = "1";
  machines_.notice = "MDI begins without a tool";
  const auto answer = json(post("/api/v1/machines/lathe-1/mdi", {{"text", "G0 X1"}}));
  EXPECT_EQ(answer["notice"], "MDI begins without a tool");
  EXPECT_TRUE(answer["id"].is_string()) << "beside the run";
}

TEST_F(ApiHandlers, ShowRunsAndTheirRecords) {
  const std::string run = stored_run(3);
  EXPECT_EQ(json(get("/api/v1/runs/" + run))["outputs"], 3);
  EXPECT_EQ(json(get("/api/v1/runs?state=ordered&machine=lathe-1"))["runs"].size(), 1u);
  EXPECT_EQ(json(get("/api/v1/runs?state=completed"))["runs"].size(), 0u);
  expect_error(get("/api/v1/runs?state=lost"), 400, "syntax", "lost");
  const Json records = json(get("/api/v1/runs/" + run + "/records?kind=output&limit=2"))["records"];
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[1]["number"], 2);
  expect_error(get("/api/v1/runs/none/records"), 404, "not_found", "none");
}

TEST_F(ApiHandlers, TellHowTheServerIs) {
  using Level = library::Health::Level;
  const auto health = [this] {
    return call("GET", "/api/v1/health", {.body = {}, .headers = {}, .token = ""});
  };
  EXPECT_EQ(json(health())["status"], "ok");
  health_.report("", {Level::Degraded, "disk", "the disk is nearly full", "40 MiB of /secret"});
  EXPECT_EQ(health().status, 200);
  EXPECT_EQ(json(health())["status"], "degraded");
  health_.report("", {Level::Failed, "store", "the store cannot be written", "disk full"});
  const auto failed = health();
  EXPECT_EQ(failed.status, 503);
  EXPECT_EQ(json(failed)["status"], "failed");
  EXPECT_EQ(json(failed)["reasons"][1]["subject"], "store");
  EXPECT_EQ(failed.body.find("secret"), std::string::npos) << "fit for anybody";
  EXPECT_EQ(json(get("/api/v1/server"))["health"]["reasons"][0]["detail"], "40 MiB of /secret");
}

TEST_F(ApiHandlers, HandTheLibraryOverToAServerThatWaits) {
  const auto drain = [this] { return post("/api/v1/server/drain", Json::object()); };
  EXPECT_TRUE(json(get("/api/v1/server"))["sharing"].is_null());
  expect_error(drain(), 422, "unsupported", "SQLite");
  share_library({});
  expect_error(drain(), 409, "conflict", "no server waits");
  EXPECT_EQ(handed_over_, 0);
  share_library({"dncd 7 on srv-2"});
  EXPECT_EQ(json(get("/api/v1/server"))["sharing"],
            (Json{{"term", 41}, {"standbys", {"dncd 7 on srv-2"}}}));
  const auto done = drain();
  EXPECT_EQ(done.status, 202) << done.body;
  EXPECT_EQ(json(done)["standbys"], Json::array({"dncd 7 on srv-2"}));
  EXPECT_EQ(handed_over_, 1);
  EXPECT_EQ(audit_->entries({})->front().action, "server.drain");
}

TEST_F(ApiHandlers, AreReadyWhileWorkWouldBeStored) {
  using Level = library::Health::Level;
  const auto ready = [this] {
    return call("GET", "/api/v1/ready", {.body = {}, .headers = {}, .token = ""});
  };
  EXPECT_EQ(ready().status, 200);
  health_.report("", {Level::Degraded, "disk", "the disk is nearly full", ""});
  EXPECT_EQ(ready().status, 200) << "it needs attention, but works";
  EXPECT_EQ(json(ready())["ready"], true);
  health_.report("", {Level::Degraded, "store", "the store is occupied", ""});
  EXPECT_EQ(ready().status, 503);
  EXPECT_EQ(json(ready())["ready"], false);
  health_.report("", {Level::Ok, "store", "", ""});
  EXPECT_EQ(ready().status, 200);
  health_.report("", {Level::Failed, "damage", "the database is damaged", ""});
  EXPECT_EQ(ready().status, 503);
}

TEST_F(ApiHandlers, DefuseFormulasInCsvButNotNumbers) {
  const std::string run = stored_run(0);
  storage::RecordBatch batch;
  batch.machine = "lathe-1";
  batch.epoch = 7;
  for (const char* text : {"=1+1", "+cmd", "-2.5", "@sum", "-X1", "X1"}) {
    storage::Record record;
    record.machine = "lathe-1";
    record.epoch = 7;
    record.number = batch.records.size() + 1;
    record.time = clock_.now();
    record.run = run;
    record.kind = "output";
    record.text = text;
    batch.records.push_back(record);
  }
  ASSERT_TRUE(store_->records.store(batch));
  const std::string csv = body(get("/api/v1/reports/" + run + "?format=csv"));
  for (const char* end :
       {",'=1+1\r\n", ",'+cmd\r\n", ",-2.5\r\n", ",'@sum\r\n", ",'-X1\r\n", ",X1\r\n"}) {
    EXPECT_NE(csv.find(end), std::string::npos) << end << " in " << csv;
  }
}

TEST_F(ApiHandlers, WriteReportsAsTextCsvAndJson) {
  const std::string run = stored_run(2);
  const std::string path = "/api/v1/reports/" + run + "?format=";
  EXPECT_EQ(body(get(path + "text")), "X1, \"Z\"\nX2, \"Z\"\n");
  const std::string csv = body(get(path + "csv"));
  EXPECT_EQ(csv.substr(0, csv.find('\r')), "number,time,device,block,line,sequence,text");
  EXPECT_NE(csv.find(",port1,2,2,,\"X2, \"\"Z\"\"\"\r\n"), std::string::npos) << csv;
  const Json report = json(get(path + "json"));
  EXPECT_EQ(report["lines"][1]["text"], "X2, \"Z\"");
  expect_error(get(path + "pdf"), 422, "unsupported", "text, csv, json");
  EXPECT_EQ(json(get("/api/v1/reports"))["reports"][0]["lines"], 2);
}

TEST_F(ApiHandlers, WriteWhatAMachinePrintedOutsideRuns) {
  stored_run(2);
  EXPECT_EQ(json(get("/api/v1/machine-reports"))["reports"].size(), 0u);
  storage::RecordBatch batch{
      .machine = "lathe-1", .epoch = 8, .records = {}, .beginnings = {}, .endings = {}};
  storage::Record record;
  record.machine = "lathe-1";
  record.epoch = 8;
  record.number = 1;
  record.time = clock_.now();
  record.kind = "output";
  record.device = "line-1";
  record.text = "B 2";
  batch.records.push_back(record);
  ASSERT_TRUE(store_->records.store(batch));
  const Json listed = json(get("/api/v1/machine-reports"))["reports"];
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0]["machine"], "lathe-1");
  EXPECT_EQ(listed[0]["lines"], 1);
  EXPECT_EQ(body(get("/api/v1/machines/lathe-1/report")), "B 2\n");
  const Json report = json(get("/api/v1/machines/lathe-1/report?format=json"));
  EXPECT_TRUE(report["run"].is_null());
  EXPECT_EQ(report["lines"][0]["device"], "line-1");
  expect_error(get("/api/v1/machines/none/report"), 404, "not_found", "none");
}

TEST_F(ApiHandlers, WriteAReportOfManyPages) {
  const std::string text = body(get("/api/v1/reports/" + stored_run(2500) + "?format=json"));
  const Json report = Json::parse(text, nullptr, false);
  ASSERT_EQ(report["lines"].size(), 2500u);
  EXPECT_EQ(report["lines"][2499]["number"], 2500);
}

TEST_F(ApiHandlers, OpenAnEventStreamWithTheMachinesAsTheyAre) {
  show_machine("lathe-1");
  show_machine("lathe-2");
  const auto response = get("/api/v1/events?machine=lathe-2");
  ASSERT_TRUE(response.events);
  const std::string first = response.events->take();
  EXPECT_EQ(first.find("lathe-1"), std::string::npos);
  EXPECT_NE(first.find("event: machine\ndata: {"), std::string::npos) << first;
  const auto listener = api::publish_to(events_);
  listener.on_machine(machines_.views[1]);
  EXPECT_NE(response.events->take().find("lathe-2"), std::string::npos);
}

TEST_F(ApiHandlers, ShowTheStatusOfAMachine) {
  show_machine("lathe-1");
  EXPECT_TRUE(json(get("/api/v1/machines/lathe-1"))["status"].is_null());
  dds::Status status;
  status.machine = "lathe-1";
  status.execution = dds::Execution::FeedHold;
  status.position = {1.5, 0, -3, 0, 0, 90};
  status.axes = 0b100101;  // X, Z and C
  machines_.views[0].status = status;
  const Json shown = json(get("/api/v1/machines/lathe-1"))["status"];
  EXPECT_EQ(shown["position"], (Json{{"X", 1.5}, {"Z", -3.0}, {"C", 90.0}}));
  EXPECT_TRUE(shown["run"].is_null());
  EXPECT_TRUE(shown["sequence"].is_null());
  EXPECT_TRUE(shown["coordinates"].is_null()) << "an older gateway";
  EXPECT_EQ(shown["emergency_stop"], false);
  EXPECT_TRUE(shown["remote_enable"].is_null());
  EXPECT_TRUE(shown["screen"].is_null()) << "an older gateway";
}

/// HD-082, HD-084.
TEST_F(ApiHandlers, ShowThePositionDisplaysAndTheStatusWindow) {
  show_machine("lathe-1");
  dds::Status status;
  status.machine = "lathe-1";
  status.position = {1, 2, 3};
  status.axes = 0b111;
  status.emergency_stop = true;
  status.remote_enable = dds::RemoteEnable::NotGiven;
  status.waits_for = dds::WaitsFor::CycleStart;
  status.modes.emplace().tool_axis = 2;
  status.modes->spindle = dds::SpindleState::Clockwise;
  status.coordinates = dds::Coordinates{.target = {5, 2, -3},
                                        .following_error = std::array<double, 9>{},
                                        .program = dds::ProgramFrame{}};
  dds::ProgramFrame& frame = *status.coordinates->program;
  frame.position = {11, 12, 13};
  frame.shift = {-10, -10, -10};
  frame.rotation = 30;
  frame.scale = {0.5, 0.5, 1};
  frame.mirrored = 0b10;
  frame.pole_axes = 0b101;
  frame.pole = {7, 0, 9};
  machines_.views[0].status = status;
  const Json shown = json(get("/api/v1/machines/lathe-1"))["status"];
  EXPECT_EQ(shown["emergency_stop"], true);
  EXPECT_EQ(shown["remote_enable"], "not_given");
  EXPECT_EQ(shown["waits_for"], "cycle_start");
  EXPECT_EQ(shown["modes"]["tool_axis"], "Z");
  EXPECT_EQ(shown["modes"]["spindle"], "clockwise");
  const Json& coordinates = shown["coordinates"];
  EXPECT_EQ(coordinates["distance_to_go"], (Json{{"X", 4.0}, {"Y", 0.0}, {"Z", -6.0}}));
  EXPECT_EQ(coordinates["following_error"], (Json{{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}}));
  EXPECT_EQ(coordinates["program"]["position"], (Json{{"X", 11.0}, {"Y", 12.0}, {"Z", 13.0}}));
  EXPECT_EQ(coordinates["program"]["shift"]["X"], -10);
  EXPECT_EQ(coordinates["program"]["scale"]["Y"], 0.5);
  EXPECT_EQ(coordinates["program"]["mirrored"], Json{"Y"});
  EXPECT_EQ(coordinates["program"]["pole"], (Json{{"X", 7.0}, {"Z", 9.0}}));
}

}  // namespace
}  // namespace dripline::server_test
