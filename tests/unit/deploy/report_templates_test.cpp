// The templates of deploy/templates on what simulated controls really print: the programs run on
// the interpreters of their controls, with probes on simulated workpieces.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/report_template/report_interpreter.hpp"
#include "gateway/interpreter/core/program_source.hpp"

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
    nlohmann::json at;
    using enum interpreter::Axis;
    for (const auto& [letter, axis] : {std::pair("X", X), std::pair("Y", Y), std::pair("Z", Z)})
      at[letter] = event.result->at.linear(axis).mm();
    records.push_back(
        {"probe",
         nlohmann::json{{"until", "contact"}, {"tripped", event.result->tripped}, {"at", at}}
             .dump()});
  }
  void on_alarm(const interpreter::Alarm& event) override {
    alarm = fmt::format("{} {}", event.diagnostic.id, event.diagnostic.text);
  }

  struct Record {
    std::string kind, text;
  };
  std::vector<Record> records;
  std::string alarm;
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
  ASSERT_EQ(read.values.size(), 3u);
  EXPECT_NEAR(read.value("Z1").actual, -0.75, 1e-6);
}

/// A TNC 155 prints nothing itself; later ones do, in this form.
TEST(ReportTemplates, UnderstandPrintedParametersOfATnc) {
  Recorder recorder;
  recorder.records = {{"output", "BORE 4"}, {"output", "Q20 = +49,987"}, {"output", "Q21=-0.013"}};
  const auto read = read_with("tnc-print", recorder);
  EXPECT_EQ(read.value("Q20").actual, 49.987);
  EXPECT_EQ(read.value("Q21").actual, -0.013);
}

TEST(ReportTemplates, UnderstandSurfacePoints) {
  Recorder recorder;
  recorder.records = {{"output", "START"},
                      {"output", "G800 N1 X10. Y20. Z-5. I0. J0. K1. O0. U0.05 L-0.05"},
                      {"output", "G801 N1 X10. Y20.001 Z-4.988 R3."},
                      {"output", "G802 N1 DEVIATION 0.012"}};
  const auto read = read_with("surface-inspection", recorder);
  EXPECT_EQ(read.values.size(), 4u);
  EXPECT_EQ(read.value("Z 1").actual, -4.988);
  EXPECT_EQ(read.value("deviation 1").actual, 0.012);
}

}  // namespace
}  // namespace dripline::report_template
