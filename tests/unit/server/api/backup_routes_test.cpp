#include "server/api/metrics_text.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

using test_support::eventually;

class BackupRoutes : public ApiTest {
 protected:
  Json ended() {
    Json state;
    EXPECT_TRUE(eventually([&] {
      state = json(get("/api/v1/backups"));
      return state["work"].is_null() && !state["last"].is_null();
    }));
    return state;
  }
};

TEST_F(BackupRoutes, SayThatNoneAreMade) {
  expect_error(get("/api/v1/backups"), 404, "not_found", "--backups");
  expect_error(call("POST", "/api/v1/backups"), 404, "not_found", "--backups");
}

TEST_F(BackupRoutes, MakeVerifyAndRemove) {
  set_up_backups();
  EXPECT_EQ(json(get("/api/v1/backups"))["backups"], Json::array());
  EXPECT_EQ(call("POST", "/api/v1/backups").status, 202);
  const Json made = ended();
  ASSERT_EQ(made["backups"].size(), 1u) << made;
  EXPECT_EQ(made["last"]["error"], "");
  const std::string id = made["backups"][0]["id"];
  EXPECT_TRUE(made["backups"][0]["verified"].is_null());
  EXPECT_EQ(call("POST", "/api/v1/backups/" + id + "/verify").status, 202);
  EXPECT_TRUE(eventually(
      [&] { return json(get("/api/v1/backups"))["backups"][0]["verified"].is_string(); }));
  expect_error(call("DELETE", "/api/v1/backups/" + id), 409, "conflict", "only one");
  expect_error(call("DELETE", "/api/v1/backups/20000101T000000Z"), 404, "not_found", "20000101");
}

class MetricsRoute : public ApiTest {
 protected:
  std::string metrics() {
    const auto response = get("/api/v1/metrics");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(response.content_type, "text/plain; version=0.0.4; charset=utf-8");
    return response.body;
  }
  static void expect_line(const std::string& text, const std::string& line) {
    EXPECT_NE(("\n" + text).find("\n" + line + "\n"), std::string::npos) << line << "\n" << text;
  }
};

TEST_F(MetricsRoute, GivesMachinesRunsHealthAndProcess) {
  push("O0100", "O0100\nM30\n");
  show_machine("lathe-1");
  dds::Status status;
  status.execution = dds::Execution::Active;
  status.buffered_seconds = 2.5;
  status.outbox = 3;
  status.executed = 17;
  machines_.views.back().status = status;
  health_.report("", {library::Health::Level::Degraded, "disk", "nearly full", ""});
  const std::string text = metrics();
  expect_line(text, "dripline_info{version=\"1\"} 1");
  expect_line(text, "dripline_programs 1");
  expect_line(text, "dripline_health 1");
  expect_line(text, "dripline_health_findings{subject=\"disk\"} 1");
  expect_line(text, "dripline_dds_rejected_messages_total 4");
  expect_line(text, "dripline_machine_connected{machine=\"lathe-1\"} 1");
  expect_line(text, "dripline_machine_buffered_seconds{machine=\"lathe-1\"} 2.5");
  expect_line(text, "dripline_machine_outbox_records{machine=\"lathe-1\"} 3");
  expect_line(text, "dripline_machine_run_executed_blocks{machine=\"lathe-1\"} 17");
  EXPECT_NE(text.find("dripline_machine_execution{machine=\"lathe-1\",state=\"ACTIVE\""),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("process_resident_memory_bytes "), std::string::npos);
}

/// What a strict reader demands: every family once, its help and type before its samples, every
/// sample of the family that was begun last, ended by a line feed.
TEST_F(MetricsRoute, IsWhatAPrometheusReads) {
  set_up_backups();
  show_machine("mill-3");
  machines_.views.back().status = dds::Status{};
  std::istringstream lines(metrics());
  std::string line, family;
  std::set<std::string> families;
  while (std::getline(lines, line)) {
    if (line.starts_with("# HELP ")) {
      family = line.substr(7, line.find(' ', 7) - 7);
      EXPECT_TRUE(families.insert(family).second) << line;
    } else if (line.starts_with("# TYPE ")) {
      EXPECT_TRUE(line == "# TYPE " + family + " gauge" || line == "# TYPE " + family + " counter")
          << line;
      EXPECT_EQ(line.ends_with("counter"), family.ends_with("_total")) << line;
    } else {
      EXPECT_EQ(line.substr(0, line.find_first_of("{ ")), family) << line;
      char* end = nullptr;
      const std::string value = line.substr(line.rfind(' ') + 1);
      (void)std::strtod(value.c_str(), &end);
      EXPECT_EQ(*end, '\0') << line;
    }
  }
}

TEST(MetricsText, EscapesWhatAReaderWouldTakeForItsOwn) {
  api::MetricsText text;
  text.gauge("lines", "Lines.");
  text.sample(0.5, {{"name", "a \"b\"\\\n"}, {"port", "1"}});
  EXPECT_EQ(text.take(),
            "# HELP lines Lines.\n# TYPE lines gauge\n"
            "lines{name=\"a \\\"b\\\"\\\\\\n\",port=\"1\"} 0.5\n");
}

}  // namespace
}  // namespace dripline::server_test
