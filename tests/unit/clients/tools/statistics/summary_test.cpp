#include "clients/tools/statistics/summary.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/unit/clients/tools/statistics/strd.hpp"

namespace dripline::statistics {
namespace {

/// Digits that agree with the certified value, as StRD counts them: -log10 of the relative error.
double agreeing_digits(double value, double certified) {
  return value == certified ? 16 : -std::log10(std::abs(value - certified) / std::abs(certified));
}

struct Certified {
  const char* name;
  std::vector<double> values;
  double mean, deviation, autocorrelation;
  double digits;  ///< of the deviation: the values' own rounding allows no more
};

class StRD : public testing::TestWithParam<Certified> {};

TEST_P(StRD, AgreesWithTheCertifiedValues) {
  const Certified& of = GetParam();
  const Summary summary = summarize(of.values);
  EXPECT_GE(agreeing_digits(summary.mean, of.mean), 14.5);
  EXPECT_GE(agreeing_digits(summary.standard_deviation, of.deviation), of.digits);
  EXPECT_GE(agreeing_digits(lag_one_autocorrelation(of.values), of.autocorrelation), of.digits - 1);
}

TEST_P(StRD, OneValueAtATimeLosesFewDigits) {
  const Certified& of = GetParam();
  RunningSummary running;
  for (const double value : of.values) running.add(value);
  const Summary summary = running.summary();
  EXPECT_EQ(summary.count, of.values.size());
  EXPECT_GE(agreeing_digits(summary.mean, of.mean), 13);
  EXPECT_GE(agreeing_digits(summary.standard_deviation, of.deviation), std::min(of.digits, 12.0));
}

INSTANTIATE_TEST_SUITE_P(
    , StRD,
    testing::Values(Certified{"Michelso", strd::michelso(), 299.852400000000, 0.0790105478190518,
                              0.535199668621283, 13},
                    Certified{"Mavro", strd::mavro(), 2.00185600000000, 0.000429123454003053,
                              0.937989183438248, 12},
                    Certified{"NumAcc1", {10000001, 10000003, 10000002}, 10000002, 1, -0.5, 15},
                    Certified{"NumAcc2", strd::numacc(1.2, 1.1, 1.3), 1.2, 0.1, -0.999, 14},
                    Certified{"NumAcc3", strd::numacc(1000000.2, 1000000.1, 1000000.3), 1000000.2,
                              0.1, -0.999, 9},
                    Certified{"NumAcc4", strd::numacc(10000000.2, 10000000.1, 10000000.3),
                              10000000.2, 0.1, -0.999, 8}),
    [](const auto& i) { return std::string{i.param.name}; });

/// A file of StRD: certified values in its head, one value a line after the last line of dashes.
struct StrdFile {
  double mean = 0, deviation = 0;
  std::vector<double> values;
};
StrdFile read_strd(const std::filesystem::path& path) {
  StrdFile file;
  std::ifstream in(path);
  const auto number_after = [](const std::string& line, const char* words, double& value) {
    if (line.find(words) == std::string::npos) return;
    const auto colon = line.rfind(':');
    std::istringstream(line.substr(colon + 1)) >> value;
  };
  for (std::string line; std::getline(in, line);) {
    number_after(line, "Sample Mean", file.mean);
    number_after(line, "Sample Standard Deviation", file.deviation);
    if (line.find("----") != std::string::npos) {
      file.values.clear();
      continue;
    }
    double value = 0;
    if (std::istringstream fields(line); fields >> value) file.values.push_back(value);
  }
  return file;
}

// DRIPLINE_STRD names a folder with the files as NIST publishes them, for all sets (Lew, Lottery
// and more).
TEST(StrdFolder, EveryFileAgrees) {
  const char* folder = std::getenv("DRIPLINE_STRD");
  if (folder == nullptr) GTEST_SKIP() << "DRIPLINE_STRD is not set";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const StrdFile file = read_strd(entry.path());
    SCOPED_TRACE(entry.path().string());
    const Summary summary = summarize(file.values);
    EXPECT_GE(agreeing_digits(summary.mean, file.mean), 14);
    EXPECT_GE(agreeing_digits(summary.standard_deviation, file.deviation), 8);
  }
}

TEST(Summary, OfNothingAndOfOneValue) {
  EXPECT_EQ(summarize({}).count, 0U);
  EXPECT_EQ(summarize({}).range(), 0);
  const std::vector<double> one{4.5};
  EXPECT_EQ(summarize(one).mean, 4.5);
  EXPECT_EQ(summarize(one).standard_deviation, 0);
  EXPECT_EQ(lag_one_autocorrelation(one), 0);
}

// NIST/SEMATECH e-Handbook 7.2.6.2: twelve gauge readings, the 90th percentile is 95.1981.
TEST(Percentile, AgreesWithTheHandbook) {
  std::vector<double> values{95.1772, 95.1567, 95.1937, 95.1959, 95.1442, 95.0610,
                             95.1591, 95.1195, 95.1065, 95.0925, 95.1990, 95.1682};
  std::ranges::sort(values);
  EXPECT_NEAR(percentile(values, 0.9), 95.1981, 0.00005);
  EXPECT_EQ(percentile(values, 0.001), values.front());
  EXPECT_EQ(percentile(values, 0.999), values.back());
}

}  // namespace
}  // namespace dripline::statistics
