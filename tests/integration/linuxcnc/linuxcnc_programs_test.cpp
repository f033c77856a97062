// Generated programs: LinuxCNC by itself, and our interpreter with LinuxCNC's motion, both execute
// the path that our interpreter makes of the text. DRIPLINE_PROGRAMS changes how many.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/integration/linuxcnc/linuxcnc_itself.hpp"
#include "tests/integration/linuxcnc/linuxcnc_shop.hpp"

namespace dripline::integration {
namespace {

using interpreter::StepState;
using Point = std::array<double, 3>;

int programs() {
  const char* wanted = std::getenv("DRIPLINE_PROGRAMS");
  return wanted != nullptr ? std::atoi(wanted) : 6;
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// What our interpreter makes of a program, as short straight pieces.
class Path final : public interpreter::EventSink {
 public:
  void on_rapid(const interpreter::Rapid& event) override { to(point_of(event.to)); }
  void on_line(const interpreter::Line& event) override { to(point_of(event.to)); }
  void on_arc(const interpreter::Arc& event) override {
    const auto axes = interpreter::axes_of(event.plane);
    const auto first = static_cast<std::size_t>(axes.first);
    const auto second = static_cast<std::size_t>(axes.second);
    const Point from = points_.back(), end = point_of(event.to);
    const double x = from[first] - event.center_first.mm();
    const double y = from[second] - event.center_second.mm();
    const double turn = event.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
    const int pieces = 1 + static_cast<int>(event.sweep.degrees());
    for (int i = 1; i < pieces; ++i) {
      const double part = static_cast<double>(i) / pieces;
      const double angle = turn * event.sweep.radians() * part;
      Point point;
      for (std::size_t k = 0; k < 3; ++k) point[k] = from[k] + (end[k] - from[k]) * part;
      point[first] = event.center_first.mm() + x * std::cos(angle) - y * std::sin(angle);
      point[second] = event.center_second.mm() + x * std::sin(angle) + y * std::cos(angle);
      to(point);
    }
    to(end);
  }
  void on_alarm(const interpreter::Alarm& event) override { alarm = event.diagnostic.text; }

  /// Where the axes were, sample by sample, is this path from its beginning to its end: "" or what
  /// is not.
  std::string difference(const std::vector<LinuxCnc::Sample>& samples) const {
    constexpr double kOff = 0.02;  ///< of the path: the chords of an arc are within it
    constexpr double kStep = 0.6;  ///< along the path, between two samples, and more
    std::size_t piece = 0;
    double part = 0;
    Point before{};
    for (const auto& sample : samples) {
      // On a busy computer the witness leaves samples out, and the axes are farther on.
      double left = kStep + 3 * distance(before, sample.at), nearest = kOff;
      before = sample.at;
      std::optional<std::pair<std::size_t, double>> found;
      for (std::size_t i = piece; i + 1 < points_.size() && left > 0; ++i) {
        const double length = distance(points_[i], points_[i + 1]);
        const double from = i == piece ? part : 0;
        const double at = std::max(from, nearest_part(i, sample.at));
        const double off = distance(point_at(i, at), sample.at);
        if (off < nearest - 1e-4) nearest = off, found = {i, at};
        left -= length * (1 - from);
      }
      if (!found)
        return fmt::format("{:.3f} {:.3f} {:.3f} is not on the path after {:.3f} {:.3f} {:.3f}",
                           sample.at[0], sample.at[1], sample.at[2], points_[piece][0],
                           points_[piece][1], points_[piece][2]);
      std::tie(piece, part) = *found;
    }
    double left = distance(point_at(piece, part), points_[piece + 1]);
    for (std::size_t i = piece + 1; i + 1 < points_.size(); ++i)
      left += distance(points_[i], points_[i + 1]);
    return left < kOff ? "" : fmt::format("the last {:.3f} mm were not executed", left);
  }

  std::string alarm;

 private:
  static Point point_of(const interpreter::Position& to) {
    return {to.raw(interpreter::Axis::X), to.raw(interpreter::Axis::Y),
            to.raw(interpreter::Axis::Z)};
  }
  void to(const Point& point) {
    if (distance(points_.back(), point) > 1e-9) points_.push_back(point);
  }
  Point point_at(std::size_t i, double part) const {
    Point point;
    for (std::size_t k = 0; k < 3; ++k)
      point[k] = points_[i][k] + (points_[i + 1][k] - points_[i][k]) * part;
    return point;
  }
  double nearest_part(std::size_t i, const Point& at) const {
    double along = 0, square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double travel = points_[i + 1][k] - points_[i][k];
      along += travel * (at[k] - points_[i][k]);
      square += travel * travel;
    }
    return std::clamp(along / square, 0.0, 1.0);
  }
  std::vector<Point> points_{Point{}};
};

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

class LinuxCncPrograms : public LinuxCncTest {
 protected:
  static std::unique_ptr<interpreter::Interpreter> interpret(interpreter::MemorySource& source,
                                                             interpreter::EventSink& events) {
    const auto dialect = interpreter::find_dialect("rs274ngc");
    interpreter::Setup setup;
    setup.control.set("profile", {std::string("linuxcnc"), 0});
    auto made = (*dialect)->make(setup, source, events);
    EXPECT_TRUE(made) << made.error().what;
    return made ? *std::move(made) : nullptr;
  }
  void run(const std::string& text) {
    begin();
    interpreter::MemorySource source(text);
    const auto interpreter = interpret(source, machine->events());
    ASSERT_NE(interpreter, nullptr);
    bool is_read = false;
    ASSERT_TRUE(wait([&] {
      while (!is_read && machine->has_room()) is_read = interpreter->step(1) != StepState::Ran;
      return is_over();
    }));
    EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
    runs = false;
  }
  std::vector<LinuxCnc::Sample> path_of(const std::function<void()>& execute) {
    linuxcnc->reset();
    execute();
    EXPECT_TRUE(test_support::eventually([&] { return linuxcnc->rests(); }));
    return linuxcnc->samples();
  }
};

/// Whether one sample that is 0.05 mm beside its place is noticed: along an axis, of which the path
/// may go along one, and by chance pass on another.
bool notices_a_twentieth(const Path& path, const std::vector<LinuxCnc::Sample>& samples) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto changed = samples;
    changed[samples.size() / 2].at[axis] += 0.05;
    if (!path.difference(changed).empty()) return true;
  }
  return false;
}

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
