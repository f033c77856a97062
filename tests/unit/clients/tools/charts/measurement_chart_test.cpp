#include "clients/tools/charts/measurement_chart.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

namespace dripline::charts {
namespace {

using measurement::Measurement;

std::vector<Measurement> diameters(int count) {
  std::vector<Measurement> all;
  for (int i = 0; i < count; ++i) {
    Measurement m;
    m.machine = "lathe-1";
    m.run = i < count / 2 ? "1f3a09c2aaaa" : "77b0de11bbbb";
    m.program = "O0100";
    m.tool = i < 12 ? "T3" : "T4";
    m.characteristic = {"Diameter", 40.0, 39.98, 40.02, "mm", 3};
    m.actual = 40 + 0.005 * std::sin(i * 1.7);
    m.time = UtcTime(std::chrono::hours(24 * 20000 + i));
    all.push_back(m);
  }
  return all;
}

TEST(MeasurementChart, NamesTheRunsThatLimitsWereComputedFrom) {
  const auto all = diameters(30);
  const auto request =
      parse_chart_request({{"kind", "individuals"}, {"rules", "nelson"}, {"baseline", "20"}});
  ASSERT_TRUE(request);
  const auto svg = measurements_svg(all, *request);
  ASSERT_TRUE(svg) << svg.error().what;
  EXPECT_NE(svg->find("limits computed from 20 values of runs 1f3a09c2 to 77b0de11, 2024-10-04"),
            std::string::npos);
  EXPECT_NE(svg->find("Diameter on lathe-1"), std::string::npos);
  EXPECT_NE(svg->find("program O0100"), std::string::npos);
}

TEST(MeasurementChart, DrawsEveryKind) {
  const auto all = diameters(30);
  for (const char* kind :
       {"individuals", "xbar-r", "xbar-s", "ewma", "cusum", "histogram", "trend"}) {
    const auto request = parse_chart_request({{"kind", kind}});
    ASSERT_TRUE(request) << kind;
    const auto svg = measurements_svg(all, *request);
    ASSERT_TRUE(svg) << kind << ": " << svg.error().what;
    EXPECT_NE(svg->find("30 values"), std::string::npos) << kind;
  }
}

TEST(MeasurementChart, ATrendBeginsAnewWithAnotherToolAndAtAChange) {
  const auto all = diameters(30);
  auto request = parse_chart_request({{"kind", "trend"}}).value();
  EXPECT_NE(measurements_svg(all, request)->find("30 values of 2 tool lives"), std::string::npos);
  request.tool_changes = {all[20].time};
  EXPECT_NE(measurements_svg(all, request)->find("30 values of 3 tool lives"), std::string::npos);
}

TEST(MeasurementChart, HasNoCapabilityOfDifferentLimits) {
  auto all = diameters(10);
  const auto request = parse_chart_request({{"kind", "histogram"}}).value();
  EXPECT_TRUE(measurements_svg(all, request));
  all[3].characteristic.nominal = 50;
  const auto mixed = measurements_svg(all, request);
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().what.find("Diameter: nominal 50, limits 39.98 to 40.02 mm at "),
            std::string::npos)
      << mixed.error().what;
}

TEST(MeasurementChart, RefusesAMixture) {
  auto all = diameters(10);
  all.back().characteristic.name = "Length";
  const auto mixed = measurements_svg(all, {});
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().what, "a chart of Diameter and Length: choose one characteristic");
  all.back().characteristic.name = "Diameter";
  all.back().characteristic.unit = "inch";
  EXPECT_FALSE(measurements_svg(all, {}));
  EXPECT_FALSE(measurements_svg({}, {}));
}

TEST(MeasurementChart, RefusesQueriesThatItDoesNotUnderstand) {
  using Query = std::map<std::string, std::string>;
  for (const Query& query :
       {Query{{"kind", "pie"}}, Query{{"colour", "red"}}, Query{{"width", "1e9"}},
        Query{{"width", "12"}}, Query{{"sigma", "x"}}, Query{{"rules", "all"}},
        Query{{"lambda", "0"}}, Query{{"confidence", "2"}}, Query{{"sigma", "nan"}}}) {
    EXPECT_FALSE(parse_chart_request(query)) << query.begin()->first;
  }
  const auto half = parse_chart_request({{"center", "40"}});
  ASSERT_TRUE(half);
  EXPECT_FALSE(measurements_svg(diameters(10), *half));
  const auto fixed =
      parse_chart_request({{"center", "40"}, {"sigma", "0.004"}, {"limits_note", "2 March"}});
  ASSERT_TRUE(fixed);
  EXPECT_NE(measurements_svg(diameters(10), *fixed)->find("limits fixed: 2 March"),
            std::string::npos);
}

}  // namespace
}  // namespace dripline::charts
