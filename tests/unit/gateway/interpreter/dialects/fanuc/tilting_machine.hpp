#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"

/// Five-axis machines as the tests compute them: by homogeneous coordinates, link by link, with
/// nothing of the interpreter's own kinematics.
namespace dripline::interpreter::fanuc {

using Vector = std::array<double, 3>;
/// Of positions and directions that should be the same.
inline constexpr double kClose = 1e-6;

/// 4x4, row by row.
struct Link {
  std::array<double, 16> at{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

  static Link shift(double x, double y, double z) {
    Link link;
    link.at[3] = x;
    link.at[7] = y;
    link.at[11] = z;
    return link;
  }
  /// About the axis of X, Y or Z (0, 1, 2).
  static Link turn(int axis, double degrees) {
    const double radians = degrees * std::acos(-1.0) / 180;
    const double c = std::cos(radians), s = std::sin(radians);
    if (axis == 0) return {{1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1}};
    if (axis == 1) return {{c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, 0, 0, 0, 1}};
    return {{c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
  }
  friend Link operator*(const Link& a, const Link& b) {
    Link product;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) sum += a.at[4 * row + k] * b.at[4 * k + column];
        product.at[4 * row + column] = sum;
      }
    }
    return product;
  }
  Vector operator()(const Vector& p) const {
    return {at[0] * p[0] + at[1] * p[1] + at[2] * p[2] + at[3],
            at[4] * p[0] + at[5] * p[1] + at[6] * p[2] + at[7],
            at[8] * p[0] + at[9] * p[1] + at[10] * p[2] + at[11]};
  }
  /// Of a rigid motion, solved by its columns.
  Link inverse() const {
    Link back;
    for (int row = 0; row < 3; ++row) {
      double shift = 0;
      for (int column = 0; column < 3; ++column) {
        back.at[4 * row + column] = at[4 * column + row];
        shift -= at[4 * column + row] * at[4 * column + 3];
      }
      back.at[4 * row + 3] = shift;
    }
    return back;
  }
};

inline Link turn_about(int axis, double degrees, const Vector& center) {
  return Link::shift(center[0], center[1], center[2]) * Link::turn(axis, degrees) *
         Link::shift(-center[0], -center[1], -center[2]);
}

/// What a test knows of a machine: its setup, and how its axes move table and tool.
struct TestMachine {
  std::string name;
  std::string control;  ///< the lines of [control]
  Axis master = Axis::A;
  Axis slave = Axis::C;

  /// From workpiece at zero to where the table is.
  Link (*table)(double master, double slave);
  /// From a tool that points down at zero, as seen from the gauge point.
  Link (*head)(double master, double slave);

  /// The tip on the workpiece, in machine coordinates with the table at 0.
  Vector tip(const Position& at, double length) const {
    const double m = at.raw(master), s = at.raw(slave);
    const Vector tip = head(m, s)({0, 0, -length});
    const Vector in_machine{at.raw(Axis::X) + tip[0], at.raw(Axis::Y) + tip[1],
                            at.raw(Axis::Z) + length + tip[2]};
    return table(m, s).inverse()(in_machine);
  }
  /// Of the tool, from the tip up, on the workpiece.
  Vector direction(const Position& at) const {
    const double m = at.raw(master), s = at.raw(slave);
    const auto on_table = [&](const Vector& p) { return table(m, s).inverse()(head(m, s)(p)); };
    const Vector zero = on_table({0, 0, 0}), up = on_table({0, 0, 1});
    return {up[0] - zero[0], up[1] - zero[1], up[2] - zero[2]};
  }
};

inline Link still(double, double) {
  return {};
}

/// A trunnion: C on A, with axes that do not meet. Tables turn against their positive direction,
/// as a table must for the tool to go around in positive direction the workpiece.
inline const TestMachine kTrunnion{
    "trunnion",
    "kinematics = \"table-table\"\nrotary_master = \"A-\"\nrotary_slave = \"C-\"\n"
    "table_centers = [ { Y = 5.0, Z = -40.0 }, { X = 12.0, Y = 8.0 } ]\n",
    Axis::A,
    Axis::C,
    [](double a, double c) {
      return turn_about(0, -a, {0, 5, -40}) * turn_about(2, -c, {12, 8, 0});
    },
    still};
/// The head about B, the table about C.
inline const TestMachine kMixed{
    "mixed",
    "kinematics = \"head-table\"\nrotary_master = \"B+\"\nrotary_slave = \"C+\"\n"
    "table_centers = [ { X = -20.0, Y = 30.0 } ]\nhead_centers = [ { X = 3.0, Z = 150.0 } ]\n",
    Axis::B,
    Axis::C,
    [](double, double c) {
      return turn_about(2, c, {-20, 30, 0});
    },
    [](double b, double) {
      return turn_about(1, b, {3, 0, 150});
    }};
/// A fork: A on C.
inline const TestMachine kFork{
    "fork",
    "kinematics = \"head-head\"\nrotary_master = \"C+\"\nrotary_slave = \"A+\"\n"
    "head_centers = [ { X = 2.0, Y = -1.5 }, { Y = 4.0, Z = 180.0 } ]\n",
    Axis::C,
    Axis::A,
    still,
    [](double c, double a) {
      return turn_about(2, c, {2, -1.5, 0}) * turn_about(0, a, {0, 4, 180});
    }};

/// Where the machine's axes have been, and what else came out.
class MachineLog final : public EventSink {
 public:
  struct Move {
    char kind = 'L';  ///< R, L, A, T
    Position from, to;
    Feed feed;
    bool rests = false;
    Arc arc = {};
    std::uint64_t line = 0;
  };
  std::vector<Move> moves;
  std::string alarm;
  std::uint64_t alarm_line = 0;
  std::vector<std::string> printed;

  void on_rapid(const Rapid& e) override { add({'R', {}, e.to, {}, e.rests, {}, e.origin.line}); }
  void on_line(const Line& e) override { add({'L', {}, e.to, e.feed, e.rests, {}, e.origin.line}); }
  void on_arc(const Arc& e) override { add({'A', {}, e.to, e.feed, e.rests, e, e.origin.line}); }
  void on_thread(const Thread& e) override { add({'T', {}, e.to, {}, false, {}, e.origin.line}); }
  void on_output(const Output& e) override { printed.emplace_back(e.text); }
  void on_alarm(const Alarm& e) override {
    alarm = std::string(e.diagnostic.id) + " " + e.diagnostic.text;
    alarm_line = e.diagnostic.line;
  }

  const Position& at() const { return at_; }
  std::vector<Move> of_line(std::uint64_t line) const {
    std::vector<Move> found;
    for (const Move& move : moves) {
      if (move.line == line) found.push_back(move);
    }
    return found;
  }

 private:
  void add(Move move) {
    move.from = at_;
    moves.push_back(move);
    at_ = move.to;
  }
  Position at_;
};

/// Runs the whole program.
inline MachineLog run_on(const TestMachine& machine, const std::string& program,
                         const std::string& more_control = {}, const std::string& tables = {}) {
  const auto setup =
      parse_setup("[control]\nmodel = \"30i\"\n" + machine.control + more_control + "\n" + tables);
  MachineLog log;
  if (!setup) {
    log.alarm = setup.error().what;
    return log;
  }
  MemorySource source(program);
  auto made = kFanucDialect.make(*setup, source, log);
  if (!made) {
    log.alarm = made.error().what;
    return log;
  }
  (*made)->step(100'000);
  return log;
}

inline Vector linear(const Position& at) {
  return {at.raw(Axis::X), at.raw(Axis::Y), at.raw(Axis::Z)};
}
inline double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace dripline::interpreter::fanuc
