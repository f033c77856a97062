// Generated programs: LinuxCNC by itself, and our interpreter with LinuxCNC's motion, both execute
// the path that our interpreter makes of the text. DRIPLINE_PROGRAMS changes how many.
#include <gtest/gtest.h>
#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/integration/linuxcnc/linuxcnc_itself.hpp"
#include "tests/integration/linuxcnc/program_path.hpp"

namespace dripline::integration {
namespace {

using interpreter::StepState;

int programs() {
  const char* wanted = std::getenv("DRIPLINE_PROGRAMS");
  return wanted != nullptr ? std::atoi(wanted) : 6;
}

/// A program of some blocks near the origin, in exact path mode, that comes back to it.
class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) {}

  std::string program() {
    const bool is_inch = below(4) == 0;
    scale_ = is_inch ? 1 / 25.4 : 1;
    // The feed in a block of its own: in one with G20 LinuxCNC takes it in the units before.
    text_ = fmt::format("{} G90 G17 G94 G40 G49 G80 G61 G98\nF{:.3f}\n", is_inch ? "G20" : "G21",
                        (7000 + below(4000)) * scale_);
    for (int i = 0; i < 7; ++i) part();
    return text_ + "G90 G17 G0 X0 Y0 Z0\nM2\n";
  }

 private:
  int below(int limit) { return std::uniform_int_distribution<>(0, limit - 1)(random_); }
  /// A whole number of hundredths of a millimeter, as it is written.
  double between(double low, double high) {
    return std::round(std::uniform_real_distribution<>(low, high)(random_) * 100) / 100 * scale_;
  }
  void line(const std::string& text) { text_ += text + "\n"; }
  std::string xyz() {
    return fmt::format("X{:.5f} Y{:.5f} Z{:.5f}", between(-10, 10), between(-10, 10),
                       between(-5, 5));
  }
  void part() {
    switch (below(9)) {
      case 0:
        return line("G0 " + xyz());
      case 1:
        return line("G1 " + xyz());
      case 2:
        return arc();
      case 3:
        return line(fmt::format("G91 G1 X{:.5f} Y{:.5f}\nG90", between(-6, 6), between(-6, 6)));
      case 4:
        return line(fmt::format("G0 Z{:.5f}\n{} G81 X{:.5f} Y{:.5f} Z{:.5f} R{:.5f}\nX{:.5f}\nG80",
                                between(4, 6), below(2) == 0 ? "G98" : "G99", between(-9, 9),
                                between(-9, 9), between(-4, -1), between(1, 3), between(10, 14)));
      case 5:
        return line(fmt::format("G0 Z{:.5f}\nG83 X{:.5f} Y{:.5f} Z{:.5f} R{:.5f} Q{:.5f}\nG80",
                                between(4, 6), between(-9, 9), between(-9, 9), between(-4, -1),
                                between(1, 3), between(0.8, 2)));
      case 6:
        return loop();
      case 7:
        return line(
            fmt::format("#1={:.5f}\n#2=[#1*0.5-COS[30]*{:.5f}]\nG1 X#1 Y#2 Z[SQRT[ABS[#2]]]",
                        between(-9, 9), between(1, 3)));
      default:
        return subprogram();
    }
  }
  /// About a center, in any plane, with a helix and more than a turn now and then.
  void arc() {
    struct Words {
      const char *plane, *first, *second, *third, *center_first, *center_second;
    };
    static constexpr std::array<Words, 3> kPlanes{Words{"G17", "X", "Y", "Z", "I", "J"},
                                                  Words{"G18", "Z", "X", "Y", "K", "I"},
                                                  Words{"G19", "Y", "Z", "X", "J", "K"}};
    const Words& words = kPlanes[static_cast<std::size_t>(below(3))];
    const double radius = between(1, 8), start = below(360), sweep = 10 + below(340);
    const double first = between(-5, 5), second = between(-4, 4);
    const bool is_clockwise = below(2) == 0;
    const auto at = [&](double center, double angle, bool is_first) {
      const double radians = angle * Angle::kPi / 180;
      return center + radius * (is_first ? std::cos(radians) : std::sin(radians));
    };
    const double end = is_clockwise ? start - sweep : start + sweep;
    line(fmt::format("{} G1 {}{:.8f} {}{:.8f}", words.plane, words.first, at(first, start, true),
                     words.second, at(second, start, false)));
    std::string text = fmt::format(
        "{} {}{:.8f} {}{:.8f} {}{:.8f} {}{:.8f}", is_clockwise ? "G2" : "G3", words.first,
        at(first, end, true), words.second, at(second, end, false), words.center_first,
        first - at(first, start, true), words.center_second, second - at(second, start, false));
    if (below(3) == 0) text += fmt::format(" {}{:.5f}", words.third, between(-4, 4));
    if (below(5) == 0) text += " P2";
    line(text + "\nG17");
  }
  void loop() {
    const int label = ++label_;
    line(
        fmt::format("#3=0\no{} while [#3 LT {}]\n#3=[#3+1]\nG1 X[#3*{:.5f}] Y[{:.5f}*SIN[#3*70]]\n"
                    "o{} endwhile",
                    label, 2 + below(4), between(0.5, 2), between(3, 9), label));
  }
  void subprogram() {
    const int label = ++label_;
    line(
        fmt::format("o{} sub\nG1 X#1 Y[#2/2]\nG2 X#1 Y[#2/2] I{:.5f}\no{} endsub\n"
                    "o{} call [{:.5f}] [{:.5f}]",
                    label, between(1, 4), label, label, between(-9, 9), between(-9, 9)));
  }

  std::mt19937_64 random_;
  double scale_ = 1;
  int label_ = 100;
  std::string text_;
};

TEST_F(LinuxCncPrograms, AreOnePathForBothInterpreters) {
  LinuxCncItself itself(linuxcnc->ini());
  int executed = 0;
  for (int i = 0; i < programs() && !HasFailure(); ++i) {
    const std::string text = Maker(20'261'123 + static_cast<std::uint64_t>(i)).program();
    SCOPED_TRACE(fmt::format("program {}:\n{}", i, text));
    Path path;
    interpreter::MemorySource source(text);
    const auto ours = interpret(source, path);
    ASSERT_NE(ours, nullptr);
    while (ours->step(1) == StepState::Ran) {
    }
    ASSERT_EQ(path.alarm, "");
    auto samples = path_of([&] { itself.run(text); });
    EXPECT_EQ(path.difference(samples), "") << "LinuxCNC by itself";
    EXPECT_EQ(path.difference(path_of([&] { run(text); })), "") << "our interpreter";
    ++executed;
    EXPECT_TRUE(notices_a_twentieth(path, samples));
    samples.resize(samples.size() / 2);
    EXPECT_NE(path.difference(samples), "") << "and half a program";
  }
  std::printf("%d programs\n", executed);
}

}  // namespace
}  // namespace dripline::integration
