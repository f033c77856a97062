#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>

#include "clients/tools/offline/offline_run.hpp"
#include "tests/golden/golden_case.hpp"

namespace dripline::interpreter {
namespace {

class Report final : public EventSink {
 public:
  void on_output(const Output& event) override {
    if (event.device == OutputDevice::File) lines.emplace_back(event.text);
  }
  std::vector<std::string> lines;
};

/// The golden case's profile passes through the points that the control's manual prints for its
/// digitizing program; the report must have its 525 moves with exactly those figures.
TEST(DigitizedProgram, HasTheMovesOfTheManual) {
  const GoldenCase golden = read_golden_case("centurion", "digitize");
  const Dialect& dialect = **find_dialect("centurion");
  const std::string program = golden.program();
  MemorySource source(program);
  Report report;
  ASSERT_TRUE(run_offline(dialect, setup_of(golden, dialect), source, report));
  ASSERT_EQ(report.lines.size(), 10U + 525U + 5U);
  const std::vector<std::string> moves(report.lines.begin() + 10, report.lines.end() - 5);
  EXPECT_EQ(moves[0], "G1 X16.4856Z-0.1214");
  EXPECT_EQ(moves[1], "G1 X16.4656Z-0.0931");
  EXPECT_EQ(moves[4], "G1 X16.4056Z-0.0500");
  EXPECT_EQ(moves[7], "G1 X16.3456Z-0.0246");
  EXPECT_EQ(moves[518], "G1 X6.1256Z-0.3276");
  EXPECT_EQ(moves[524], "G1 X6.0056Z-0.3172");
  EXPECT_EQ(report.lines[535], "G0R.1AB0");
  EXPECT_EQ(report.lines.back(), "X16.4856");
}

}  // namespace
}  // namespace dripline::interpreter
