// Serial ports as the API shows and takes them, without sockets and without lines.
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class PortRoutes : public ApiTest {
 protected:
  api::Response put(const std::string& target, const Json& body) {
    return call("PUT", target, {.body = body.dump(), .headers = {}});
  }
  api::Response add_port(const std::string& name) {
    return put("/api/v1/ports/" + name, {{"machine", "mill-3"},
                                         {"address", "/dev/ttyUSB0"},
                                         {"template", "tnc155"},
                                         {"settings", {{"baud", 4800}, {"flow", "rtscts"}}},
                                         {"rules", "[[rule]]"}});
  }
  ports::PortTraffic traffic(const std::string& bytes) {
    return {"line-1", clock_.now(), ports::TrafficKind::Received, bytes, ""};
  }
};

TEST_F(PortRoutes, AddAPortAndShowEveryThingItIsSetTo) {
  const auto added = add_port("line-1");
  ASSERT_EQ(added.status, 201) << added.body;
  const Json port = json(get("/api/v1/ports/line-1"));
  EXPECT_EQ(port["machine"], "mill-3");
  EXPECT_EQ(port["address"], "/dev/ttyUSB0");
  EXPECT_EQ(port["template"], "tnc155");
  EXPECT_EQ(port["settings"], (Json{{"baud", "4800"}, {"flow", "rtscts"}}));
  EXPECT_EQ(port["effective"]["baud"], "4800");
  EXPECT_TRUE(port["effective"].contains("eob"));
  EXPECT_EQ(port["rules"], "[[rule]]");
  EXPECT_EQ(port["enabled"], true);
  EXPECT_EQ(json(get("/api/v1/ports"))["ports"].size(), 1u);
  EXPECT_EQ(add_port("line-1").status, 200) << "changed, not added";
}

TEST_F(PortRoutes, WriteDownWhoChangedAPort) {
  add_port("line-1");
  const Json entry = json(get("/api/v1/audit"))["entries"][0];
  EXPECT_EQ(entry["action"], "port.save");
  EXPECT_EQ(entry["subject"], "line-1");
  EXPECT_EQ(entry["detail"], "mill-3 at /dev/ttyUSB0, template 'tnc155' baud=4800 flow=rtscts");
  EXPECT_EQ(call("DELETE", "/api/v1/ports/line-1").status, 204);
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["action"], "port.remove");
  expect_error(get("/api/v1/ports/line-1"), 404, "not_found", "line-1");
}

TEST_F(PortRoutes, PassRefusalsOnAndWriteNothingDown) {
  ports_.refusal = Error{Errc::Busy, "address /dev/ttyUSB0 is port line-7's already"};
  expect_error(add_port("line-1"), 409, "busy", "line-7");
  ports_.refusal.reset();
  add_port("line-1");
  ports_.refusal = Error{Errc::Busy, "port line-1 sends run R-1"};
  expect_error(call("DELETE", "/api/v1/ports/line-1"), 409, "busy", "R-1");
  const Json entries = json(get("/api/v1/audit"))["entries"];
  EXPECT_EQ(std::ranges::count_if(entries,
                                  [](const Json& entry) {
                                    return entry["action"].get<std::string>().starts_with("port.");
                                  }),
            1);
}

TEST_F(PortRoutes, ShowTheStateOfALine) {
  add_port("line-1");
  auto& view = ports_.views[0];
  view.is_open = true;
  view.line = {.phase = wire::Phase::Sending,
               .is_stopped = true,
               .is_stopping = false,
               .waiting_for = "ACK",
               .may_wait_without_limit = true};
  view.run = "R-1";
  view.sent = 12345;
  view.received = 7;
  view.waiting_since = clock_.now();
  view.fault = "parity error";
  const Json port = json(get("/api/v1/ports/line-1"));
  EXPECT_EQ(port["open"], true);
  EXPECT_EQ(port["line"], (Json{{"phase", "sending"},
                                {"stopped", true},
                                {"stopping", false},
                                {"waiting_for", "ACK"},
                                {"without_limit", true}}));
  EXPECT_EQ(port["run"], "R-1");
  EXPECT_EQ(port["sent"], 12345);
  EXPECT_EQ(port["received"], 7);
  EXPECT_EQ(port["fault"], "parity error");
  EXPECT_EQ(port["waiting_since"], to_iso8601(clock_.now()));
  EXPECT_TRUE(port["request"].is_null());
  view.request = {.since = clock_.now(), .program = "15", .answer = ""};
  EXPECT_EQ(json(get("/api/v1/ports/line-1"))["request"],
            (Json{{"since", to_iso8601(clock_.now())}, {"program", "15"}, {"answer", nullptr}}));
}

TEST_F(PortRoutes, TestALineAndJudgeAText) {
  add_port("line-1");
  const Json test = json(call("POST", "/api/v1/ports/line-1/test"));
  EXPECT_EQ(test["passed"], false);
  EXPECT_EQ(test["findings"][0], "CTS is off: is the cable plugged in?");
  const Json verdict =
      json(post("/api/v1/ports/line-1/test-rules", {{"text", "O9999\n(PRG=1234)\n"}}));
  EXPECT_EQ(ports_.tested_text, "O9999\n(PRG=1234)\n");
  EXPECT_EQ(verdict["rule"], "ask");
  EXPECT_EQ(verdict["argument"], "O1234");
  EXPECT_EQ(verdict["why"].size(), 1u);
  expect_error(call("POST", "/api/v1/ports/none/test"), 404, "not_found", "none");
}

TEST_F(PortRoutes, GiveTheRecordingAsJsonLines) {
  add_port("line-1");
  for (int i = 0; i < 600; ++i) ports_.traffic.push_back(traffic(std::string("\x11\xFF\n", 3)));
  ports_.traffic.push_back({"line-1", clock_.now(), ports::TrafficKind::Fault, "", "parity"});
  const auto response = get("/api/v1/ports/line-1/recording");
  EXPECT_EQ(response.content_type, "application/x-ndjson");
  const std::string text = body(response);
  EXPECT_EQ(std::ranges::count(text, '\n'), 601);
  const Json first = Json::parse(text.substr(0, text.find('\n')));
  EXPECT_EQ(first, (Json{{"port", "line-1"},
                         {"time", to_iso8601(clock_.now())},
                         {"what", "received"},
                         {"bytes", "11ff0a"},
                         {"text", ""}}));
}

TEST_F(PortRoutes, ShowWhatPassesOverALineFromNowOn) {
  add_port("line-1");
  add_port("line-2");
  const auto response = get("/api/v1/ports/line-1/traffic");
  ASSERT_TRUE(response.events);
  EXPECT_TRUE(response.events->take().starts_with("event: port\ndata: {"));
  const auto publish = api::publish_traffic_to(events_);
  publish(traffic("M30"));
  auto elsewhere = traffic("X");
  elsewhere.port = "line-2";
  publish(elsewhere);
  const std::string text = response.events->take();
  EXPECT_NE(text.find("event: traffic\ndata: {\"bytes\":\"4d3330\""), std::string::npos) << text;
  EXPECT_EQ(text.find("line-2"), std::string::npos);
  const auto machines = get("/api/v1/events");
  publish(traffic("M30"));
  EXPECT_EQ(machines.events->take(), "") << "not for those who watch machines";
}

TEST_F(PortRoutes, NameEveryTemplateAndWhatItsSettingsMean) {
  const Json answer = json(get("/api/v1/port-templates"));
  ASSERT_EQ(answer["templates"].size(), wire::line_templates().size());
  ASSERT_EQ(answer["settings"].size(), wire::setting_rows().size());
  for (const auto& row : answer["settings"]) {
    const std::string key = row["key"];
    EXPECT_NE(row["text"], "") << key;
    for (const auto& one : answer["templates"]) {
      EXPECT_TRUE(one["settings"].contains(key)) << one["name"] << " " << key;
    }
  }
}

TEST_F(PortRoutes, RefuseBadBodiesAndQueries) {
  expect_error(put("/api/v1/ports/Line%201", {{"machine", "m"}, {"address", "/dev/null"}}), 400,
               "syntax", "Line 1");
  expect_error(put("/api/v1/ports/line-1", {{"machine", "m"}}), 400, "syntax", "address");
  expect_error(put("/api/v1/ports/line-1",
                   {{"machine", "m"}, {"address", "/dev/null"}, {"settings", {{"baudd", 1}}}}),
               404, "not_found", "baudd");
  expect_error(get("/api/v1/ports?x=1"), 400, "syntax", "x");
  EXPECT_TRUE(ports_.views.empty());
}

TEST_F(PortRoutes, SayThatAServerHasNoPorts) {
  make_api(nullptr);
  expect_error(get("/api/v1/ports"), 422, "unsupported", "without serial ports");
  EXPECT_EQ(get("/api/v1/port-templates").status, 200);
}

class HeldRoutes : public ApiTest {
 protected:
  void receive(const std::string& program, const std::string& text) {
    const auto upload = programs_->begin(
        {.program = program, .control = "centurion", .comment = {}, .is_held = true}, "lathe-2");
    ASSERT_TRUE(upload) << upload.error().what;
    ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of(text)));
    const auto committed = programs_->commit(upload->id, std::nullopt, "lathe-2");
    ASSERT_TRUE(committed) << committed.error().what;
    EXPECT_TRUE(committed->revision.is_held);
    EXPECT_FALSE(committed->is_unchanged);
  }
};

TEST_F(HeldRoutes, ShowWhatWaitsForAcceptance) {
  push("O1", "one\n");
  receive("O1", "two\n");
  receive("O2", "three\n");
  const Json list = json(get("/api/v1/programs"))["programs"];
  EXPECT_EQ(list[0]["revision"], 1);
  EXPECT_EQ(list[0]["held"], false);
  EXPECT_EQ(list[0]["held_revisions"], 1);
  EXPECT_EQ(list[1]["held"], true) << "it has nothing else";
  const Json program = json(get("/api/v1/programs/O1"));
  EXPECT_EQ(program["revision"], 1);
  EXPECT_EQ(program["held_revisions"], 1);
  EXPECT_EQ(program["revisions"][0]["held"], true);
  EXPECT_EQ(json(get("/api/v1/programs/O2"))["held"], true);
  EXPECT_EQ(body(get("/api/v1/programs/O1/content")), "one\n");
  EXPECT_EQ(body(get("/api/v1/programs/O1/content?revision=2")), "two\n");
  expect_error(get("/api/v1/programs/O2/content"), 409, "conflict", "accept its revision 1");
}

TEST_F(HeldRoutes, AcceptOneAndRejectAnother) {
  push("O1", "one\n");
  receive("O1", "two\n");
  receive("O1", "three\n");
  EXPECT_EQ(call("POST", "/api/v1/programs/O1/revisions/3/reject").status, 204);
  const auto accepted = call("POST", "/api/v1/programs/O1/revisions/2/accept");
  ASSERT_EQ(accepted.status, 200) << accepted.body;
  EXPECT_EQ(json(accepted)["held"], false);
  EXPECT_EQ(json(accepted)["accepted"], to_iso8601(clock_.now()));
  const Json program = json(get("/api/v1/programs/O1"));
  EXPECT_EQ(program["revision"], 2);
  EXPECT_EQ(program["revisions"].size(), 2u);
  const Json entries = json(get("/api/v1/audit"))["entries"];
  EXPECT_EQ(entries[0]["action"], "program.accept");
  EXPECT_EQ(entries[0]["who"], "admin");
  EXPECT_EQ(entries[1]["action"], "program.reject");
}

TEST_F(HeldRoutes, SayWhyOneCannotBeJudged) {
  push("O1", "one\n");
  expect_error(call("POST", "/api/v1/programs/O1/revisions/1/reject"), 409, "conflict", "in force");
  expect_error(call("POST", "/api/v1/programs/O1/revisions/9/accept"), 404, "not_found", "9");
  expect_error(call("POST", "/api/v1/programs/O1/revisions/x/accept"), 400, "syntax", "'x'");
}

/// CEN-200.
TEST_F(PortRoutes, SendAndReceiveWithoutARunAndWriteItDown) {
  add_port("line-1");
  const auto sent = post("/api/v1/ports/line-1/transfers", {{"programs", {"O0001", "O0002@4"}}});
  ASSERT_EQ(sent.status, 201) << sent.body;
  EXPECT_EQ(json(sent)["programs"], (Json{"O0001 revision 1", "O0002 revision 4"}));
  EXPECT_EQ(json(sent)["state"], "sending");
  const Json entries = json(get("/api/v1/audit"))["entries"];
  EXPECT_EQ(entries[1]["action"], "port.send") << "before anything was sent";
  EXPECT_EQ(entries[1]["detail"], "O0001, O0002@4");
  EXPECT_EQ(entries[0]["action"], "port.sending");
  EXPECT_EQ(entries[0]["detail"], "O0001 revision 1, O0002 revision 4: 100 bytes");
  EXPECT_EQ(call("POST", "/api/v1/ports/line-1/receive").status, 204);
  EXPECT_EQ(call("POST", "/api/v1/ports/line-1/confirm-reset").status, 204);
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["detail"],
            "run r1 of program O1 was broken off");
  EXPECT_EQ(call("DELETE", "/api/v1/ports/line-1/transfers").status, 204);
  EXPECT_EQ(ports_.stop_reason, "stopped by admin");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["action"], "port.stop");
}

TEST_F(PortRoutes, RefuseATransferThatNamesNoPrograms) {
  add_port("line-1");
  const std::string path = "/api/v1/ports/line-1/transfers";
  expect_error(post(path, {{"programs", "O1"}}), 400, "syntax", "list");
  expect_error(post(path, {{"programs", {1}}}), 400, "syntax", "strings");
  expect_error(post(path, {{"programs", {"O1@x"}}}), 400, "syntax", "O1@x");
  expect_error(post(path, {{"programs", {"../O1"}}}), 400, "syntax", "../O1");
  expect_error(post(path, {{"programs", std::vector<std::string>(257, "O1")}}), 413,
               "limit_exceeded", "256");
  ports_.refusal = Error{Errc::Busy, "port line-1 is busy: it is receiving"};
  expect_error(post(path, {{"programs", {"O1"}}}), 409, "busy", "receiving");
}

}  // namespace
}  // namespace dripline::server_test
