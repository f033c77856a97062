#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/machine/capability_filter.hpp"
#include "tests/integration/linuxcnc/linuxcnc_itself.hpp"
#include "tests/integration/linuxcnc/linuxcnc_shop.hpp"

namespace dripline::integration {

using Point = std::array<double, 3>;

inline double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// What our interpreter makes of a program, as short straight pieces.
class Path final : public interpreter::EventSink {
 public:
  /// Of the tool, in the moves that follow: the axes are at position + length.
  void set_lengths(const machine::ToolLengths& lengths) { lengths_ = lengths; }

  void on_rapid(const interpreter::Rapid& event) override { to(point_of(event.to)); }
  void on_line(const interpreter::Line& event) override { to(point_of(event.to)); }
  void on_arc(const interpreter::Arc& event) override {
    const auto axes = interpreter::axes_of(event.plane);
    const auto first = static_cast<std::size_t>(axes.first);
    const auto second = static_cast<std::size_t>(axes.second);
    const Point from = points_.back(), end = point_of(event.to);
    const Point center{event.center_first.mm() + lengths_[first],
                       event.center_second.mm() + lengths_[second], 0};
    const double x = from[first] - center[0], y = from[second] - center[1];
    const double turn = event.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
    const int pieces = 1 + static_cast<int>(event.sweep.degrees());
    for (int i = 1; i < pieces; ++i) {
      const double part = static_cast<double>(i) / pieces;
      const double angle = turn * event.sweep.radians() * part;
      Point point;
      for (std::size_t k = 0; k < 3; ++k) point[k] = from[k] + (end[k] - from[k]) * part;
      point[first] = center[0] + x * std::cos(angle) - y * std::sin(angle);
      point[second] = center[1] + x * std::sin(angle) + y * std::cos(angle);
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
  /// An axis that the program has not moved stays.
  Point point_of(const interpreter::Position& to) const {
    Point point = points_.back();
    for (std::size_t i = 0; i < point.size(); ++i)
      if (const auto axis = static_cast<interpreter::Axis>(i); to.has(axis))
        point[i] = to.raw(axis) + lengths_[i];
    return point;
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
  machine::ToolLengths lengths_{};
  std::vector<Point> points_{Point{}};
};

/// Whether one sample that is 0.05 mm beside its place is noticed: along an axis, of which the path
/// may go along one, and by chance pass on another.
inline bool notices_a_twentieth(const Path& path, const std::vector<LinuxCnc::Sample>& samples) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto changed = samples;
    changed[samples.size() / 2].at[axis] += 0.05;
    if (!path.difference(changed).empty()) return true;
  }
  return false;
}

/// Executes programs by our interpreter with LinuxCNC's motion.
class LinuxCncPrograms : public LinuxCncTest {
 protected:
  std::unique_ptr<interpreter::Interpreter> interpret(interpreter::MemorySource& source,
                                                      interpreter::EventSink& events) const {
    auto made = interpreter::kRs274NgcDialect.make(
        interpreter::parse_setup(head + "[control]\nprofile = \"linuxcnc\"\n" + tools).value(),
        source, events);
    EXPECT_TRUE(made) << made.error().what;
    return made ? *std::move(made) : nullptr;
  }
  void run(const std::string& text) {
    begin();
    interpreter::MemorySource source(text);
    std::unique_ptr<interpreter::Interpreter> interpreter;
    machine::CapabilityFilter filter(
        machine->capabilities(), machine->events(),
        [&] {
          return machine::CapabilityFilter::Now{interpreter->modes(), interpreter->origin().block};
        },
        {.shifts = true, .is_certain = true, .set = [&](const machine::ToolLengths& lengths) {
           machine->set_lengths(lengths);
         }});
    filter.begin(machine->status().position, {});
    interpreter = interpret(source, filter);
    ASSERT_NE(interpreter, nullptr);
    bool is_read = false;
    ASSERT_TRUE(wait([&] {
      while (!is_read && machine->has_room()) {
        const auto state = interpreter->step(1);
        if (state == interpreter::StepState::NeedsAnswer && !answer(*interpreter)) break;
        is_read =
            state != interpreter::StepState::Ran && state != interpreter::StepState::NeedsAnswer;
      }
      return is_over();
    }));
    EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
    runs = false;
  }
  std::vector<LinuxCnc::Sample> path_of(const std::function<void()>& execute) {
    linuxcnc->reset();
    execute();
    // Its task may get no processor for a while, and the axes wait for it then.
    constexpr std::chrono::seconds kRest{1};
    EXPECT_TRUE(test_support::eventually([&] { return linuxcnc->rests(kRest); }));
    return linuxcnc->samples();
  }

  /// The state of an input or a pin, once everything before it is executed.
  bool answer(interpreter::Interpreter& interpreter) {
    if (!machine->drained() || machine->state() != MachineState::Idle) return false;
    if (const auto* asked = std::get_if<interpreter::SignalQuestion>(&interpreter.question())) {
      const auto value = machine->signal(asked->name);
      return value && interpreter.answer(*value).has_value();
    }
    const auto asked = std::get<interpreter::InputQuestion>(interpreter.question());
    return interpreter.answer(machine->input(asked.pin)).has_value();
  }

  std::string head, tools;  ///< of our interpreter's setup, TOML
};

}  // namespace dripline::integration
