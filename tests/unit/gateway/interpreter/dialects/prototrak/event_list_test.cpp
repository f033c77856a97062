#include <fmt/core.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/golden/golden_case.hpp"

/// The stored program sent back. Rows: PT-04, PT-35.
namespace dripline::interpreter {
namespace {

const Dialect& control() {
  return **find_dialect("prototrak-plus");
}

/// Where the tool goes and when it waits, to a hundredth of a millimeter, without places in the
/// text.
class Motion final : public EventSink {
 public:
  void on_rapid(const Rapid& event) override { add("rapid", event.to); }
  void on_line(const Line& event) override { add("line", event.to); }
  void on_arc(const Arc& event) override { add("arc", event.to); }
  void on_stop(const Stop&) override { lines.emplace_back("stop"); }
  void on_tool(const ToolChange& event) override {
    lines.push_back(fmt::format("tool {}", event.number));
  }
  std::vector<std::string> lines;

 private:
  void add(const char* kind, const Position& to) {
    lines.push_back(fmt::format("{} {:.2f} {:.2f}", kind, to.linear(Axis::X).mm() + 1e-6,
                                to.linear(Axis::Y).mm() + 1e-6));
  }
};

std::vector<std::string> motion(const std::string& text) {
  MemorySource source(text);
  Motion sink;
  auto interpreter = control().make(Setup{}, source, sink);
  while ((*interpreter)->step(100) == StepState::Ran) {
  }
  return sink.lines;
}

TEST(EventList, SentBackAndReceivedAgainIsTheSameProgram) {
  int programs = 0;
  std::size_t moves = 0;
  for (const GoldenCase& golden : golden_cases("prototrak-plus")) {
    const std::string text = golden.program();
    const auto list = control().list(text);
    if (!list) continue;  // refused programs have nothing to send
    ++programs;
    const auto again = control().list(*list);
    ASSERT_TRUE(again) << golden.name << ": " << again.error().what;
    EXPECT_EQ(*again, *list) << golden.name;
    EXPECT_EQ(motion(*list), motion(text)) << golden.name;
    moves += motion(text).size();
  }
  EXPECT_GT(programs, 20);
  EXPECT_GT(moves, 200U);
}

TEST(EventList, ConvertsAFanucProgramToEvents) {
  const auto list =
      control().list("%:X;\nN1 G00 X1. Y2. T3;\nN2 G01 X2.5 F125;\nN3 G03 X3.5 Y3. I0 J1.;\n%");
  ASSERT_TRUE(list) << list.error().what;
  EXPECT_EQ(*list,
            "PN0 G20 ;\r\n"
            "N001 G100 X1.A Y2.A T3 ;\r\n"
            "N002 G101 XB1.A YB2.A XE2.5A YE2.A F12.5 TC0 D0. CR0. T3 ;\r\n"
            "N003 G103 XB2.5A YB2.A XE3.5A YE3.A XC2.5A YC3.A F12.5 TC0 D0. CR- T3 ;\r\n"
            "%\r\n");
}

TEST(EventList, SaysWhyAProgramIsRefused) {
  const auto list = control().list("PN1 G20 ;\nG104 XC0 YC0 R1. ;\n%");
  ASSERT_FALSE(list);
  EXPECT_EQ(list.error().what, "line 2: PTK0108 required word is missing: HL");
}

}  // namespace
}  // namespace dripline::interpreter
