#include <gtest/gtest.h>

#include "clients/tools/comparison/motion_comparison.hpp"
#include "tests/golden/golden_case.hpp"
#include "tests/unit/clients/tools/post/converted.hpp"

/// One part in several dialects: golden cases that have each other's motion.
namespace dripline::post {
namespace {

using interpreter::GoldenCase;

constexpr unsigned kXyz = 0b111, kXz = 0b101;

struct Part {
  GoldenCase golden;
  const interpreter::Dialect& dialect;
  interpreter::Setup setup;
  std::string text;
};

Part part(std::string_view control, std::string_view name) {
  GoldenCase golden = interpreter::read_golden_case(control, name);
  const auto& dialect = **interpreter::find_dialect(control);
  auto setup = setup_of(golden, dialect);
  std::string text = golden.program();
  return {std::move(golden), dialect, std::move(setup), std::move(text)};
}

/// Without what belongs to a target and not to the program.
comparison::ComparisonStage view(const Part& part) {
  const Target& target = **find_target(part.dialect.name);
  return [&target](interpreter::EventSink& out, const interpreter::Position& start) {
    return std::make_unique<TargetView>(out, target, start);
  };
}

void expect_written(const Part& source, const Part& target) {
  ConversionOptions options;
  options.target_setup = target.setup;
  const auto converted =
      convert({source.dialect.name, source.text, source.setup}, target.dialect.name, options);
  EXPECT_TRUE(converted.is_proved) << target.dialect.name << ": " << converted.reason();
  std::string text = converted.text;
  std::erase(text, '\r');  // golden cases have none
  EXPECT_EQ(text, target.text) << target.dialect.name;
}

/// `axes`: those that both have.
void expect_same_motion(const Part& a, const Part& b, unsigned axes) {
  interpreter::MemorySource first(a.text), second(b.text);
  const auto result = comparison::compare_motion(
      {a.dialect, a.setup, first, view(a)}, {b.dialect, b.setup, second, view(b)},
      {.tolerance = 0.001, .across_controls = true, .started_axes = axes});
  ASSERT_TRUE(result) << result.error().what;
  EXPECT_TRUE(result->is_unconditional())
      << a.dialect.name << ' ' << b.dialect.name
      << (result->places.empty()
              ? ""
              : ": " + result->places[0].first_text + " | " + result->places[0].second_text);
  EXPECT_GT(result->first_actions, 25u);
}

TEST(Part, CoverInFiveDialects) {
  std::vector<Part> parts;
  for (const char* control : {"tnc155", "fanuc", "itnc", "rs274ngc", "tektronix-1704"})
    parts.push_back(part(control, "part-cover"));
  for (std::size_t i = 1; i < parts.size(); ++i) expect_written(parts[0], parts[i]);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size(); ++j) expect_same_motion(parts[i], parts[j], kXyz);
  }
}

/// The cover moves Z with X and Y in its first block.
TEST(Part, CoverIsNoneOfTwoAxes) {
  const Part cover = part("tnc155", "part-cover");
  const auto converted = convert({"tnc155", cover.text, cover.setup}, "prototrak-plus");
  EXPECT_EQ(converted.reason(),
            "line 3: rapid move of Z together with X or Y: Z of prototrak-plus is the operator's");
}

TEST(Part, PlateInThreeDialects) {
  const Part fanuc = part("fanuc", "part-plate"), itnc = part("itnc", "part-plate");
  const Part events = part("prototrak-plus", "part-plate");
  expect_written(fanuc, itnc);
  expect_written(fanuc, events);
  expect_written(itnc, events);
}

TEST(Part, PinInTwoDialects) {
  const Part centurion = part("centurion", "part-pin"), fanuc = part("fanuc-t", "part-pin");
  expect_written(centurion, fanuc);
  expect_same_motion(centurion, fanuc, kXz);
}

/// Written back, the text of each control is what it was.
TEST(Part, TheWrittenProgramIsAFixedPoint) {
  for (const char* control : {"fanuc", "itnc", "rs274ngc"}) {
    const Part written = part(control, "part-cover");
    expect_written(written, written);
  }
}

}  // namespace
}  // namespace dripline::post
