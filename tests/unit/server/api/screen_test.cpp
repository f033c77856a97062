#include "server/api/views.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

/// What the screen of a control shows, and what its gateway is asked for.
namespace dripline::server_test {
namespace {

class Screens : public ApiTest {};

/// CEN-203: what DNC FAST shows when a program was fed.
TEST_F(Screens, HaveTheStatisticsOfARun) {
  storage::Run run;
  EXPECT_TRUE(api::run_json(run)["statistics"].is_null()) << "not ended, or an older gateway";
  run.counters.executed = 240;
  run.statistics = storage::RunStatistics{60, 254};
  EXPECT_EQ(api::run_json(run)["statistics"], (Json{{"motion_seconds", 60.0},
                                                    {"distance_mm", 254.0},
                                                    {"average_feed_mm_per_min", 254.0},
                                                    {"average_block_seconds", 0.25},
                                                    {"blocks_per_second", 4.0}}));
  run.statistics = storage::RunStatistics{};
  const Json rest = api::run_json(run)["statistics"];
  EXPECT_TRUE(rest["average_feed_mm_per_min"].is_null()) << "nothing moved";
  EXPECT_TRUE(rest["blocks_per_second"].is_null());
}

TEST_F(Screens, AskTheGatewayForTheValuesOfItsControl) {
  show_machine("lathe-1");
  const auto values = json(get("/api/v1/machines/lathe-1/values?beginning=P1&offset=7"));
  EXPECT_EQ(values["machine"], "lathe-1");
  EXPECT_EQ(values["values"][0], (Json{{"name", "P10"}, {"value", 7.5}}));
  EXPECT_TRUE(values["values"][1]["value"].is_null());
  EXPECT_EQ(values["outputs"][0]["axis"], "X");
  for (const char* later : {"inputs", "analog", "functions"})
    EXPECT_EQ(values[later], Json::array()) << later << " of a gateway that reports none";
  EXPECT_EQ(machines_.asked.at(0).beginning, "P1");
  EXPECT_EQ(machines_.asked.at(0).passed_over, 7U);
  expect_error(get("/api/v1/machines/lathe-9/values"), 404, "not_found", "lathe-9");
  expect_error(get("/api/v1/machines/lathe-1/values?offset=x"), 400, "syntax", "offset");
  machines_.answer = "[]";
  expect_error(get("/api/v1/machines/lathe-1/values"), 500, "corrupt", "lathe-1");
  machines_.refusal = Error{Errc::Unsupported, "its control is at the end of a line"};
  expect_error(get("/api/v1/machines/lathe-1/values"), 422, "unsupported", "end of a line");
}

TEST_F(Screens, ShowTheScreenOfTheControl) {
  show_machine("lathe-1");
  dds::Status status;
  status.machine = "lathe-1";
  status.screen = dds::Screen{.is_inch = true,
                              .position = dds::PositionDisplay::DistanceToGo,
                              .previous_block = "",
                              .block = "N20 G1 X2",
                              .next_block = "N30 M30",
                              .further_block = ""};
  machines_.views[0].status = status;
  EXPECT_EQ(json(get("/api/v1/machines/lathe-1"))["status"]["screen"],
            (Json{{"units", "inch"},
                  {"position", "distance_to_go"},
                  {"previous_block", nullptr},
                  {"block", "N20 G1 X2"},
                  {"next_block", "N30 M30"},
                  {"further_block", nullptr}}));
}

}  // namespace
}  // namespace dripline::server_test
