#include "tests/differential/fanuc/frame_programs.hpp"

#include <fmt/format.h>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

namespace dripline::differential {
namespace {

constexpr std::array kLetters{'X', 'Y', 'Z'};
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

/// What lies between a program's coordinates and the machine, in the manual's order: mirror image,
/// scaling, rotation in XY, zero.
struct Frames {
  std::array<std::optional<double>, 3> mirror;
  bool scales = false;
  MachinePoint center{}, factor{1, 1, 1};
  bool rotates = false;
  std::array<double, 2> pivot{};
  double degrees = 0;
  MachinePoint work{}, local{}, shift{};

  bool are_plain() const { return !mirror[0] && !mirror[1] && !scales && !rotates; }
  /// Mirror image and scaling, of one axis; each is its own inverse but for the factor.
  double flat(std::size_t i, double at) const {
    if (mirror[i]) at = 2 * *mirror[i] - at;
    return scales ? center[i] + factor[i] * (at - center[i]) : at;
  }
  void turn(MachinePoint& point, double by) const {
    if (!rotates) return;
    const double c = std::cos(by * kRadiansPerDegree), s = std::sin(by * kRadiansPerDegree);
    const double x = point[0] - pivot[0], y = point[1] - pivot[1];
    point[0] = pivot[0] + c * x - s * y;
    point[1] = pivot[1] + s * x + c * y;
  }
  MachinePoint to_machine(MachinePoint point) const {
    for (std::size_t i = 0; i < 3; ++i) point[i] = flat(i, point[i]);
    turn(point, degrees);
    for (std::size_t i = 0; i < 3; ++i) point[i] += work[i] + local[i] + shift[i];
    return point;
  }
  MachinePoint to_program(MachinePoint point) const {
    for (std::size_t i = 0; i < 3; ++i) point[i] -= work[i] + local[i] + shift[i];
    turn(point, -degrees);
    for (std::size_t i = 0; i < 3; ++i) {
      if (scales) point[i] = center[i] + (point[i] - center[i]) / factor[i];
      if (mirror[i]) point[i] = 2 * *mirror[i] - point[i];
    }
    return point;
  }
  bool reverses() const {
    const auto is_turned = [this](std::size_t i) {
      return mirror[i].has_value() != (scales && factor[i] < 0);
    };
    return is_turned(0) != is_turned(1);
  }
};

class FrameMaker {
 public:
  explicit FrameMaker(std::uint64_t number) : random_(number * 104729 + 7) {}

  FrameProgram make() {
    constexpr int kParts = 30;
    line("O1\nG21 G90 G94 G17 G40 G49 G80 G54\nT1 M06\nG43 H1");
    frames_.work = {11, -5, 2};
    move_to_all();
    for (int part = 0; part < kParts; ++part) {
      if (below(3) == 0)
        change_frames();
      else
        move();
    }
    line("M30");
    return std::move(program_);
  }

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  double number(int most) {
    return (static_cast<double>(below(static_cast<std::uint64_t>(200 * most + 1))) - 100 * most) /
           100;
  }
  void line(std::string_view words) { program_.text.append(words).append("\n"); }
  static std::string word(std::size_t axis, double value) {
    return fmt::format(" {}{:.3f}", kLetters[axis], value);
  }
  void end_at(const MachinePoint& point) {
    at_ = point;
    program_.ends.push_back(point);
  }
  void set_incremental(bool is_on) {
    if (is_incremental_ != is_on) line(is_on ? "G91" : "G90");
    is_incremental_ = is_on;
  }

  /// Axes whose coordinate the change makes another one are named in the next move.
  template <class Change>
  void change(Change change) {
    const MachinePoint before = frames_.to_program(at_);
    change();
    const MachinePoint after = frames_.to_program(at_);
    for (std::size_t i = 0; i < 3; ++i) is_open_ |= std::fabs(before[i] - after[i]) > 1e-7;
  }

  void move_to_all() {
    set_incremental(false);
    MachinePoint to{};
    std::string words = "G00";
    for (std::size_t i = 0; i < 3; ++i) words += word(i, to[i] = number(40));
    line(words);
    end_at(frames_.to_machine(to));
    is_open_ = false;
  }

  void move() {
    if (is_open_) return move_to_all();
    if (below(4) == 0) return arc();
    if (below(5) == 0) return holes();
    MachinePoint to = frames_.to_program(at_);
    std::string words = below(2) == 0 ? "G00" : "G01 F300.";
    const std::uint64_t axes = 1 + below(7);
    for (std::size_t i = 0; i < 3; ++i) {
      if ((axes >> i & 1) == 0) continue;
      const double value = number(40);
      words += word(i, value);
      to[i] = is_incremental_ ? to[i] + value : value;
    }
    line(words);
    end_at(frames_.to_machine(to));
  }

  /// Half a circle: its end is known without a rounded number.
  void arc() {
    if (std::fabs(frames_.factor[0]) != std::fabs(frames_.factor[1])) return;
    MachinePoint to = frames_.to_program(at_);
    std::string words = below(2) == 0 ? "G02 F300." : "G03 F300.";
    std::string center;
    set_incremental(true);
    for (std::size_t i = 0; i < 2; ++i) {
      const double half = 2 + number(1) + static_cast<double>(i);
      words += word(i, 2 * half);
      center += fmt::format(" {}{:.3f}", i == 0 ? 'I' : 'J', half);
      to[i] += 2 * half;
    }
    line(words + center);
    end_at(frames_.to_machine(to));
  }

  /// Z is scaled nowhere; 4 down to R and 3 further, or by increments.
  void holes() {
    const bool stays_below = below(2) == 0;
    const MachinePoint start = frames_.to_program(at_);
    MachinePoint at = start;
    const double first = is_incremental_ ? -3 : start[2] - 7;
    const double retract = is_incremental_ ? -4 : start[2] - 4;
    std::string head =
        fmt::format("G{} G81 Z{:.3f} R{:.3f} F300.", stays_below ? 99 : 98, first, retract);
    for (int hole = 0; hole < 2; ++hole) {
      std::string words = std::exchange(head, {});
      for (std::size_t i = 0; i < 2; ++i) {
        const double value = number(30);
        words += word(i, value);
        at[i] = is_incremental_ ? at[i] + value : value;
      }
      line(words);
      for (const double level :
           {at[2], start[2] - 4, start[2] - 7, stays_below ? start[2] - 4 : start[2]}) {
        at[2] = level;
        if (frames_.to_machine(at) != at_) end_at(frames_.to_machine(at));
      }
    }
    line("G80");
  }

  void change_frames() {
    switch (below(6)) {
      case 0:
        return set_incremental(!is_incremental_);
      case 1:
        return change_zero();
      case 2:
        return mirror();
      case 3:
        return scale();
      case 4:
        return rotate();
      default:
        return select_system();
    }
  }

  void select_system() {
    if (!frames_.are_plain()) return;
    const bool is_first = below(2) == 0;
    line(is_first ? "G54" : "G55");
    frames_.work = is_first ? MachinePoint{11, -5, 2} : MachinePoint{-29, 40, -1};
  }

  /// G52, or G92, which ends the local zero of its axes.
  void change_zero() {
    if (!frames_.are_plain()) return;
    const bool is_local = below(2) == 0;
    if (is_local) set_incremental(false);
    std::string words = is_local ? "G52" : "G92";
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = number(20);
      words += word(i, value);
      if (!is_local) frames_.shift[i] = at_[i] - frames_.work[i] - value;
      frames_.local[i] = is_local ? value : 0;
    }
    line(words);
    if (!is_local) is_open_ = false;  // the present place has got its coordinates
  }

  void mirror() {
    if (frames_.scales || frames_.rotates) return;
    const std::size_t axis = below(2);
    const double value = number(10);
    const bool ends = frames_.mirror[axis].has_value();
    line((ends ? "G50.1" : "G51.1") + word(axis, ends ? 0 : value));
    change([&] { frames_.mirror[axis] = ends ? std::nullopt : std::optional(value); });
  }

  void scale() {
    if (frames_.rotates) return;
    if (frames_.scales) {
      line("G50");
      return change([this] {
        frames_.scales = false;
        frames_.factor = {1, 1, 1};
      });
    }
    constexpr std::array<std::array<double, 2>, 4> kFactors{{{2, 2}, {0.5, 0.5}, {1, -1}, {2, 1}}};
    const std::array<double, 2>& factors = kFactors[below(kFactors.size())];
    const MachinePoint present = frames_.to_program(at_);
    MachinePoint center{number(10), number(10), present[2]};
    line("G51" + word(0, center[0]) + word(1, center[1]) +
         fmt::format(" I{:.0f} J{:.0f} K1000", factors[0] * 1000, factors[1] * 1000));
    for (std::size_t i = 0; i < 2; ++i) center[i] = frames_.flat(i, center[i]);
    change([&] {
      frames_.scales = true;
      frames_.center = center;
      frames_.factor = {factors[0], factors[1], 1};
    });
  }

  void rotate() {
    if (is_open_) return;
    if (frames_.rotates) {
      line("G69");
      return change([this] { frames_.rotates = false; });
    }
    constexpr std::array kAngles{30.0, 90.0, -20.0, 180.0, 12.345};
    const double x = number(10), y = number(10), degrees = kAngles[below(kAngles.size())];
    line("G68" + word(0, x) + word(1, y) + fmt::format(" R{:.3f}", degrees));
    change([&] {
      frames_.pivot = {frames_.flat(0, x), frames_.flat(1, y)};
      frames_.degrees = frames_.reverses() ? -degrees : degrees;
      frames_.rotates = true;
    });
  }

  std::mt19937_64 random_;
  FrameProgram program_;
  Frames frames_;
  MachinePoint at_{0, 0, 100};
  bool is_incremental_ = false;
  bool is_open_ = false;
};

}  // namespace

FrameProgram make_frame_program(std::uint64_t number) {
  return FrameMaker(number).make();
}

}  // namespace dripline::differential
