#include <csignal>

#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

// `dnc port ...` and the judgment of held revisions: the real executable against a fake server.

namespace dripline {

namespace {

using test_support::Dnc;

TEST(DncPortPage, GoesFromALineToThePageAndBack) {  // CEN-197, CEN-198
  Dnc dnc{DNC_PATH};
  const auto page = dnc({"port", "page", "--for", "1200o81", "--set", "eob=cr"});
  ASSERT_EQ(page.status, 0) << page.err;
  EXPECT_NE(page.out.find("com1_format = \"O/8/1\""), std::string::npos) << page.out;
  dnc.write("page.toml", page.out);
  const auto line = dnc({"port", "page", "page.toml"});
  EXPECT_EQ(line.out, "--template centurion baud=1200 data_bits=8 parity=odd stop_bits=1 eob=cr\n")
      << line.err;
}

TEST(DncPortPage, NamesWhatThePageDoesNotHave) {
  Dnc dnc{DNC_PATH};
  EXPECT_EQ(dnc({"port", "page", "--for", "57600n81"}).err,
            "dnc: baud 57600: the page has 110, 150, 300, 600 ... 19200\n");
  dnc.write("page.toml", "com1_baud = 9600\ncom1_format = \"X/7/2\"\n");
  EXPECT_EQ(dnc({"port", "page", "page.toml"}).err,
            "dnc: page.toml line 2: com1_format = X/7/2: expected N, E or O / 7 or 8 / 1 or 2, "
            "such as E/7/2\n");
  EXPECT_EQ(dnc({"port", "page"}).status, 2);
}

using nlohmann::json;
using test_support::FakeServer;
using test_support::port_json;

class DncPort : public testing::Test {
 protected:
  DncPort() {
    dnc.environment["DRIPLINE_SERVER"] = server.url();
    dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
    dnc.environment["TZ"] = "UTC";
  }
  /// The body of the last call that begins so; null when there is none.
  json last_body(const std::string& call) const {
    json body;
    for (const auto& made : server.calls()) {
      if (made.starts_with(call + " ")) {
        body = json::parse(made.substr(call.size() + 1), nullptr, false);
      }
    }
    return body;
  }
  static json traffic(const std::string& what, const std::string& hex, const std::string& text) {
    return {{"port", "line-1"},
            {"time", "2026-11-21T07:40:06.100000Z"},
            {"what", what},
            {"bytes", hex},
            {"text", text}};
  }
  FakeServer server;
  test_support::Dnc dnc{DNC_PATH};
};

TEST_F(DncPort, AddsAPortWithItsSettings) {
  server.set_answer("PUT /api/v1/ports/line-1", 201, port_json("line-1").dump());
  dnc.write("rules.toml", "reply = \"O9998\"\n");
  const auto added =
      dnc({"port", "add", "line-1", "--machine", "mill-3", "--address", "/dev/ttyUSB0",
           "--template", "tnc155", "--rules", "rules.toml", "4800e71", "line_delay_ms=20"});
  EXPECT_EQ(added.status, 0) << added.err;
  EXPECT_EQ(added.out, "Port line-1 of mill-3 at /dev/ttyUSB0: 4800e71 xonxoff, open\n");
  EXPECT_EQ(last_body("PUT /api/v1/ports/line-1"),
            (json{{"machine", "mill-3"},
                  {"address", "/dev/ttyUSB0"},
                  {"template", "tnc155"},
                  {"rules", "reply = \"O9998\"\n"},
                  {"settings", {{"line", "4800e71"}, {"line_delay_ms", "20"}}},
                  {"enabled", true}}));
}

TEST_F(DncPort, DoesNotAddOneThatIsThere) {
  server.set_answer("GET /api/v1/ports/line-1", port_json("line-1"));
  const auto refused = dnc({"port", "add", "line-1", "--machine", "m", "--address", "/dev/null"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("dnc port set changes it"), std::string::npos) << refused.err;
  EXPECT_TRUE(last_body("PUT /api/v1/ports/line-1").is_null());
}

TEST_F(DncPort, ChangesOnlyWhatIsNamed) {
  auto port = port_json("line-1");
  port["rules"] = "reply = \"O1\"";
  server.set_answer("GET /api/v1/ports/line-1", port);
  server.set_answer("PUT /api/v1/ports/line-1", port);
  EXPECT_EQ(dnc({"port", "set", "line-1", "baud=", "eob=lf"}).status, 0);
  EXPECT_EQ(last_body("PUT /api/v1/ports/line-1"), (json{{"machine", "mill-3"},
                                                         {"address", "/dev/ttyUSB0"},
                                                         {"template", "tnc155"},
                                                         {"rules", "reply = \"O1\""},
                                                         {"settings", {{"eob", "lf"}}},
                                                         {"enabled", true}}));
  EXPECT_EQ(dnc({"port", "disable", "line-1"}).status, 0);
  EXPECT_EQ(last_body("PUT /api/v1/ports/line-1")["enabled"], false);
  EXPECT_EQ(last_body("PUT /api/v1/ports/line-1")["settings"]["baud"], "4800");
  EXPECT_EQ(dnc({"port", "set", "line-1", "--no-rules"}).status, 0);
  EXPECT_FALSE(last_body("PUT /api/v1/ports/line-1").contains("rules"));
  EXPECT_EQ(dnc({"port", "set", "line-1", "quick"}).status, 2);
}

TEST_F(DncPort, PassesOnWhyTheServerRefuses) {
  server.set_answer("PUT /api/v1/ports/line-1", 409,
                    R"({"error":{"code":"busy","message":"address /dev/ttyUSB0 is port x's"}})");
  const auto refused =
      dnc({"port", "add", "line-1", "--machine", "m", "--address", "/dev/ttyUSB0"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "dnc: address /dev/ttyUSB0 is port x's\n");
}

TEST_F(DncPort, ListsPortsAndWhatTheirLinesWaitFor) {
  auto waiting = port_json("line-2");
  waiting["line"] = {{"phase", "sending"},
                     {"stopped", true},
                     {"stopping", false},
                     {"waiting_for", "DC1"},
                     {"without_limit", true}};
  waiting["waiting_since"] = "2026-11-21T07:40:06.1Z";
  waiting["sent"] = 123456;
  waiting["run"] = "aa11bb22cc";
  auto closed = port_json("line-3");
  closed["open"] = false;
  closed["fault"] = "/dev/ttyUSB0: no such device";
  server.set_answer("GET /api/v1/ports", {{"ports", {port_json("line-1"), waiting, closed}}});
  const auto list = dnc({"port", "list"});
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_NE(list.out.find("4800e71 xonxoff  sending, stopped  DC1 for "), std::string::npos)
      << list.out;
  EXPECT_NE(list.out.find(", no limit  aa11bb22  123.5 kB"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("closed"), std::string::npos);
  EXPECT_NE(list.out.find("no such device\n"), std::string::npos);
  const auto as_json = json::parse(dnc({"port", "list", "--json"}).out);
  EXPECT_EQ(as_json["ports"][1], waiting);
}

TEST_F(DncPort, ShowsOnePort) {
  server.set_answer("GET /api/v1/ports/line-1", port_json("line-1"));
  const auto shown = dnc({"port", "show", "line-1"});
  EXPECT_NE(shown.out.find("own settings  baud=4800\n"), std::string::npos) << shown.out;
  EXPECT_EQ(json::parse(dnc({"port", "show", "line-1", "--json"}).out), port_json("line-1"));
  EXPECT_EQ(dnc({"port", "show", "none"}).status, 1);
}

TEST_F(DncPort, ShowsTemplatesAndWhatTheirSettingsMean) {
  const json answer{{"templates",
                     {{{"name", "tnc155"},
                       {"title", "HEIDENHAIN TNC 155"},
                       {"control", "tnc155"},
                       {"settings", {{"line", "2400e71"}, {"flow", "heidenhain"}}}}}},
                    {"settings",
                     {{{"key", "flow"},
                       {"type", "none|xonxoff"},
                       {"text", "who holds whom"},
                       {"default", "?"}}}}};
  server.set_answer("GET /api/v1/port-templates", answer);
  const auto list = dnc({"port", "templates"}).out;
  EXPECT_NE(list.find("tnc155  2400e71 heidenhain  tnc155   HEIDENHAIN TNC 155\n"),
            std::string::npos)
      << list;
  const auto one = dnc({"port", "templates", "tnc155"}).out;
  EXPECT_NE(one.find("flow     heidenhain  who holds whom  none|xonxoff\n"), std::string::npos)
      << one;
  const auto unknown = dnc({"port", "templates", "none"});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find("known are: tnc155"), std::string::npos);
}

TEST_F(DncPort, TestsALineAndTellsByItsStatus) {
  server.set_answer("POST /api/v1/ports/line-1/test",
                    json{{"passed", false}, {"findings", {"CTS is off: is the cable in?"}}});
  const auto failed = dnc({"port", "test", "line-1"});
  EXPECT_EQ(failed.status, 1);
  EXPECT_EQ(failed.out, "CTS is off: is the cable in?\nline-1: failed\n");
  server.set_answer("POST /api/v1/ports/line-1/test",
                    json{{"passed", true}, {"findings", json::array()}});
  EXPECT_EQ(dnc({"port", "test", "line-1"}).status, 0);
}

TEST_F(DncPort, SaysWhichRuleFiresAndWhy) {
  server.set_answer("POST /api/v1/ports/line-1/test-rules",
                    json{{"rule", "calls/send"},
                         {"action", "send"},
                         {"argument", "O1234"},
                         {"why", {"calls/send: comment PRG=1234 is there"}}});
  dnc.write("call.nc", "O9999\r\n(PRG=1234)\r\n");
  const auto judged = dnc({"port", "test-rules", "line-1", "call.nc"});
  EXPECT_EQ(judged.status, 0) << judged.err;
  EXPECT_EQ(judged.out,
            "  calls/send: comment PRG=1234 is there\nrule calls/send fires: send O1234\n");
  EXPECT_EQ(last_body("POST /api/v1/ports/line-1/test-rules"),
            (json{{"text", "O9999\n(PRG=1234)\n"}}));
  EXPECT_EQ(dnc({"port", "test-rules", "line-1", "missing.nc"}).status, 2);
}

TEST_F(DncPort, WatchesALineUntilCtrlC) {
  server.set_answer("GET /api/v1/ports/line-1", port_json("line-1"));
  server.publish("port", port_json("line-1"));
  server.publish("traffic", traffic("sent", "4d33300d0a", ""));
  server.publish("traffic", traffic("received", "13", ""));
  server.publish("lost", {{"lost", 7}});
  server.publish("traffic", traffic("fault", "", "parity error"));
  auto watch = dnc.start({"port", "monitor", "line-1"});
  const auto has = [&](const std::string& text) {
    return test_support::eventually([&] { return watch.output().find(text) != std::string::npos; });
  };
  EXPECT_TRUE(has("line-1 of mill-3 at /dev/ttyUSB0, 4800e71 xonxoff."));
  EXPECT_TRUE(has("=  open\n"));
  EXPECT_TRUE(has("07:40:06.100  →  M30<CR><LF>\n07:40:06.100  ←  <DC3>\n"));
  EXPECT_TRUE(has("7 entries are missing here"));
  EXPECT_TRUE(has("07:40:06.100  !  parity error\n"));
  auto stopped = port_json("line-1");
  stopped["line"]["stopped"] = true;
  server.publish("port", stopped);
  EXPECT_TRUE(has("=  open, stopped by the control\n")) << watch.output();
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
}

TEST_F(DncPort, WatchesALineAsJson) {
  server.set_answer("GET /api/v1/ports/line-1", port_json("line-1"));
  server.publish("traffic", traffic("sent", "4d", ""));
  server.publish("lost", {{"lost", 7}});
  auto watch = dnc.start({"port", "monitor", "line-1", "--json"});
  EXPECT_TRUE(test_support::eventually([&] {
    return watch.output().find(R"("what":"sent","bytes":"4d","text":null})"
                               "\n{\"lost\":7}\n") != std::string::npos;
  })) << watch.output();
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
}

TEST_F(DncPort, DoesNotWatchAPortThatIsNotThere) {
  const auto refused = dnc({"port", "monitor", "none"});
  EXPECT_EQ(refused.status, 1);
}

TEST_F(DncPort, ShowsAndSavesTheRecording) {
  const std::string lines =
      traffic("sent", "4731", "").dump() + "\n" + traffic("note", "", "open").dump() + "\n";
  server.set_answer("GET /api/v1/ports/line-1/recording", 200, lines);
  EXPECT_EQ(dnc({"port", "recording", "line-1"}).out,
            "07:40:06.100  →  G1\n07:40:06.100  ·  open\n");
  EXPECT_EQ(dnc({"port", "recording", "line-1", "--json"}).out, lines);
  const auto saved = dnc({"port", "recording", "line-1", "-o", "line.jsonl"});
  EXPECT_EQ(saved.status, 0);
  EXPECT_EQ(saved.err, "Wrote the recording of line-1 to line.jsonl\n");
  EXPECT_EQ(dnc.read("line.jsonl"), lines);
}

TEST_F(DncPort, SetsUpThePortsOfAFile) {
  server.set_answer("PUT /api/v1/ports/line-1", 201, port_json("line-1").dump());
  server.set_answer("PUT /api/v1/ports/line-2", 200, port_json("line-2").dump());
  const std::string good =
      "[[port]]\nname='line-1'\nmachine='mill-3'\naddress='/dev/ttyS0'\n"
      "[[port]]\nname='line-2'\nmachine='mill-4'\naddress='/dev/ttyS1'\n";
  dnc.write("ports.toml", good);
  const auto applied = dnc({"port", "apply", "ports.toml"});
  EXPECT_EQ(applied.status, 0) << applied.err;
  EXPECT_EQ(last_body("PUT /api/v1/ports/line-2")["machine"], "mill-4");
  const auto calls = server.calls().size();
  dnc.write("ports.toml", good + "enabled=1\n");
  EXPECT_EQ(dnc({"port", "apply", "ports.toml"}).status, 2);
  EXPECT_EQ(server.calls().size(), calls) << "a bad file changes nothing";
}

TEST_F(DncPort, RemovesAPort) {
  server.set_answer("DELETE /api/v1/ports/line-1", 204, "");
  EXPECT_EQ(dnc({"port", "remove", "line-1"}).out, "Removed port line-1; its line is closed.\n");
}

TEST_F(DncPort, ShowsWhatWaitsForAcceptanceAndJudgesIt) {
  server.add_program("O1", "one\n");
  EXPECT_EQ(dnc({"program", "list"}).out.find("wait"), std::string::npos);
  auto revision = test_support::revision_json("O1", "program", 2, "two\n");
  server.set_answer("POST /api/v1/programs/O1/revisions/2/accept", revision);
  const auto accepted = dnc({"program", "accept", "O1", "2"});
  EXPECT_EQ(accepted.status, 0) << accepted.err;
  EXPECT_TRUE(accepted.out.starts_with("Accepted O1 revision 2: 4 B, sha256 ")) << accepted.out;
  server.set_answer("POST /api/v1/programs/O1/revisions/3/reject", 204, "");
  EXPECT_EQ(dnc({"program", "reject", "O1", "3"}).status, 0);
  EXPECT_EQ(dnc({"program", "reject", "O1", "4"}).status, 1);
}

TEST_F(DncPort, TakesARevisionThroughItsStates) {
  const std::string path = "/api/v1/programs/O1/revisions/2/";
  auto revision = test_support::revision_json("O1", "program", 2, "two\n");
  for (const std::string step : {"submit", "approve", "release", "withdraw", "reject"}) {
    revision["state"] = step == "submit" ? "in_review" : "approved";
    server.set_answer("POST " + path + step, revision);
    const auto done = dnc({"program", step, "O1", "2", "--comment", "because"});
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_TRUE(done.out.starts_with(step == "submit" ? "O1 revision 2 is in review, sha256 "
                                                      : "O1 revision 2 is approved, sha256 "))
        << done.out;
    EXPECT_EQ(server.calls().back(), "POST " + path + step + " {\"comment\":\"because\"}");
  }
  server.set_answer("GET " + path + "states", json{{"state", "in_review"},
                                                   {"public_key", std::string(64, 'a')},
                                                   {"steps",
                                                    {{{"id", 7},
                                                      {"step", "submit"},
                                                      {"state", "in_review"},
                                                      {"time", "2026-11-21T07:40:06.123456Z"},
                                                      {"who", "anna"},
                                                      {"comment", "deeper \u001b[31mgroove"},
                                                      {"text", "step submit\n"},
                                                      {"signature", std::string(128, 'b')}}}}});
  const auto shown = dnc({"program", "states", "O1", "2"});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_NE(shown.out.find("O1 revision 2 is in review"), std::string::npos);
  EXPECT_NE(shown.out.find("anna"), std::string::npos);
  EXPECT_EQ(shown.out.find('\x1b'), std::string::npos) << "a comment moves no cursor";
  const auto listed = dnc({"program", "states", "O1", "2", "--json"});
  EXPECT_NE(listed.out.find(std::string(128, 'b')), std::string::npos) << listed.out;
  EXPECT_EQ(dnc({"program", "submit", "O1", "3"}).status, 1);
}

json transfer_json(const std::string& state, std::uint64_t sent, const json& reason) {
  return {{"id", "transfer-1"}, {"programs", {"O1 revision 2", "O2 revision 1"}},
          {"size", 640},        {"sent", sent},
          {"state", state},     {"reason", reason}};
}

/// CEN-200.
TEST_F(DncPort, SendsProgramsAndWaitsForTheEnd) {
  auto port = port_json("line-1");
  port["transfer"] = transfer_json("completed", 640, nullptr);
  server.set_answer("POST /api/v1/ports/line-1/transfers", 201,
                    transfer_json("sending", 0, nullptr).dump());
  server.set_answer("GET /api/v1/ports/line-1", port);
  const auto sent = dnc({"port", "send", "line-1", "O1@2", "O2"});
  EXPECT_EQ(sent.status, 0) << sent.err;
  EXPECT_EQ(sent.out, "Sent O1 revision 2, O2 revision 1: 640 B.\n");
  EXPECT_EQ(last_body("POST /api/v1/ports/line-1/transfers"), (json{{"programs", {"O1@2", "O2"}}}));
  const auto left = dnc({"port", "send", "line-1", "O1", "--no-wait", "--json"});
  EXPECT_EQ(json::parse(left.out)["state"], "sending");
  port["transfer"] = transfer_json("interrupted", 128, "the line is lost");
  server.set_answer("GET /api/v1/ports/line-1", port);
  const auto lost = dnc({"port", "send", "line-1", "O1"});
  EXPECT_EQ(lost.status, 1);
  EXPECT_EQ(lost.out, "Not all was sent, 128 B of 640 B: interrupted: the line is lost\n");
}

TEST_F(DncPort, AsksTheControlForAProgramAndSaysWhatCame) {
  server.set_answer("POST /api/v1/ports/line-1/receive", 204, "");
  server.set_answer("GET /api/v1/ports/line-1", port_json("line-1"));
  server.set_answer("GET /api/v1/ports/line-1/recording", 200, "");
  const auto received = dnc({"port", "receive", "line-1"});
  EXPECT_EQ(received.status, 0) << received.err;
  EXPECT_NE(received.out.find("Asking the control on line-1"), std::string::npos);
  server.set_answer("POST /api/v1/ports/line-1/confirm-reset", 204, "");
  EXPECT_EQ(dnc({"port", "confirm-reset", "line-1"}).out,
            "Confirmed: the control on line-1 was reset. It gets the next program.\n");
  server.set_answer("DELETE /api/v1/ports/line-1/transfers", 204, "");
  EXPECT_EQ(dnc({"port", "stop", "line-1"}).out, "The transfer on line-1 is ended.\n");
}

/// CEN-211.
TEST_F(DncPort, CopiesAndRenamesPrograms) {
  auto copy = test_support::revision_json("O2", "program", 1, "O1\n");
  copy["comment"] = "copy of O1 revision 3";
  server.set_answer("POST /api/v1/programs/O1/copy", 201, copy.dump());
  const auto copied = dnc({"program", "copy", "O1", "O2", "--revision", "3"});
  EXPECT_EQ(copied.status, 0) << copied.err;
  EXPECT_EQ(copied.out, "O2 revision 1: copy of O1 revision 3, 3 B\n");
  EXPECT_EQ(last_body("POST /api/v1/programs/O1/copy"), (json{{"to", "O2"}, {"revision", 3}}));
  auto renamed = test_support::revision_json("O3", "name", 1, "O1\n");
  renamed["revisions"] = json::array({test_support::revision_json("O3", "program", 1, "O1\n")});
  server.set_answer("POST /api/v1/programs/O1/rename", renamed);
  EXPECT_EQ(dnc({"program", "rename", "O1", "O3"}).out,
            "O1 is now O3, with 1 revision; its runs and reports go with it.\n");
  EXPECT_EQ(dnc({"program", "rename", "O9", "O3"}).status, 1);
}

}  // namespace

}  // namespace dripline
