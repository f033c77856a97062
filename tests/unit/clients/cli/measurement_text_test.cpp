#include "clients/cli/measurements/measurement_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dripline::cli {
namespace {

/// 40.1 is outside, and so it looks.
TEST(MeasurementText, ShowsLimitsThatDifferFromTheValue) {
  report_template::Value value;
  value.characteristic = {
      .name = "D40", .nominal = 40, .lower = 39.95, .upper = 40.05, .unit = "mm", .decimals = 1};
  value.actual = 40.1;
  value.verdict = measurement::Verdict::Rework;
  EXPECT_EQ(event_text(value), "    D40 = 40.1 mm (39.95 to 40.05): rework\n");
  value.characteristic.decimals = 3;
  EXPECT_EQ(event_text(value), "    D40 = 40.100 mm (39.950 to 40.050): rework\n");
  value.characteristic.decimals = 0;
  value.characteristic.lower = 40 - 0.3;
  value.characteristic.upper = std::nullopt;
  EXPECT_EQ(event_text(value), "    D40 = 40.1 mm (39.7 to ): rework\n");
}

std::string shown_part(const char* verdict, const nlohmann::ordered_json& ended) {
  const nlohmann::ordered_json parts = {{{"id", 7},
                                         {"machine", "mill-1"},
                                         {"verdict", verdict},
                                         {"begun", "2026-11-21T07:40:06.000Z"},
                                         {"ended", ended}}};
  return part_table(parts).render(false);
}

TEST(MeasurementText, ShowsNoVerdictOfAPartThatMayBecomeWorse) {
  EXPECT_EQ(shown_part("good", nullptr).find("good"), std::string::npos);
  EXPECT_NE(shown_part("good", nullptr).find("open"), std::string::npos);
  EXPECT_NE(shown_part("good", "2026-11-21T07:41:06.000Z").find("good"), std::string::npos);
  EXPECT_NE(shown_part("scrap", nullptr).find("scrap"), std::string::npos);
}

}  // namespace
}  // namespace dripline::cli
