#include "clients/tools/studies/gauge_study_of.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dripline::studies {
namespace {

/// Each of two machines measures each of two parts twice.
std::vector<measurement::Measurement> readings(bool has_serials) {
  std::vector<measurement::Measurement> all;
  for (const std::string machine : {"gauge-1", "gauge-2"}) {
    for (const std::string part : {"a", "b", "a", "b"}) {
      measurement::Measurement one;
      one.machine = machine;
      (has_serials ? one.serial : one.part) = part;
      one.actual = (part == "a" ? 10.0 : 12.0) + 0.01 * static_cast<double>(all.size());
      all.push_back(one);
    }
  }
  return all;
}

TEST(GaugeStudyOf, TakesMachinesAsAppraisersAndSerialNumbersAsParts) {
  const auto study = study_gauge(readings(true), GaugeMethod::Ranges, 2.0);
  ASSERT_TRUE(study) << study.error().what;
  EXPECT_GT(study->parts.study_percent, 99);
  const auto json = to_json(*study);
  EXPECT_EQ(json["gauge"]["deviation"], study->gauge.deviation);
  EXPECT_GT(json["tolerance_percent"], 0);
}

TEST(GaugeStudyOf, TakesPartNumbersWhereThereIsNoSerialNumber) {
  const auto by_number = study_gauge(readings(false), GaugeMethod::Anova, {});
  const auto by_serial = study_gauge(readings(true), GaugeMethod::Anova, {});
  ASSERT_TRUE(by_number && by_serial);
  EXPECT_EQ(by_number->total, by_serial->total);
  EXPECT_TRUE(to_json(*by_number)["tolerance_percent"].is_null());
}

TEST(GaugeStudyOf, RefusesAStudyOfOneMachine) {
  auto all = readings(true);
  all.resize(4);
  EXPECT_EQ(study_gauge(all, GaugeMethod::Anova, {}).error().code, Errc::LimitExceeded);
  EXPECT_EQ(parse_gauge_method("guess").error().what, "method 'guess' is none of anova, ranges");
}

}  // namespace
}  // namespace dripline::studies
