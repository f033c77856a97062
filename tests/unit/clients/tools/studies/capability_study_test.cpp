#include "clients/tools/studies/capability_study.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace dripline::studies {
namespace {

std::vector<measurement::Measurement> bores(std::initializer_list<double> actuals) {
  std::vector<measurement::Measurement> all;
  for (const double actual : actuals) {
    measurement::Measurement one;
    one.characteristic.name = "D40";
    one.characteristic.lower = 39.9;
    one.characteristic.upper = 40.1;
    one.actual = actual;
    all.push_back(one);
  }
  return all;
}

TEST(CapabilityStudy, AppliesTheLimitsOfTheNewestValue) {
  auto all = bores({40.01, 40.02, 39.99, 40.00, 39.98, 40.03});
  all.back().characteristic.upper = 40.05;
  const auto study = study_capability(all, {});
  ASSERT_TRUE(study) << study.error().what;
  EXPECT_EQ(study->tolerance.lower, 39.9);
  EXPECT_EQ(study->tolerance.upper, 40.05);
  EXPECT_FALSE(study->normality);  // fewer than 8
  const auto json = to_json(*study);
  EXPECT_EQ(json["upper"], 40.05);
  EXPECT_LT(json["cpk"]["low"], json["cpk"]["value"]);
  EXPECT_TRUE(json["anderson_darling"].is_null());
}

TEST(CapabilityStudy, TakesOtherLimitsWhenTheyAreGiven) {
  const auto study = study_capability(bores({40.01, 40.02, 39.99, 40.00, 39.98}),
                                      {.lower = 39.95, .upper = {}, .settings = {}});
  ASSERT_TRUE(study) << study.error().what;
  EXPECT_EQ(study->tolerance.lower, 39.95);
  EXPECT_EQ(study->tolerance.upper, 40.1);
}

TEST(CapabilityStudy, ReportsWhetherTheValuesMayBeNormal) {
  const auto study = study_capability(
      bores({40.01, 40.02, 39.99, 40.00, 39.98, 40.01, 40.00, 39.99, 40.02, 40.00}), {});
  ASSERT_TRUE(study) << study.error().what;
  ASSERT_TRUE(study->normality);
  EXPECT_GT(to_json(*study)["anderson_darling"]["p_value"], 0.05);
}

TEST(CapabilityStudy, MixesNoUnits) {
  auto all = bores({40.01, 40.02, 39.99, 40.00, 39.98});
  all[2].characteristic.unit = "inch";
  EXPECT_EQ(study_capability(all, {}).error().code, Errc::Conflict);
}

TEST(CapabilityStudy, RefusesWhatItCannotStudy) {
  EXPECT_EQ(study_capability({}, {}).error().code, Errc::NotFound);
  auto mixed = bores({40, 40, 40, 40, 40});
  mixed.back().characteristic.name = "D12";
  EXPECT_EQ(study_capability(mixed, {}).error().what,
            "capability of D40 and D12: choose one characteristic");
  EXPECT_EQ(study_capability(bores({40.0, 40.1}), {}).error().code, Errc::LimitExceeded);
}

}  // namespace
}  // namespace dripline::studies
