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

TEST(CapabilityStudy, AppliesTheLimitsOfTheValues) {
  auto all = bores({40.01, 40.02, 39.99, 40.00, 39.98, 40.03});
  all.front().characteristic.upper = 40.2 - 0.1;  // computed differently
  const auto study = study_capability(all, {});
  ASSERT_TRUE(study) << study.error().what;
  EXPECT_EQ(study->tolerance.lower, 39.9);
  EXPECT_EQ(study->tolerance.upper, 40.1);
  EXPECT_FALSE(study->normality);  // fewer than 8
  const auto json = to_json(*study);
  EXPECT_EQ(json["upper"], 40.1);
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

TEST(CapabilityStudy, MixesNoLimits) {
  auto all = bores({40.01, 40.02, 39.99, 40.00, 39.98, 40.03});
  all[1].characteristic.upper = 40.05;
  const auto mixed = study_capability(all, {});
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, Errc::Conflict);
  EXPECT_EQ(
      mixed.error().what,
      "D40: nominal none, limits 39.9 to 40.05 mm at 1970-01-01T00:00:00.000000Z, but nominal "
      "none, limits 39.9 to 40.1 mm of the newest: choose those of one nominal value and one "
      "tolerance by since, until or run, or give both limits");
  EXPECT_TRUE(study_capability(all, {.lower = {}, .upper = 40.1, .settings = {}}));
  EXPECT_FALSE(study_capability(all, {.lower = 39.9, .upper = {}, .settings = {}}));
}

TEST(CapabilityStudy, MixesNoNominalValues) {
  auto all = bores({40.01, 40.02, 39.99, 40.00, 39.98, 40.03});
  for (auto& one : all) one.characteristic.nominal = 40;
  ASSERT_TRUE(study_capability(all, {}));
  all[2].characteristic.nominal = 50;
  EXPECT_EQ(study_capability(all, {}).error().code, Errc::Conflict);
  EXPECT_TRUE(study_capability(all, {.lower = 39.9, .upper = 40.1, .settings = {}}));
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
