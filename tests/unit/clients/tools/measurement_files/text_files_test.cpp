#include "clients/tools/measurement_files/text_files.hpp"

#include <gtest/gtest.h>

#include "tests/unit/clients/tools/measurement_files/sample.hpp"

namespace dripline::measurement_files {
namespace {

using measurement::Measurement;

std::vector<Measurement> read(std::string_view file) {
  std::vector<Measurement> all;
  const auto done = read_measurements(file, [&](const Measurement& m) -> Result<void> {
    all.push_back(m);
    return {};
  });
  EXPECT_TRUE(done) << done.error().what;
  return all;
}

void expect_same(const Measurement& a, const Measurement& b) {
  EXPECT_EQ(a.machine, b.machine);
  EXPECT_EQ(a.run, b.run);
  EXPECT_EQ(a.program, b.program);
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(a.part, b.part);
  EXPECT_EQ(a.serial, b.serial);
  EXPECT_EQ(a.tool, b.tool);
  EXPECT_EQ(a.characteristic.name, b.characteristic.name);
  EXPECT_EQ(a.characteristic.nominal, b.characteristic.nominal);
  EXPECT_EQ(a.characteristic.lower, b.characteristic.lower);
  EXPECT_EQ(a.characteristic.upper, b.characteristic.upper);
  EXPECT_EQ(a.actual, b.actual);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.record, b.record);
  EXPECT_EQ(a.item, b.item);
  EXPECT_EQ(a.verdict, b.verdict);
}

TEST(TextFiles, BothFormsComeBackAsTheyWere) {
  for (const auto write : {write_csv, write_json_lines}) {
    CountingSource source(sample());
    const std::string file = written([&](const Sink& sink) { return write(source, sink); });
    EXPECT_EQ(source.passes, 1);
    const auto all = read(file);
    ASSERT_EQ(all.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) expect_same(all[i], sample()[i]);
  }
}

TEST(TextFiles, CsvHasTheReportsDecimalsAndQuotes) {
  ListSource source(sample());
  const std::string file = written([&](const Sink& sink) { return write_csv(source, sink); });
  EXPECT_NE(file.find(",40.000,39.980,40.020,mm,40.0125,0.0125,good,0,0,1,17,0\r\n"),
            std::string::npos)
      << file;
  EXPECT_NE(file.find("\"S-0007 <\"\"\xC3\x9C\"\">, \xE2\x82\xAC\""), std::string::npos);
  EXPECT_NE(file.find(",-0.0000001,"), std::string::npos);  // no exponent
}

// A machine prints what it likes: a spreadsheet must not calculate with it, and it comes back as it
// was printed. JSON has no formulas.
TEST(TextFiles, FormulasOfMachinesAreTextsAndComeBack) {
  auto all = sample();
  all.resize(1);
  Measurement& one = all.front();
  one.program = "=HYPERLINK(\"http://x\")";
  one.run = "a;=1;b \"c\"";
  one.serial = "-0042-A";
  one.part = "'=7";
  one.tool = "@T3";
  one.characteristic.name = "\t+cmd|' /C calc'!A0";
  one.actual = -40.25;
  ListSource source(all);
  const std::string csv = written([&](const Sink& sink) { return write_csv(source, sink); });
  EXPECT_NE(csv.find(",\"'=HYPERLINK(\"\"http://x\"\")\",3,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",''=7,'-0042-A,'@T3,\"'\t'+cmd|' /C calc'!A0\","), std::string::npos) << csv;
  EXPECT_NE(csv.find(",\"a;'=1;b \"\"c\"\"\","), std::string::npos) << csv;
  EXPECT_NE(csv.find(",-40.250,-80.250,"), std::string::npos) << "numbers stay numbers";
  const std::string lines =
      written([&](const Sink& sink) { return write_json_lines(source, sink); });
  EXPECT_NE(lines.find("\"serial\":\"-0042-A\""), std::string::npos) << lines;
  for (const std::string& file : {csv, lines}) {
    const auto back = read(file);
    ASSERT_EQ(back.size(), 1U);
    expect_same(back.front(), one);
  }
}

TEST(TextFiles, ReadsTablesOfOthers) {
  const auto all = read(
      "\xEF\xBB\xBFpart;value;characteristic;lower;upper\r\n1;40.01;D;39.98;40.02\r\n\r\n2;40.03;D;"
      "39.98;40.02");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].actual, 40.01);
  EXPECT_EQ(all[0].characteristic.decimals, 2);
  EXPECT_EQ(all[0].verdict, measurement::Verdict::Good);
  EXPECT_EQ(all[1].verdict, measurement::Verdict::Scrap);
  EXPECT_EQ(all[1].part, "2");
  EXPECT_TRUE(read("").empty());
  EXPECT_EQ(read("{\"actual\": 1.25}\n\n{\"value\": 2, \"part\": 7}").size(), 2U);
}

struct BadCase {
  const char* name;
  const char* text;
  const char* error;
};
class BadText : public testing::TestWithParam<BadCase> {};
TEST_P(BadText, IsRefusedWithItsLine) {
  const auto done =
      read_measurements(GetParam().text, [](const Measurement&) -> Result<void> { return {}; });
  ASSERT_FALSE(done);
  if (GetParam().error != nullptr) {
    EXPECT_EQ(done.error().what, GetParam().error);
  }
  EXPECT_TRUE(done.error().what.starts_with("line ")) << done.error().what;
}
INSTANTIATE_TEST_SUITE_P(
    , BadText,
    testing::Values(
        BadCase{"no_value_column", "part,size\n1,2\n", "line 1: no column 'actual' or 'value'"},
        BadCase{"no_number", "actual\n4,0\nx\n", "line 3: actual 'x' is no number"},
        BadCase{"not_finite", "actual\ninf\n", "line 2: actual 'inf' is no number"},
        BadCase{"open_quote", "actual,part\n1,\"a\n", "line 2: a quote is not closed"},
        BadCase{"no_object", "{\"actual\": 1}\n[1]\n", "line 2: no JSON object"},
        BadCase{"json_without_value", "{\"part\": \"1\"}", "line 1: there is no actual value"},
        BadCase{"json_kind", "{\"actual\": \"1\"}", "line 1: actual is no number"},
        BadCase{"verdict", "actual,verdict\n1,fine\n",
                "line 2: 'fine' is no verdict: good, unknown, rework, scrap"},
        BadCase{"time", "actual,time\n1,yesterday\n", nullptr},
        BadCase{"count", "actual,block\n1,-3\n", "line 2: block -3 is no count"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(Measurements, KeepEachDigitOfAnEpoch) {
  for (const char* text : {"actual,epoch,number,block\n1,2350215653993889616,3,4.0\n",
                           "{\"actual\": 1, \"epoch\": 2350215653993889616, \"number\": 3, "
                           "\"block\": 4.0}\n"}) {
    const auto all = read(text);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].record.epoch, 2350215653993889616U);
    EXPECT_EQ(all[0].record.number, 3u);
    EXPECT_EQ(all[0].block, 4u);
  }
}

TEST(DecimalText, IsAsShortAsItCanBe) {
  EXPECT_EQ(decimal_text(40, 3), "40.000");
  EXPECT_EQ(decimal_text(40.0125, 3), "40.0125");
  EXPECT_EQ(decimal_text(0.1 + 0.2, 2), "0.30000000000000004");
  EXPECT_EQ(decimal_text(-1e-7, 0), "-0.0000001");
  EXPECT_EQ(std::stod(decimal_text(1.5e-300, 3)), 1.5e-300);
}

TEST(Windows1252, ComesBack) {
  const std::string text = "\xC3\x98 40 \xE2\x82\xAC \xC3\x9F";
  EXPECT_EQ(to_windows_1252(text), "\xD8 40 \x80 \xDF");
  EXPECT_EQ(from_windows_1252(to_windows_1252(text)), text);
  EXPECT_EQ(to_windows_1252("\xE4\xB8\xAD\xFF"), "??");
  EXPECT_EQ(to_windows_1252("\xC0\x8A"), "??") << "a line end in disguise";
}

}  // namespace
}  // namespace dripline::measurement_files
