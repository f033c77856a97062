#include <fstream>
#include <regex>
#include <set>

#include "server/api/metrics_text.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

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

TEST_F(MetricsRoute, SaysWhoIsActiveAndWhoWaits) {
  expect_line(metrics(), "dripline_server_active 1");
  EXPECT_EQ(metrics().find("dripline_server_term"), std::string::npos) << "of a SQLite file";
  share_library({"dncd 7 on srv-2"});
  expect_line(metrics(), "dripline_server_term 41");
  expect_line(metrics(), "dripline_server_standbys 1");
}

TEST_F(MetricsRoute, CertificatesHaveTheirStateBeforeAndAfterTheirEnd) {
  for (const char* name : {"lathe-1", "lathe-2", "lathe-3", "lathe-4"}) show_machine(name);
  machines_.views[0].certificate_expires = clock_.now() + std::chrono::days(400);
  machines_.views[1].certificate_expires = clock_.now() + std::chrono::days(29);
  machines_.views[2].certificate_expires = clock_.now() - std::chrono::seconds(1);
  const auto list = json(get("/api/v1/certificates"))["certificates"];
  ASSERT_EQ(list.size(), 3U) << list;  // lathe-4 has none
  EXPECT_EQ(list[0]["machine"], "lathe-1");
  EXPECT_EQ(list[0]["use"], "gateway");
  EXPECT_EQ(list[0]["state"], "ok");
  EXPECT_EQ(list[0]["days_left"], 400);
  EXPECT_EQ(list[1]["state"], "expiring");
  EXPECT_EQ(list[2]["state"], "expired");
}

TEST_F(MetricsRoute, AMachineStatesWhatItsControlShows) {
  show_machine("lathe-1");
  const auto display = [this] { return json(get("/api/v1/machines/lathe-1"))["display"]; };
  machines_.views.back().machine.control = "centurion";
  EXPECT_EQ(display(), (Json{{"units", "inch"},
                             {"x", "diameter"},
                             {"fields",
                              {"compensation", "tool_length_x", "tool_length_z", "tool_radius",
                               "work_system", "incremental", "cycle"}}}));
  dds::Status status;
  status.run = "run-1";
  status.modes = dds::ActiveModes{};
  machines_.views.back().status = status;
  EXPECT_EQ(display()["units"], "mm") << "the program's unit applies while it is there";
  machines_.views.back().status.edit().screen = dds::Screen{.is_inch = true};
  EXPECT_EQ(display()["units"], "inch") << "what the control's settings choose wins";
  machines_.views.back().machine.control = "tnc155";
  EXPECT_EQ(display()["fields"], (Json{"compensation", "tool_length_z", "tool_radius"}));
  machines_.views.back().machine.control = "fanuc";
  EXPECT_EQ(display()["x"], "radius");
  machines_.views.back().machine.control = "unheard-of";
  EXPECT_TRUE(display().is_null());
}

/// What a strict reader demands: every family once, its help and type before its samples, every
/// sample of the family that was begun last, ended by a line feed.
TEST_F(MetricsRoute, IsWhatAPrometheusReads) {
  set_up_backups();
  show_machine("mill-3");
  machines_.views.back().status = dds::Status{};
  std::istringstream lines(metrics());
  std::string line, family, type;
  std::set<std::string> families;
  while (std::getline(lines, line)) {
    if (line.starts_with("# HELP ")) {
      family = line.substr(7, line.find(' ', 7) - 7);
      EXPECT_TRUE(families.insert(family).second) << line;
    } else if (line.starts_with("# TYPE ")) {
      type = line.substr(line.rfind(' ') + 1);
      EXPECT_EQ(line, "# TYPE " + family + " " + type);
      EXPECT_TRUE(type == "gauge" || type == "counter" || type == "histogram") << line;
      EXPECT_EQ(type == "counter", family.ends_with("_total")) << line;
    } else {
      const std::string name = line.substr(0, line.find_first_of("{ "));
      if (type == "histogram") {
        const bool is_sample =
            name == family + "_bucket" || name == family + "_sum" || name == family + "_count";
        EXPECT_TRUE(is_sample) << line;
      } else {
        EXPECT_EQ(name, family) << line;
      }
      char* end = nullptr;
      const std::string value = line.substr(line.rfind(' ') + 1);
      (void)std::strtod(value.c_str(), &end);
      EXPECT_EQ(*end, '\0') << line;
    }
  }
}

TEST_F(MetricsRoute, GivesTheTimesOfAnswersByRoute) {
  push("O0100", "O0100\nM30\n");
  (void)get("/api/v1/programs/O0100");
  (void)get("/api/v1/programs/O0200");
  const std::string text = metrics();
  const std::string route = "{route=\"GET /api/v1/programs/{name}\"";
  expect_line(text, "dripline_http_request_seconds_count" + route + "} 2");
  expect_line(text, "dripline_http_request_seconds_bucket" + route + ",le=\"+Inf\"} 2");
}

/// Dashboard and alert rules ask for nothing that the server does not give.
TEST_F(MetricsRoute, GivesWhatDashboardAndAlertsAskFor) {
  set_up_backups();
  set_up_archives();
  share_library({});
  ASSERT_TRUE(retention_->archive_check().check());
  show_machine("mill-3");
  machines_.views.back().status = dds::Status{};
  machines_.views.back().clock_ahead = std::chrono::milliseconds(3);
  health_.report("", {library::Health::Level::Degraded, "disk", "nearly full", ""});
  ASSERT_TRUE(chain_->verify());
  std::set<std::string> families;
  std::istringstream lines(metrics());
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("# HELP ")) families.insert(line.substr(7, line.find(' ', 7) - 7));
  for (const char* file : {"dashboard.json", "alerts.yml"}) {
    std::ifstream in(std::string("deploy/monitoring/") + file);
    const std::string wanted{std::istreambuf_iterator<char>(in), {}};
    static const std::regex name("\\b(dripline|process)_[a-z_]+");
    std::set<std::string> names;
    for (std::sregex_iterator it(wanted.begin(), wanted.end(), name), end; it != end; ++it)
      names.insert(it->str());
    EXPECT_GT(names.size(), 5u) << file;
    for (auto each : names) {
      for (const std::string_view part : {"_bucket", "_count"})
        if (each.ends_with(part)) each.resize(each.size() - part.size());
      const bool may_be_absent = each == "dripline_certificate_expiry_timestamp_seconds" ||
                                 each == "dripline_backup_newest_timestamp_seconds";
      EXPECT_TRUE(may_be_absent || families.contains(each)) << file << " asks for " << each;
    }
  }
}

TEST(MetricsText, SumsUpTheBucketsOfAHistogram) {
  api::MetricsText text;
  text.histogram("taken_seconds", "Time.");
  const std::array bounds{0.5, 2.0};
  const std::array<std::uint64_t, 3> counts{1, 0, 2};
  text.distribution(bounds, counts, 7.25, "route", "GET /");
  EXPECT_EQ(text.take(),
            "# HELP taken_seconds Time.\n# TYPE taken_seconds histogram\n"
            "taken_seconds_bucket{route=\"GET /\",le=\"0.5\"} 1\n"
            "taken_seconds_bucket{route=\"GET /\",le=\"2\"} 1\n"
            "taken_seconds_bucket{route=\"GET /\",le=\"+Inf\"} 3\n"
            "taken_seconds_sum{route=\"GET /\"} 7.25\n"
            "taken_seconds_count{route=\"GET /\"} 3\n");
}

TEST(RequestTimes, PutEachAnswerIntoItsBucket) {
  using std::chrono::milliseconds;
  api::RequestTimes times;
  times.add("GET /", milliseconds(1));
  times.add("GET /", milliseconds(2));
  times.add("GET /", milliseconds(60'000));
  const auto taken = times.all().at("GET /");
  EXPECT_EQ(taken.counts, (decltype(taken.counts){1, 1, 0, 0, 0, 0, 0, 1}));
  EXPECT_NEAR(taken.sum, 60.003, 1e-9);
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
