// The templates of deploy/templates on what simulated controls really print: the programs run on
// the interpreters of their controls, with probes on simulated workpieces.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/report_template/report_interpreter.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/dds/record_text.hpp"

namespace dripline::report_template {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

std::optional<std::string> macro_text(std::string_view name) {
  const std::string path = "deploy/macros/" + std::string(name) + ".nc";
  if (!std::filesystem::exists(path)) return std::nullopt;
  return text_of(path);
}

/// What the gateway would record of a run: lines and probe results.
class Recorder final : public interpreter::EventSink {
 public:
  void on_output(const interpreter::Output& event) override {
    records.push_back({"output", std::string(event.text)});
  }
  void on_probe(const interpreter::Probe& event) override {
    if (!event.result) return;
    const dds::ProbeText text{.to = axes_of(event.to),
                              .until = std::string(interpreter::word_of(event.until)),
                              .tripped = event.result->tripped,
                              .at = axes_of(event.result->at)};
    records.push_back({"probe", dds::encode(text)});
  }
  void on_alarm(const interpreter::Alarm& event) override {
    alarm = fmt::format("{} {}", event.diagnostic.id, event.diagnostic.text);
  }

  struct Record {
    std::string kind, text;
  };
  std::vector<Record> records;
  std::string alarm;

 private:
  static std::map<char, double> axes_of(const interpreter::Position& position) {
    std::map<char, double> axes;
    for (const interpreter::Axis axis : interpreter::kAllAxes) {
      if (position.has(axis)) axes[interpreter::letter(axis)] = position.raw(axis);
    }
    return axes;
  }
};

Recorder run(const std::string& control, const std::string& setup_text, const std::string& text) {
  const auto* dialect = *interpreter::find_dialect(control);
  const auto setup = interpreter::parse_setup(setup_text, dialect->units);
  Recorder recorder;
  EXPECT_TRUE(setup) << setup.error().what;
  if (!setup) return recorder;
  interpreter::MemorySource source(text, macro_text);
  const auto outcome = interpreter::run_offline(*dialect, *setup, source, recorder);
  EXPECT_TRUE(outcome) << outcome.error().what;
  EXPECT_EQ(recorder.alarm, "");
  return recorder;
}

struct Read {
  std::vector<Value> values;
  std::vector<std::string> findings, unmatched;
  std::vector<PartSummary> parts;

  const Value& value(const std::string& name) const {
    const auto found = std::ranges::find_if(
        values, [&](const Value& one) { return one.characteristic.name == name; });
    EXPECT_NE(found, values.end()) << name;
    static const Value kNone;
    return found == values.end() ? kNone : *found;
  }
};

Read read_with(const std::string& name, const Recorder& recorder) {
  auto content = read_template(text_of("deploy/templates/" + name + ".toml"));
  EXPECT_TRUE(content) << content.error().what;
  Read read;
  if (!content) return read;
  ReportInterpreter interpreter(std::make_shared<const ReportTemplate>(*std::move(content)));
  const auto add = [&](const std::vector<ReportEvent>& events) {
    for (const auto& event : events) {
      if (const auto* value = std::get_if<Value>(&event)) read.values.push_back(*value);
      if (const auto* finding = std::get_if<Finding>(&event))
        read.findings.push_back(finding->text);
      if (const auto* ended = std::get_if<PartEnded>(&event)) read.parts.push_back(ended->part);
    }
  };
  for (const auto& record : recorder.records) {
    const ReportLine line{.text = record.text, .kind = record.kind};
    const auto taken = interpreter.take(line);
    add(taken.events);
    if (interpreter.is_for(line) && !taken.is_understood) read.unmatched.push_back(record.text);
  }
  add(interpreter.end());
  EXPECT_EQ(read.unmatched, std::vector<std::string>{});
  return read;
}

constexpr double kBall = 3;
const std::string kProbing = fmt::format("[[variable]]\nname = \"#520\"\nvalue = {:.1f}\n", kBall);

std::string probing(const std::string& start, const std::string& surface) {
  return "start = " + start + "\n" + kProbing + "[probe]\nsurface = [ " + surface + " ]\n";
}
std::string with_macro(const std::string& blocks) {
  return "%\nO0001\nG21G90G40G49G80\nPOPEN\n" + blocks + "\nPCLOS\nM30\n%\n";
}

TEST(ReportTemplates, AreAllGood) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("deploy/templates")) {
    if (entry.path().extension() != ".toml") continue;
    const auto read = read_template(text_of(entry.path()));
    EXPECT_TRUE(read) << entry.path() << ": " << read.error().what;
    ++count;
  }
  EXPECT_GE(count, 7u);
}

TEST(ReportTemplates, UnderstandASurfaceOfTheMacros) {
  const auto recorder =
      run("fanuc", probing("{ X = 10.0, Y = 4.0, Z = -2.0 }", "{ axis = \"X\", at = 22.012 }"),
          with_macro("G65P9711X25.S7.H.02"));
  const auto read = read_with("dripline-macros", recorder);
  ASSERT_EQ(read.values.size(), 1u);
  EXPECT_NEAR(read.value("X7").actual, 25.012, 0.0015);
  EXPECT_EQ(read.value("X7").verdict, measurement::Verdict::Good);
}

TEST(ReportTemplates, UnderstandABoreOfTheMacros) {
  const std::string bore =
      "{ cylinder = { center = { X = 80.018, Y = 44.973 }, radius = 17.0155 } }";
  const auto recorder = run("fanuc", probing("{ X = 80.0, Y = 45.0, Z = 10.0 }", bore),
                            with_macro("G65P9712D40.Z-8.S12.H.02"));
  const auto read = read_with("dripline-macros", recorder);
  ASSERT_EQ(read.values.size(), 3u);
  const Value& diameter = read.value("D12");
  EXPECT_NEAR(diameter.actual, 40.031, 0.0015);
  EXPECT_EQ(diameter.characteristic.nominal, 40.0);
  EXPECT_NEAR(*diameter.characteristic.upper, 40.02, 1e-9);
  EXPECT_EQ(diameter.characteristic.decimals, 3);
  EXPECT_EQ(diameter.verdict, measurement::Verdict::Scrap);
  EXPECT_EQ(read.value("X12").verdict, measurement::Verdict::Good);
  EXPECT_EQ(read.value("Y12").verdict, measurement::Verdict::Scrap);
  ASSERT_EQ(read.parts.size(), 1u);
  EXPECT_EQ(read.parts[0].verdict, measurement::Verdict::Scrap);
}

/// TOL 0.000 is what the macros print of no tolerance: it is not one of 0.
TEST(ReportTemplates, GiveNoLimitsToAMacroWithoutATolerance) {
  const auto recorder = run("fanuc",
                            probing("{ X = 10.0, Y = 20.0, Z = -2.0 }",
                                    "{ axis = \"X\", at = 17.1 }, { axis = \"Y\", at = 27.2 }"),
                            with_macro("G65P9715X20.Y30.I10.J10.S9."));
  const auto read = read_with("dripline-macros", recorder);
  ASSERT_EQ(read.values.size(), 3u);
  EXPECT_FALSE(read.value("X9").characteristic.upper);
  EXPECT_EQ(read.value("X9").verdict, measurement::Verdict::Unknown);
  EXPECT_EQ(read.value("X9").characteristic.unit, "mm");
  EXPECT_EQ(read.value("A9").characteristic.unit, "deg");
  ASSERT_EQ(read.parts.size(), 1u);
  EXPECT_EQ(read.parts[0].verdict, measurement::Verdict::Unknown);
}

TEST(ReportTemplates, KnowTheInchesOfTheMacros) {
  const auto recorder =
      run("fanuc", probing("{ X = 10.0, Y = 4.0, Z = -2.0 }", "{ axis = \"X\", at = 22.41 }"),
          "%\nO0001\nG20G90G40G49G80\nPOPEN\nG65P9711X1.S7.H.002\nPCLOS\nM30\n%\n");
  const auto read = read_with("dripline-macros", recorder);
  ASSERT_EQ(read.values.size(), 1u);
  const Value& face = read.value("X7");
  EXPECT_NEAR(face.actual, 25.41 / 25.4, 1e-4);
  EXPECT_EQ(face.characteristic.unit, "inch");
  EXPECT_EQ(face.characteristic.decimals, 4);
  EXPECT_NEAR(*face.characteristic.upper, 1.002, 1e-9);
  EXPECT_EQ(face.verdict, measurement::Verdict::Good);
}

TEST(ReportTemplates, UnderstandProbeRecordsOfACenturion) {
  const auto recorder = run("centurion", "[probe]\nsurface = [ { axis = \"Z\", at = -1.25 } ]\n",
                            "G0 X1.3 Z0\nPROBE1 G1 G98 F.5 X1.3 Z-2\nM30\n");
  const auto read = read_with("probe-records", recorder);
  EXPECT_NEAR(read.value("Z1").actual, -1.25 * 25.4, 1e-6);  // a program in inches
}

TEST(ReportTemplates, UnderstandADigitizedProfile) {
  const auto recorder = run("centurion",
                            "answers = [\"2.0\", \"1.0\", \"0.1\"]\n[probe]\nsurface = [ { profile "
                            "= [ [0, -0.2], [0.6, -0.3], [1.2, -0.1] ] } ]\n",
                            text_of("deploy/examples/digitize.nc"));
  const auto read = read_with("centurion-digitizing", recorder);
  EXPECT_GE(read.values.size(), 20u);
  EXPECT_EQ(read.values[0].characteristic.name, "X");
  EXPECT_EQ(read.values[1].characteristic.name, "Z");
  EXPECT_NEAR(read.values[0].actual, 2.0, 1e-3);
  EXPECT_EQ(read.values[0].characteristic.decimals, 4);
}

TEST(ReportTemplates, UnderstandAnInspectionOfACenturion) {
  // Radii of 10.01 and 14.9 mm: the second diameter is too small, which cannot be turned again.
  const auto recorder = run("centurion",
                            "units = \"mm\"\n[probe]\nsurface = [ { profile = [ [0, -0.5], "
                            "[10.01, -0.5], [10.01, -9.9], [14.9, -10], [14.9, -40] ] } ]\n",
                            text_of("deploy/examples/inspection.nc"));
  const auto read = read_with("centurion-inspection", recorder);
  ASSERT_EQ(read.values.size(), 2u) << fmt::format("{}", fmt::join(read.findings, "; "));
  EXPECT_NEAR(read.value("D1").actual, 20.02, 2e-3);
  EXPECT_EQ(read.value("D1").verdict, measurement::Verdict::Good);
  EXPECT_EQ(read.value("D2").verdict, measurement::Verdict::Scrap);
  ASSERT_EQ(read.parts.size(), 1u);
  EXPECT_EQ(read.parts[0].verdict, measurement::Verdict::Scrap);
  EXPECT_TRUE(read.findings.empty());
}

/// The program alarms after its first line: what came of the part does not make it good.
TEST(ReportTemplates, MissTheEndOfAnInspection) {
  Recorder recorder;
  recorder.records = {{"output", "PART 77"}, {"output", "1 D 20.000 NOM 20.000 TOL .050"}};
  const auto read = read_with("centurion-inspection", recorder);
  EXPECT_EQ(read.value("D1").verdict, measurement::Verdict::Good);
  ASSERT_EQ(read.parts.size(), 1u);
  EXPECT_EQ(read.parts[0].verdict, measurement::Verdict::Unknown);
  EXPECT_EQ(read.findings,
            (std::vector<std::string>{"the part's end did not come: the report ended"}));
}

TEST(ReportTemplates, UnderstandTheTouchProbeOfATnc) {
  const auto recorder =
      run("tnc155", "start = { Z = 60.0 }\n[probe]\nsurface = [ { axis = \"Z\", at = -0.75 } ]\n",
          "0 BEGIN PGM 7 MM\n1 TOOL DEF 9 L+0,000 R+2,000\n2 TOOL CALL 9 Z S1\n"
          "3 TCH PROBE 0.0 REF. PLANE Q5 Z-\n"
          "4 TCH PROBE 0.1 X+10,000 Y+20,000 Z+0,000\n5 END PGM 7 MM\n");
  const auto read = read_with("tnc-probe", recorder);
  ASSERT_EQ(read.values.size(), 1u) << "X and Y were not probed";
  const Value& face = read.value("Z1");
  EXPECT_NEAR(face.actual, -0.75, 1e-6);
  EXPECT_EQ(face.characteristic.unit, "mm");
  EXPECT_EQ(face.characteristic.decimals, 3);
  EXPECT_EQ(face.verdict, measurement::Verdict::Unknown) << "no limits are invented";
}

/// Across the tool the record has the center of the ball, in machine coordinates; the second
/// contact is number 2.
TEST(ReportTemplates, NumberTheTouchesOfATncAndNameTheProbedAxis) {
  const auto recorder =
      run("tnc155", "start = { Z = 60.0 }\n[probe]\nsurface = [ { axis = \"X\", at = 69.5 } ]\n",
          "0 BEGIN PGM 7 MM\n1 TOOL DEF 9 L+0,000 R+2,000\n2 TOOL CALL 9 Z S1\n"
          "3 CYCL DEF 7.0 DATUM SHIFT\n4 CYCL DEF 7.1 X+100,000\n"
          "5 TCH PROBE 0.0 REF. PLANE Q10 X+\n6 TCH PROBE 0.1 X-30,000 Y+5,000 Z-4,000\n"
          "7 TCH PROBE 0.0 REF. PLANE Q11 X+\n8 TCH PROBE 0.1 X-30,000 Y+9,000 Z-4,000\n"
          "9 END PGM 7 MM\n");
  const auto read = read_with("tnc-probe", recorder);
  ASSERT_EQ(read.values.size(), 2u);
  EXPECT_NEAR(read.value("X1").actual, 69.5, 1e-6);
  EXPECT_NEAR(read.value("X2").actual, 69.5, 1e-6);
}

/// As every probe template: a move without contact keeps its number, or the next values would get
/// the names of others.
TEST(ReportTemplates, CountAMoveThatTouchedNothing) {
  for (const char* name : {"tnc-probe", "probe-records"}) {
    Recorder recorder;
    const dds::ProbeText missed{
        .to = {{'Z', -9}}, .until = "contact", .tripped = false, .at = {{'Z', -9}}};
    const dds::ProbeText touched{
        .to = {{'Z', -9}}, .until = "contact", .tripped = true, .at = {{'Z', -1.5}}};
    for (const auto& text : {missed, touched}) recorder.records.push_back({"probe", encode(text)});
    const auto read = read_with(name, recorder);
    ASSERT_EQ(read.values.size(), 1u) << name;
    EXPECT_EQ(read.value("Z2").actual, -1.5) << name;
  }
}

/// A TNC 155 prints nothing itself; TNC 426 and later do. Example of FN 16: F-PRINT in HEIDENHAIN's
/// user's manuals (TNC 426/430, "Output of formatted texts and Q parameter values"), and the same
/// with a comma.
TEST(ReportTemplates, UnderstandPrintedValuesOfATnc) {
  Recorder recorder;
  for (const char* line :
       {"MEASURING LOG OF IMPELLER CENTER OF GRAVITY", "DATE: 27-11-2001", "TIME: 08:56:34",
        "NO. OF MEASURED VALUES : = 1", "*******************************************",
        "X1 =   149.360", "Y1 =   -25,509", "", "Z1=+37.000"})
    recorder.records.push_back({"output", line});
  const auto read = read_with("tnc-print", recorder);
  ASSERT_EQ(read.values.size(), 3u);
  EXPECT_EQ(read.value("X1").actual, 149.36);
  EXPECT_EQ(read.value("Y1").actual, -25.509);
  EXPECT_EQ(read.value("Z1").actual, 37);
  EXPECT_EQ(read.value("X1").characteristic.decimals, 3);
  EXPECT_EQ(read.value("X1").verdict, measurement::Verdict::Unknown) << "no limits are invented";
}

/// What is no value is none: a count, a feed; what is garbled is listed.
TEST(ReportTemplates, TakeNoOtherNumbersOfATncForValues) {
  Recorder recorder;
  recorder.records = {{"output", "DATUM = 27.11.2001"}, {"output", "PARTS = 12"}};
  EXPECT_TRUE(read_with("tnc-print", recorder).values.empty());
  const auto content = read_template(text_of("deploy/templates/tnc-print.toml"));
  ASSERT_TRUE(content);
  ReportInterpreter interpreter(std::make_shared<const ReportTemplate>(*content));
  for (const char* line : {"X1 = 149.3X0", "X1   149.360", "BORE 4", "X1 = 149.360 X2 = 7.000"})
    EXPECT_FALSE(interpreter.take({.text = line}).is_understood) << line;
}

/// Points as a post prints them with DPRNT on a Fanuc-class control, here by our own: the first is
/// within its limits, the second is not, and material is left.
TEST(ReportTemplates, UnderstandSurfacePoints) {
  const auto recorder = run(
      "fanuc",
      "start = { X = 0.0, Y = 0.0, Z = 10.0 }\n[probe]\nsurface = [ { profile = [ [0, -4.988], "
      "[15, -4.988], [15.001, -4.9], [30, -4.9] ] } ]\n",
      "%\nO0002\nG21G90G40G49G80\nPOPEN\nDPRNT[START]\n#1=1\nWHILE[#1LE2]DO1\n#24=10*#1\n"
      "G0X#24Y20.\nG31Z-8.F100\n#4=#5063+5.\n"
      "DPRNT[G800*N#1[40]*X#24[44]*Y20.0000*Z-5.0000*I0.*J0.*K1.*O0.*U0.05*L-0.05]\n"
      "DPRNT[G801*N#1[40]*X#5061[44]*Y#5062[44]*Z#5063[44]*R3.]\n"
      "DPRNT[G802*N#1[40]*DEVIATION*#4[44]]\nG0Z10.\n#1=#1+1\nEND1\nDPRNT[END]\nPCLOS\nM30\n%\n");
  const auto read = read_with("surface-inspection", recorder);
  EXPECT_EQ(read.findings, std::vector<std::string>{});
  ASSERT_EQ(read.values.size(), 8u);
  EXPECT_NEAR(read.value("Z 1").actual, -4.988, 1e-4);
  EXPECT_EQ(read.value("Z 1").characteristic.nominal, -5.0);
  EXPECT_EQ(read.value("Z 1").verdict, measurement::Verdict::Unknown);
  const Value& first = read.value("deviation 1");
  EXPECT_NEAR(first.actual, 0.012, 1e-4);
  EXPECT_EQ(first.characteristic.upper, 0.05);
  EXPECT_EQ(first.characteristic.lower, -0.05);
  EXPECT_EQ(first.characteristic.nominal, 0.0);
  EXPECT_EQ(first.verdict, measurement::Verdict::Good);
  EXPECT_EQ(read.value("deviation 2").verdict, measurement::Verdict::Rework);
  ASSERT_EQ(read.parts.size(), 1u);
  EXPECT_EQ(read.parts[0].verdict, measurement::Verdict::Rework);
}

}  // namespace
}  // namespace dripline::report_template
