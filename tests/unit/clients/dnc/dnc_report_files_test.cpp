#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

/// Charts, statistics and exports of measurements in files, without a server.
class DncReportFiles : public testing::Test {
 protected:
  DncReportFiles() {
    std::string csv =
        "time,machine,run,program,part,tool,characteristic,nominal,lower,upper,unit,actual\n";
    for (int i = 0; i < 40; ++i) {
      csv += fmt::format(
          "2026-11-{:02}T08:{:02}:00Z,lathe-1,run{},O0100,{},T3,D40,40.000,39.980,40.020,mm,{:.4f}"
          "\n",
          i / 10 + 1, i, i / 10, i, 40 + 0.004 * std::sin(i * 1.9) + (i > 32 ? 0.012 : 0));
    }
    dnc.write("d40.csv", csv);
  }
  Dnc dnc{DNC_PATH};
};

TEST_F(DncReportFiles, DrawsEveryKindInEveryFormat) {
  for (const char* kind :
       {"individuals", "xbar-r", "xbar-s", "ewma", "cusum", "histogram", "trend"}) {
    for (const char* suffix : {"svg", "png", "pdf"}) {
      const std::string file = fmt::format("{}.{}", kind, suffix);
      const auto drawn = dnc({"report", "chart", kind, "d40.csv", "-o", file});
      ASSERT_EQ(drawn.status, 0) << file << drawn.err;
      const std::string bytes = dnc.read(file);
      EXPECT_TRUE(bytes.starts_with("<svg") || bytes.starts_with("\x89PNG") ||
                  bytes.starts_with("%PDF"))
          << file;
    }
    EXPECT_NE(dnc.read(fmt::format("{}.svg", kind)).find("40 values"), std::string::npos) << kind;
  }
}

TEST_F(DncReportFiles, LimitsNameTheirOrigin) {
  auto drawn = dnc({"report", "chart", "individuals", "d40.csv", "--baseline", "30", "-o", "-"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find(
                "limits computed from 30 values of runs run0 to run2, 2026-11-01 to 2026-11-03"),
            std::string::npos)
      << drawn.out;
  EXPECT_NE(drawn.out.find("beyond three sigma"), std::string::npos);
  drawn = dnc({"report", "chart", "individuals", "d40.csv", "--center", "40", "--sigma", "0.004",
               "--limits-note", "2 March, Meyer", "-o", "-"});
  EXPECT_NE(drawn.out.find("limits fixed: 2 March, Meyer"), std::string::npos);
}

TEST_F(DncReportFiles, DrawsAProfile) {
  std::string nominal, measured;
  for (int i = 0; i <= 50; ++i) {
    nominal += fmt::format("{},{}\n", i, 10 + 0.1 * i);
    measured += fmt::format("{},{:.4f}\n", i, 10 + 0.1 * i + (i == 25 ? 0.05 : 0.005));
  }
  dnc.write("nominal.csv", nominal);
  dnc.write("points.csv", measured);
  const auto drawn = dnc({"report", "chart", "profile", "points.csv", "--nominal", "nominal.csv",
                          "--lower", "-0.02", "--upper", "0.02", "--axes", "XZ", "-o", "-"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("1 points outside the limits"), std::string::npos);
}

TEST_F(DncReportFiles, RefusesWhatItCannotDraw) {
  EXPECT_EQ(dnc({"report", "chart", "pie", "d40.csv", "-o", "a.svg"}).status, 2);
  EXPECT_EQ(dnc({"report", "chart", "individuals", "d40.csv", "-o", "a.gif"}).status, 2);
  const auto none =
      dnc({"report", "chart", "individuals", "d40.csv", "--characteristic", "D50", "-o", "a.svg"});
  EXPECT_NE(none.status, 0);
  EXPECT_NE(none.err.find("a chart of no measurement"), std::string::npos) << none.err;
  EXPECT_EQ(dnc({"report", "chart", "individuals", "absent.csv", "-o", "a.svg"}).status, 2);
  EXPECT_NE(dnc({"report", "chart", "profile", "d40.csv", "-o", "a.svg"}).status, 0);
}

struct RefusedOption {
  const char* name;
  std::vector<std::string> words;
  const char* error;
};

/// Before anything is read: what an option asks for would not be in the file.
TEST_F(DncReportFiles, RefusesOptionsThatWouldBeIgnored) {
  const std::vector<RefusedOption> kRefused{
      {"title",
       {"export", "--from", "d40.csv", "--format", "dfq", "--title", "T"},
       "--title is for --format html and pdf, not dfq"},
      {"cell",
       {"export", "--from", "d40.csv", "--format", "dxf", "--cell", "2"},
       "--cell is for --format stl, not dxf"},
      {"utf8",
       {"export", "--from", "d40.csv", "--format", "qif", "--utf8"},
       "--utf8 is for --format dfq and dfd, not qif"},
      {"since",
       {"export", "latest", "--format", "csv", "--since", "2026-11-01"},
       "--since is for measurements: --format csv exports all report lines of RUN|MACHINE"},
      {"run_twice",
       {"export", "latest", "--format", "dfq", "--run", "3f"},
       "latest and --run: give RUN|MACHINE, or --run and --machine"},
      {"two_sources",
       {"export", "latest", "--from", "d40.csv", "--format", "dfq"},
       "--from and latest: the file or the server's"},
      {"lambda",
       {"chart", "cusum", "d40.csv", "--lambda", "0.3", "-o", "a.svg"},
       "--lambda is for ewma, not for cusum"},
      {"rules",
       {"chart", "histogram", "d40.csv", "--rules", "nelson", "-o", "a.svg"},
       "--rules is for individuals, xbar-r, xbar-s, ewma, cusum, not for histogram"},
      {"nominal",
       {"chart", "trend", "d40.csv", "--nominal", "n.csv", "-o", "a.svg"},
       "--nominal is for profile, not for trend"},
      {"machine",
       {"chart", "profile", "p.csv", "--machine", "lathe-1", "--nominal", "n.csv", "-o", "a.svg"},
       "it takes no --machine"}};
  for (const auto& refused : kRefused) {
    std::vector<std::string> words = refused.words;
    words.insert(words.begin(), "report");
    const auto result = dnc(words);
    EXPECT_EQ(result.status, 2) << refused.name;
    EXPECT_NE(result.err.find(refused.error), std::string::npos) << refused.name << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(dnc.folder() / "a.svg"));
}

TEST_F(DncReportFiles, RefusesNumbersThatNoPictureHolds) {
  dnc.write("large.csv", "characteristic,actual\nD12,1\nD12,1e308\nD12,2\n");
  for (const char* file : {"large.svg", "large.png"}) {
    const auto refused = dnc({"report", "chart", "individuals", "large.csv", "-o", file});
    EXPECT_NE(refused.status, 0);
    EXPECT_NE(refused.err.find("D12 2 of 3: value is 1e+308"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(dnc.folder() / file));
  }
}

/// Texts of machines are no formulas for a spreadsheet, and come back from the file.
TEST_F(DncReportFiles, ExportsCsvWithoutFormulas) {
  dnc.write("ugly.csv", "serial,characteristic,actual\n\"=1+1\",D12,-1.5\n");
  const auto csv =
      dnc({"report", "export", "--from", "ugly.csv", "--format", "measurements", "-o", "b.csv"});
  ASSERT_EQ(csv.status, 0) << csv.err;
  EXPECT_NE(dnc.read("b.csv").find(",'=1+1,,D12,,,,mm,-1.5,"), std::string::npos)
      << dnc.read("b.csv");
  const auto back = dnc({"report", "export", "--from", "b.csv", "--format", "jsonl"});
  EXPECT_EQ(json::parse(back.out).at("serial"), "=1+1");
}

TEST_F(DncReportFiles, GivesCapabilityWithIntervals) {
  const auto shown = dnc({"report", "capability", "d40.csv", "--json"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  const auto study = json::parse(shown.out);
  EXPECT_EQ(study.at("count"), 40);
  EXPECT_GT(study.at("cpk").at("value").get<double>(), 0.5);
  EXPECT_LT(study.at("cpk").at("low"), study.at("cpk").at("value"));
  EXPECT_TRUE(study.at("anderson_darling").is_object());
  const auto text = dnc({"report", "capability", "d40.csv", "--shape", "empirical"});
  EXPECT_NE(text.out.find("fewer than 741 values"), std::string::npos) << text.out << text.err;
}

TEST_F(DncReportFiles, JudgesAGauge) {
  std::string csv = "appraiser,part,value\n";
  for (const char* appraiser : {"A", "B"})
    for (int part = 1; part <= 5; ++part)
      for (int trial = 0; trial < 2; ++trial)
        csv += fmt::format("{},{},{}\n", appraiser, part, part + 0.01 * trial);
  dnc.write("study.csv", csv);
  for (const char* method : {"anova", "ranges"}) {
    const auto shown =
        dnc({"report", "gauge", "study.csv", "--method", method, "--tolerance", "1", "--json"});
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_GT(json::parse(shown.out).at("distinct_categories"), 10);
  }
  EXPECT_NE(dnc({"report", "gauge", "study.csv"}).out.find("gauge R&R"), std::string::npos);
}

TEST_F(DncReportFiles, ExportsComeBack) {
  auto done = dnc({"report", "export", "--from", "d40.csv", "--format", "dfq", "-o", "d40.dfq"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(dnc.read("d40.dfq").starts_with("K0100 1\r\n"));
  done = dnc({"report", "export", "--from", "d40.dfq", "--format", "jsonl"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(std::count(done.out.begin(), done.out.end(), '\n'), 40);
  done = dnc({"report", "export", "--from", "d40.csv", "--format", "qif", "--since", "2026-11-02"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("<MeasurementResultsSet n=\"30\">"), std::string::npos)
      << done.out.substr(0, 600);
  done = dnc({"report", "export", "--from", "d40.csv", "--format", "html", "--title", "Lot 7", "-o",
              "r.html"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(dnc.read("r.html").find("<h1>Lot 7</h1>"), std::string::npos);
}

TEST_F(DncReportFiles, RefusesExportsWithoutAnInput) {
  const auto lines = dnc({"report", "export", "--from", "d40.csv", "--format", "text"});
  EXPECT_EQ(lines.status, 2);
  EXPECT_NE(lines.err.find("RUN or MACHINE is needed"), std::string::npos) << lines.err;
  EXPECT_NE(dnc({"report", "export", "--from", "d40.csv", "--format", "stl"}).status, 0);
  EXPECT_NE(dnc({"report", "export", "--from", "d40.csv", "--format", "pdf"}).status, 0)
      << "a PDF needs a file";
}

}  // namespace
}  // namespace dripline
