#include "clients/tools/graphics/cutting_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::graphics {
namespace {

using interpreter::Axis;

/// An arc is cut along chords that leave it by no more than this part of a cell.
constexpr double kSagitta = 0.25;
constexpr int kMaxChords = 4096;

int chords_of(double radius, double sweep_radians, double cell) {
  const double sagitta = std::min(kSagitta * cell, radius);
  if (!(radius > 0) || !(sagitta > 0)) return 1;
  const double step = 2 * std::acos(1 - sagitta / radius);
  return static_cast<int>(std::clamp(std::ceil(sweep_radians / step), 1.0, double{kMaxChords}));
}

}  // namespace

WorkFrame WorkFrame::of(Axis spindle) {
  const interpreter::PlaneAxes axes = axes_of(interpreter::plane_across(spindle));
  return {axes.first, axes.second, axes.normal};
}

FramePoint WorkFrame::point(const interpreter::Position& position) const {
  return {position.linear(first).mm(), position.linear(second).mm(), position.linear(along).mm()};
}

CuttingSimulation::CuttingSimulation(SimulationSettings settings)
    : settings_(std::move(settings)), at_(settings_.start) {
  if (settings_.blank) begin(*settings_.blank, settings_.spindle.value_or(Axis::Z));
}

void CuttingSimulation::begin(const Cuboid& blank, Axis spindle) {
  frame_ = WorkFrame::of(spindle);
  blank_ = blank;
  auto made = HeightField::make(settings_.detail.value_or(blank), settings_.cells_along);
  if (made) {
    part_.emplace(std::move(*made));
  } else {
    failure_ = made.error();
  }
}

/// A second blank in a program changes nothing, nor does any when the user gave one.
void CuttingSimulation::on_blank(const interpreter::Blank& event) {
  if (blank_) return;
  const Axis spindle = settings_.spindle.value_or(event.spindle_axis);
  const WorkFrame frame = WorkFrame::of(spindle);
  begin({frame.point(event.min), frame.point(event.max)}, spindle);
}

void CuttingSimulation::on_tool(const interpreter::ToolChange& event) {
  if (event.is_preselection) return;
  radius_.reset();
  is_across_ = false;
  if (event.number == 0) return;
  if (settings_.tool_radius) radius_ = settings_.tool_radius->mm();
  const auto known =
      std::ranges::find(settings_.tools, event.number, &interpreter::ToolRecord::number);
  if (known != settings_.tools.end()) radius_ = (known->radius + known->radius_wear).mm();
  if (event.shape) radius_ = event.shape->radius.mm();
}

void CuttingSimulation::on_rapid(const interpreter::Rapid& event) {
  move(event.origin, event.to);
}
void CuttingSimulation::on_line(const interpreter::Line& event) {
  move(event.origin, event.to);
}
void CuttingSimulation::on_thread(const interpreter::Thread& event) {
  move(event.origin, event.to);
}
/// A probe's ball cuts nothing.
void CuttingSimulation::on_probe(const interpreter::Probe& event) {
  if (event.result) at_ = event.result->at;
}

/// The control reports where its graphics show nothing; a blank of the user has the user's axis.
void CuttingSimulation::on_warning(const interpreter::Warning& event) {
  if (event.diagnostic.id == "TNC-GRAPHICS" && !settings_.blank) is_across_ = true;
  if (event.diagnostic.id == "TNC-GRAPHICS-AGAIN") is_across_ = false;
}

void CuttingSimulation::on_block_end(const interpreter::Origin& event) {
  constexpr std::uint64_t kBlocksBetween = 64;
  if (event.block % kBlocksBetween == 0 && settings_.on_progress) settings_.on_progress(event);
}

void CuttingSimulation::move(const interpreter::Origin& origin, const interpreter::Position& to) {
  if (can_show(origin, to)) cut(frame_.point(at_), frame_.point(to));
  at_ = to;
}

void CuttingSimulation::on_arc(const interpreter::Arc& event) {
  const interpreter::PlaneAxes axes = axes_of(event.plane);
  const double height = event.to.raw(axes.normal) - at_.raw(axes.normal);
  const bool is_helix = height != 0;
  if (!can_show(event.origin, event.to)) {
    at_ = event.to;
    return;
  }
  if (is_helix && !settings_.shows_helices) {
    omit(event.origin, Omission::Helix);
    at_ = event.to;
    return;
  }
  const double center[2] = {event.center_first.mm(), event.center_second.mm()};
  const double first = at_.raw(axes.first) - center[0], second = at_.raw(axes.second) - center[1];
  const double radius = std::hypot(first, second);
  const double sweep = event.sweep.radians();
  const double begin = std::atan2(second, first);
  const double turn = event.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
  const int chords = chords_of(radius, sweep, part_->cell());
  interpreter::Position from = at_;
  for (int i = 1; i <= chords; ++i) {
    const double part = static_cast<double>(i) / chords;
    interpreter::Position to = event.to;
    if (i < chords) {
      const double angle = begin + turn * sweep * part;
      to.set_raw(axes.first, center[0] + radius * std::cos(angle));
      to.set_raw(axes.second, center[1] + radius * std::sin(angle));
      to.set_raw(axes.normal, at_.raw(axes.normal) + height * part);
    }
    cut(frame_.point(from), frame_.point(to));
    from = to;
  }
  at_ = event.to;
}

bool CuttingSimulation::can_show(const interpreter::Origin& origin,
                                 const interpreter::Position& to) {
  if (!part_) return false;
  for (const Axis axis : interpreter::kAllAxes) {
    if (axis <= Axis::Z || to.raw(axis) == at_.raw(axis)) continue;
    omit(origin, Omission::RotaryAxis);
    return false;
  }
  if (is_across_) {
    omit(origin, Omission::ToolAxis);
    return false;
  }
  if (radius_) return true;
  // Moves above the blank cut nothing whatever the tool.
  const double lowest = std::min(frame_.point(at_).w, frame_.point(to).w);
  if (lowest < blank_->high.w) omit(origin, Omission::NoTool);
  return false;
}

void CuttingSimulation::omit(const interpreter::Origin& origin, Omission why) {
  const auto known = std::ranges::find(omitted_, why, &OmittedSection::why);
  if (known == omitted_.end()) {
    omitted_.push_back({origin, why, 1});
  } else {
    ++known->moves;
  }
}

void CuttingSimulation::cut(const FramePoint& from, const FramePoint& to) {
  ++cuts_;
  part_->cut(from, to, *radius_);
}

}  // namespace dripline::graphics
