// The motion comparison over every golden program: with itself, and with one digit changed.
#include <gtest/gtest.h>
#include <random>

#include "clients/tools/comparison/motion_comparison.hpp"
#include "clients/tools/offline/trace_writer.hpp"
#include "tests/golden/golden_case.hpp"

namespace dripline::comparison {
namespace {

using interpreter::MemorySource;

TEST(MotionComparison, EveryGoldenProgramIsTheSameMotionAsItself) {
  int compared = 0;
  for (const auto& golden : interpreter::golden_cases()) {
    const auto found = interpreter::find_dialect(golden.control);
    if (!found) continue;  // cases of other things than programs
    const auto setup = setup_of(golden, **found);
    const std::string text = golden.program();
    MemorySource first(text, loader_of(golden)), second(text, loader_of(golden));
    const auto result = compare_motion({**found, setup, first}, {**found, setup, second});
    ASSERT_TRUE(result) << golden.file;
    EXPECT_TRUE(result->is_same) << golden.file;
    const bool has_alarm = verdict_of(golden).has_value();
    EXPECT_FALSE(has_alarm && result->is_unconditional()) << golden.file;
    ++compared;
  }
  EXPECT_GT(compared, 700);
}

/// The actions of a trace: all but what does not move the machine.
std::string actions_of(const interpreter::GoldenCase& golden, const interpreter::Dialect& control,
                       const std::string& text) {
  MemorySource source(text, loader_of(golden));
  std::string trace;
  const auto setup = setup_of(golden, control);
  {
    interpreter::TraceWriter writer([&](std::string_view lines) { trace += lines; }, setup.start);
    if (!interpreter::run_offline(control, setup, source, writer,
                                  {.max_blocks = 100'000, .max_repeated_blocks = 10'000}))
      return {};
  }
  std::string kept;
  for (std::size_t at = 0; at < trace.size();) {
    const std::size_t end = trace.find('\n', at) + 1;
    const std::string_view line(trace.data() + at, end - at);
    const bool is_move =
        line.starts_with("{\"event\":\"rapid\"") || line.starts_with("{\"event\":\"feed\"") ||
        line.starts_with("{\"event\":\"arc\"") || line.starts_with("{\"event\":\"thread\"");
    // Where its text is does not make a move another one.
    if (is_move)
      kept.append(line.substr(0, line.find("\"line\""))).append(line.substr(line.find("\"to\"")));
    at = end;
  }
  return kept;
}

/// Places of digits in words of axes.
std::vector<std::size_t> axis_digits(const std::string& text) {
  std::vector<std::size_t> places;
  bool in_word = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (std::string_view("XYZABCUVWIJKR").find(c) != std::string_view::npos)
      in_word = true;
    else if (in_word && c >= '0' && c <= '9')
      places.push_back(i);
    else if (std::string_view("+-. ").find(c) == std::string_view::npos)
      in_word = false;
  }
  return places;
}

TEST(MotionComparison, AChangedNumberThatMovesIsNeverTheSameMotion) {
  std::mt19937 random(20'240'117);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same tries each time
  const auto cases = interpreter::golden_cases();
  int changed = 0, moved = 0;
  for (int tries = 0; changed < 1000 && tries < 20'000; ++tries) {
    const auto& golden = cases[random() % cases.size()];
    const auto found = interpreter::find_dialect(golden.control);
    if (!found) continue;
    const std::string text = golden.program();
    const auto places = axis_digits(text);
    if (places.empty()) continue;
    std::string other = text;
    char& digit = other[places[random() % places.size()]];
    digit = static_cast<char>('0' + (digit - '0' + 1 + static_cast<int>(random() % 9)) % 10);
    const std::string before = actions_of(golden, **found, text);
    const std::string after = actions_of(golden, **found, other);
    if (before.empty() || after.empty()) continue;
    ++changed;
    if (before == after) continue;
    ++moved;
    const auto setup = setup_of(golden, **found);
    MemorySource first(text, loader_of(golden)), second(other, loader_of(golden));
    const auto result = compare_motion({**found, setup, first}, {**found, setup, second},
                                       {.tolerance = 0, .max_blocks = 100'000});
    ASSERT_TRUE(result) << golden.file;
    EXPECT_FALSE(result->is_same) << golden.file << "\n" << other;
  }
  EXPECT_EQ(changed, 1000);
  EXPECT_GT(moved, 600);
}

}  // namespace
}  // namespace dripline::comparison
