#include "clients/tools/graphics/turning_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::graphics {
namespace {

using interpreter::Axis;

/// Smallest loose piece that stays, as a part of the material.
constexpr double kCrumb = 0.01;
constexpr int kMaxTurnedChords = 4096;
constexpr double kTurnedSagitta = 0.25;  ///< of a chord, in cells
constexpr double kCoarse = 0.01;         ///< without a bar: mm
constexpr double kSharpest = 0.75;       ///< least nose radius drawn, in cells
bool is_for_bores(int type) {
  return type == 1 || type == 2 || type == 6;
}

constexpr int kGraphicsOff = 90, kGraphicsOn = 91;

}  // namespace

TurningSimulation::TurningSimulation(TurningSettings settings)
    : settings_(std::move(settings)), at_(settings_.start) {
  if (settings_.bar) begin(*settings_.bar);
}

void TurningSimulation::begin(const SectionExtent& bar) {
  if (settings_.follows_pattern) return;
  auto made = TurnedSection::make(bar, settings_.cells_along);
  if (!made) {
    failure_ = made.error();
    return;
  }
  failure_.reset();
  part_.emplace(std::move(*made));
  bar_volume_ = part_->volume();
}

/// A program may say its bar in several steps; once something is cut it stays as it is.
void TurningSimulation::on_blank(const interpreter::Blank& event) {
  if (settings_.bar || cuts_ > 0) return;
  axis_x_ = (event.min.linear(Axis::X) + event.max.linear(Axis::X)).mm() / 2;
  begin({event.min.linear(Axis::Z).mm(), event.max.linear(Axis::Z).mm(), 0,
         event.max.linear(Axis::X).mm() - axis_x_});
}

void TurningSimulation::on_tool(const interpreter::ToolChange& event) {
  if (event.is_preselection) return;
  const int number = event.offset.value_or(event.number);
  tool_ = {};
  turning_.clear();
  threading_.clear();
  drilling_.clear();
  const auto known = std::ranges::find(settings_.tools, number, &interpreter::ToolRecord::number);
  if (known != settings_.tools.end()) {
    tool_.type = known->tip;
    tool_.radius = std::fabs((known->radius + known->radius_wear).mm());
  }
  const auto width = settings_.widths.find(number);
  if (width != settings_.widths.end()) tool_.width = width->second;
}

void TurningSimulation::on_miscellaneous(const interpreter::Miscellaneous& event) {
  if (event.code == kGraphicsOff) draws_ = false;
  if (event.code == kGraphicsOn) draws_ = true;
}

void TurningSimulation::on_rapid(const interpreter::Rapid& event) {
  go(point(event.to), Travel::Rapid);
  at_ = event.to;
}
void TurningSimulation::on_line(const interpreter::Line& event) {
  go(point(event.to), Travel::Feed);
  at_ = event.to;
}
void TurningSimulation::on_thread(const interpreter::Thread& event) {
  if (event.arc) {
    go_around(interpreter::arc_of(event), Travel::Thread);
  } else {
    go(point(event.to), Travel::Thread);
  }
  at_ = event.to;
}
void TurningSimulation::on_arc(const interpreter::Arc& event) {
  go_around(event, Travel::Feed);
  at_ = event.to;
}
/// A probe's ball cuts nothing.
void TurningSimulation::on_probe(const interpreter::Probe& event) {
  if (event.result) at_ = event.result->at;
}

void TurningSimulation::on_block_end(const interpreter::Origin& event) {
  constexpr std::uint64_t kBlocksBetween = 64;
  if (event.block % kBlocksBetween == 0 && settings_.on_progress) settings_.on_progress(event);
}

void TurningSimulation::finish() {
  if (part_) part_->drop_crumbs(kCrumb);
}

SectionPoint TurningSimulation::point(const interpreter::Position& position) const {
  return {position.linear(Axis::Z).mm(), position.linear(Axis::X).mm() - axis_x_};
}

void TurningSimulation::go_around(const interpreter::Arc& arc, Travel travel) {
  if (arc.plane != interpreter::Plane::ZX) return go(point(arc.to), travel);
  const SectionPoint center{arc.center_first.mm(), arc.center_second.mm() - axis_x_};
  const SectionPoint from = point(at_);
  const double radius = std::hypot(from.z - center.z, from.x - center.x);
  const double begin = std::atan2(from.x - center.x, from.z - center.z);
  const double turn = arc.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
  const double sagitta = std::min(part_ ? kTurnedSagitta * part_->cell() : kCoarse, radius);
  const double step = radius > 0 ? 2 * std::acos(1 - sagitta / radius) : 1;
  const double wanted = std::ceil(arc.sweep.radians() / std::max(step, 1e-6));
  const int chords = static_cast<int>(std::clamp(wanted, 1.0, double{kMaxTurnedChords}));
  for (int i = 1; i < chords; ++i) {
    const double angle = begin + turn * arc.sweep.radians() * i / chords;
    const SectionPoint to{center.z + radius * std::cos(angle), center.x + radius * std::sin(angle)};
    go(to, travel);
    at_.set(Axis::Z, Length::mm(to.z));
    at_.set(Axis::X, Length::mm(to.x + axis_x_));
  }
  go(point(arc.to), travel);
}

void TurningSimulation::go(const SectionPoint& to, Travel travel) {
  const SectionPoint from = point(at_);
  if (draws_) note(from, to, travel);
  if (part_) cut(from, to, travel);
}

void TurningSimulation::note(const SectionPoint& from, const SectionPoint& to, Travel travel) {
  const bool is_rapid = travel == Travel::Rapid;
  PathKind kind = is_rapid ? PathKind::Rapid : PathKind::Feed;
  if (settings_.follows_pattern) {
    if (is_rapid) return;
    kind = settings_.follows_pattern() ? PathKind::FinishPattern : PathKind::Part;
  }
  if (path_.size() < kMaxPieces) {
    path_.push_back({from, to, kind});
  } else {
    ++left_out_;
  }
}

void TurningSimulation::cut(const SectionPoint& from, const SectionPoint& to, Travel travel) {
  // a boring bar above the material reaches for no bore
  if (is_for_bores(tool_.type) && std::min(from.x, to.x) > part_->bar().x_high) return;
  ++cuts_;
  const bool is_on_axis = std::max(std::fabs(from.x), std::fabs(to.x)) < part_->cell();
  for (const ConvexOutline& piece : pieces(travel, is_on_axis))
    part_->remove(swept(piece, from, to));
}

const std::vector<ConvexOutline>& TurningSimulation::pieces(Travel travel, bool is_on_axis) {
  const bool is_thread = travel == Travel::Thread;
  const bool is_drill = tool_.type == 7 && is_on_axis && tool_.width;
  auto& kept = is_thread ? threading_ : is_drill ? drilling_ : turning_;
  if (kept.empty()) {
    const SectionExtent& bar = part_->bar();
    kept = cutting_pieces(tool_, {.insert_degrees = settings_.insert_degrees,
                                  .reach = 2 * (bar.length() + bar.x_high),
                                  .least_radius = kSharpest * part_->cell(),
                                  .is_thread = is_thread,
                                  .is_on_axis = is_drill});
  }
  return kept;
}

}  // namespace dripline::graphics
