#include "clients/tools/measurement_files/aqdef.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <limits>
#include <sstream>

#include "tests/unit/clients/tools/measurement_files/sample.hpp"

namespace dripline::measurement_files {
namespace {

using measurement::Measurement;

std::string dfq(const std::vector<Measurement>& all, AqdefProfile profile = {}) {
  ListSource source(all);
  return written([&](const Sink& sink) { return write_dfq(source, profile, sink); });
}

TEST(Aqdef, HasTheFieldsOfTheFormat) {
  const std::string file = dfq(sample());
  EXPECT_TRUE(file.starts_with(
      "K0100 2\r\nK1001/1 O0100\r\nK1002/1 O0100\r\nK1082/1 lathe-1\r\nK2001/1 1\r\nK2002/1 "
      "Diameter \xD8"
      "40\r\nK2004/1 0\r\nK2022/1 3\r\nK2101/1 40.000\r\nK2110/1 39.980\r\nK2111/1 "
      "40.020\r\nK2142/1 mm\r\n"))
      << file;
  EXPECT_NE(
      file.find("K0001/1 40.0125\r\nK0002/1 0\r\nK0004/1 24.11.2026/06:00:00\r\nK0014/1 S-0007 "),
      std::string::npos)
      << file;
  EXPECT_EQ(file.find("K2110/2"), std::string::npos);  // no lower limit
}

TEST(Aqdef, FieldsAscendInEachBlock) {
  std::istringstream lines(dfq(sample()));
  std::string before, line;
  while (std::getline(lines, line)) {
    const std::string key = line.substr(0, 5), number = line.substr(5, line.find(' ') - 5);
    const bool is_new_block =
        key.substr(0, 3) != before.substr(0, 3) || key == "K0001" || key == "K2001";
    if (!is_new_block) {
      EXPECT_LT(before, key) << line;
    }
    before = key;
  }
}

void expect_same_values(const std::vector<Measurement>& got, bool has_ident) {
  ASSERT_EQ(got.size(), 3U);
  auto expected = sample();
  const auto by_value = [](const Measurement& a, const Measurement& b) {
    return a.actual < b.actual;
  };
  std::ranges::sort(expected, by_value);
  auto sorted = got;
  std::ranges::sort(sorted, by_value);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sorted[i].actual, expected[i].actual);
    EXPECT_EQ(sorted[i].machine, "lathe-1");
    EXPECT_EQ(sorted[i].program, "O0100");
    EXPECT_EQ(sorted[i].time, expected[i].time);
    EXPECT_EQ(sorted[i].characteristic, expected[i].characteristic);
    if (has_ident) {
      EXPECT_EQ(sorted[i].serial, expected[i].serial);
    }
  }
}

TEST(Aqdef, DfqComesBack) {
  for (const auto encoding : {AqdefEncoding::Windows1252, AqdefEncoding::Utf8}) {
    const auto read = read_aqdef(dfq(sample(), {encoding}), {encoding});
    ASSERT_TRUE(read) << read.error().what;
    expect_same_values(*read, true);
  }
}

TEST(Aqdef, WritesNothingElseForWhatTheCodePageDoesNotHave) {
  auto all = sample();
  all.back().serial = "\xCE\xA9\xE4\xB8\xAD 7";
  ListSource source(all);
  const Sink none = [](std::string_view) -> Result<void> {
    ADD_FAILURE() << "something was written";
    return {};
  };
  const auto refused = write_dfq(source, {}, none);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("has 2 characters that Windows-1252 does not have"),
            std::string::npos)
      << refused.error().what;
  EXPECT_NE(dfq(all, {AqdefEncoding::Utf8}).find(all.back().serial), std::string::npos);
}

TEST(Aqdef, DfdAndDfxTogetherComeBack) {
  ListSource source(sample());
  const std::string head = written([&](const Sink& sink) { return write_dfd(source, {}, sink); });
  const std::string values = written([&](const Sink& sink) { return write_dfx(source, {}, sink); });
  EXPECT_EQ(std::ranges::count(values, '\n'), 2);  // two workpieces
  EXPECT_NE(values.find("\x0F"
                        "0\x14"
                        "256\r\n"),
            std::string::npos);  // the length that was not measured
  const auto read = read_aqdef(head + values, {});
  ASSERT_TRUE(read) << read.error().what;
  expect_same_values(*read, false);
}

TEST(Aqdef, ChangedLimitsAreAnotherCharacteristicAndAnotherMachineAnotherPart) {
  auto all = sample();
  all[2].characteristic.upper = 40.05;
  all.push_back(all[0]);
  all.back().machine = "lathe-2";
  const std::string file = dfq(all);
  EXPECT_TRUE(file.starts_with("K0100 4\r\n"));
  EXPECT_NE(file.find("K1082/2 lathe-2\r\n"), std::string::npos);
  const auto read = read_aqdef(file, {});
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->size(), 4U);
  EXPECT_EQ(read->back().machine, "lathe-2");
}

TEST(Aqdef, NoTextOfAReportMakesAField) {
  auto all = sample();
  all[0].serial = "x\r\nK0001/1 99";
  const auto read = read_aqdef(dfq(all), {});
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->size(), 3U);
  EXPECT_EQ(read->front().serial, "x  K0001/1 99");
}

// The form in which the K fields of each characteristic are followed by its own values, in a file
// with three parts.
TEST(Aqdef, ReadsValuesBehindEachCharacteristic) {
  const auto read = read_aqdef(
      "K0100 2\nK1000/1 1\nK1001/1 A-1\nK1082/1 mill\nK2000/1 1\nK2001/1 d1\nK2101/1 1.5\nK2110/1 "
      "1.0\nK2111/1 2.0\n"
      "K0001/1 1.6\nK0004/1 01.01.2013/15:18:31\nK0001/1 1.7\nK0004/1 02.01.2013/15:18:31\nK1001/2 "
      "A-2\nK2001/2 d2\n"
      "K0001/2 3.1\nK0004/2 01.01.2013/15:18:31\nK0002/2 256\n",
      {});
  ASSERT_TRUE(read) << read.error().what;
  ASSERT_EQ(read->size(), 2U);  // the third is marked as not valid
  EXPECT_EQ((*read)[0].characteristic.name, "d1");
  EXPECT_EQ(to_iso8601((*read)[1].time), "2013-01-02T15:18:31.000000Z");
}

TEST(Aqdef, RefusesWithTheLine) {
  const auto error_of = [](std::string_view text) {
    const auto read = read_aqdef(text, {});
    return read ? std::string("read") : read.error().what;
  };
  EXPECT_EQ(error_of("K0100 1\r\nK0001/1 4\r\n"),
            "line 2: K0001/1: there is no such characteristic");
  EXPECT_EQ(error_of("K2001/1 a\nK0001/1 x\n"), "line 2: 'x' is no value");
  EXPECT_EQ(error_of("K2001/1 a\nK0004/1 01.01.2026/00:00:00\n"),
            "line 2: K0004/1 before its value");
  EXPECT_EQ(error_of("Kx\n"), "line 1: 'Kx' is no field");
  EXPECT_EQ(error_of("K2001/1 a\n1\x0F"
                     "2\n"),
            "line 2: a value for characteristic 2, which is not there");
  EXPECT_EQ(error_of("K2001/99999999 a\n"),
            "line 1: K2001/99999999: a number up to 10000 is expected");
  auto all = sample();
  all[0].actual = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(dfq(all),
            "error: machine lathe-1, Diameter \xC3\x98"
            "40: a value that is not finite");
}

TEST(Aqdef, OfNothingIsAnError) {
  ListSource source({});
  for (const auto write : {write_dfq, write_dfd, write_dfx}) {
    EXPECT_EQ(written([&](const Sink& sink) { return write(source, {}, sink); }),
              "error: AQDEF of no measurement");
  }
}

}  // namespace
}  // namespace dripline::measurement_files
