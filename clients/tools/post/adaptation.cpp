#include "clients/tools/post/adaptation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "clients/tools/post/arc_fit.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/path_feed.hpp"

namespace dripline::post {
namespace {

using interpreter::Arc;
using interpreter::axes_of;
using interpreter::Axis;
using interpreter::EventGate;
using interpreter::Line;
using interpreter::Origin;
using interpreter::PlaneVector;
using interpreter::Position;

constexpr double kSame = 1e-9;  ///< of values that were not rounded, as a part of them
constexpr double kMaxLines = 100'000;

double distance(const Position& a, const Position& b) {
  return std::hypot(a.raw(Axis::X) - b.raw(Axis::X), a.raw(Axis::Y) - b.raw(Axis::Y),
                    a.raw(Axis::Z) - b.raw(Axis::Z));
}

/// From the arc's center.
PlaneVector from_center(const Position& at, const Arc& arc) {
  return in_plane(at, axes_of(arc.plane)) -
         PlaneVector{arc.center_first.mm(), arc.center_second.mm()};
}

double arc_length(const Position& from, const Arc& arc) {
  const Axis normal = axes_of(arc.plane).normal;
  return std::hypot(length(from_center(from, arc)) * arc.sweep.radians(),
                    arc.to.raw(normal) - from.raw(normal));
}

}  // namespace

Position of_target(const Target& target, Position position, const Position& start) {
  for (const Axis axis : interpreter::kAllAxes) {
    const bool is_known = target.axes.find(letter(axis)) != std::string_view::npos;
    if (is_known && position.has(axis)) continue;
    position.set_raw(axis, start.raw(axis));
    position.unmark(axis);
  }
  return position;
}

Adaptation::Adaptation(interpreter::EventSink& out, const Grid& grid,
                       const AdaptationOptions& options, const Position& start)
    : EventGate(out), grid_(grid), options_(options), start_(start), at_(start) {}

void Adaptation::refuse(const Origin& origin, std::string what) {
  if (!refusal_) refusal_ = Refusal{std::move(what), origin};
}

/// It ends on the step where the target is already. An axis that is named for the first time is a
/// move from any other place.
bool Adaptation::is_short(const Position& to) const {
  if (options_.is_off_grid) return false;
  return std::ranges::all_of(interpreter::kAllAxes, [&](Axis axis) {
    const bool is_new = to.has(axis) && !at_.has(axis);
    if (!to.has(axis)) return true;
    return !is_new && grid_.counts(axis, to.raw(axis)) == grid_.counts(axis, at_.raw(axis));
  });
}

bool Adaptation::check_target(const Origin& origin, const Position& to) {
  for (const Axis axis : interpreter::kAllAxes) {
    if (!to.has(axis)) continue;
    const char name = letter(axis);
    if (target().axes.find(name) == std::string_view::npos) {
      if (to.raw(axis) == at_.raw(axis)) continue;
      refuse(origin, fmt::format("axis {}: {} has {}", name, target().name, target().axes));
      return false;
    }
    const std::int64_t counts = grid_.counts(axis, to.raw(axis));
    if (grid_.is_in_range(counts)) continue;
    const auto& range = range_of(target().coordinate, grid_.units());
    refuse(origin,
           fmt::format("coordinate {}{:.{}f}: {} takes up to {}", name,
                       value_of(counts, range.decimals), range.decimals, target().name, range.max));
    return false;
  }
  return true;
}

/// Axes that turn another part of the machine lead the tool elsewhere on the workpiece.
bool Adaptation::check_rotary(const Origin& origin, const Position& to) {
  if (options_.rotary_refusal.empty()) return true;
  for (const Axis axis : interpreter::kAllAxes) {
    if (!is_rotary(axis) || !to.has(axis) || to.raw(axis) == at_.raw(axis)) continue;
    refuse(origin,
           fmt::format("a move of the rotary axis {}: {}", letter(axis), options_.rotary_refusal));
    return false;
  }
  return true;
}

/// The program that is written calls each tool with its own length, from its first move of Z on. Of
/// a tilted tool every linear axis holds a part of it.
bool Adaptation::check_length(const Origin& origin, const Position& to) {
  if (source_ == nullptr || target().is_lathe) return true;
  const auto modes = source_->modes();
  const auto lengths = modes.lengths();
  const bool moves_any = std::ranges::any_of(std::array{Axis::X, Axis::Y, Axis::Z}, [&](Axis axis) {
    return to.has(axis) && to.raw(axis) != at_.raw(axis);
  });
  std::array<double, 3> written{};
  const auto tool = std::ranges::find(*tools_, tool_, &interpreter::ToolRecord::number);
  if (tool_ != 0 && tool != tools_->end())
    written[2] = tool->length.raw(Axis::Z) + tool->wear.raw(Axis::Z);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto axis = static_cast<Axis>(i);
    const bool moves =
        modes.is_length_certain ? to.has(axis) && to.raw(axis) != at_.raw(axis) : moves_any;
    if (!moves || std::fabs(lengths[i] - written[i]) <= options_.tolerance) continue;
    refuse(origin, fmt::format("a move of {} with a length of {:.4f} mm in force: the program for "
                               "{} has that of tool {}, {:.4f} mm",
                               letter(axis), lengths[i], target().name, tool_, written[i]));
    return false;
  }
  return true;
}

/// What F means when a rotary axis moves differs between controls, even where the number is one.
bool Adaptation::check_feed_axes(const Origin& origin, const Position& to) {
  for (const Axis axis : interpreter::kAllAxes) {
    if (!is_rotary(axis) || !to.has(axis) || to.raw(axis) == at_.raw(axis)) continue;
    refuse(origin, fmt::format("feed move of the rotary axis {}: what F means there differs from "
                               "control to control",
                               letter(axis)));
    return false;
  }
  return true;
}

std::optional<double> Adaptation::rounded(const Origin& origin, std::string_view name, double value,
                                          const NumberRange& range, std::string_view unit,
                                          std::uint64_t& count) {
  const double nearest = value_of(counts_of(value, range.decimals), range.decimals);
  const double off = std::fabs(nearest - value);
  if (!(nearest <= range.max)) {
    refuse(origin, fmt::format("{} of {:g} {}: {} takes up to {:g}", name, value, unit,
                               target().name, range.max));
    return std::nullopt;
  }
  if (value < range.min) {
    refuse(origin, fmt::format("{} of {:g} {}: {} takes {:g} at least", name, value, unit,
                               target().name, range.min));
    return std::nullopt;
  }
  if (!(off <= options_.value_tolerance * std::fabs(value)) || (nearest == 0) != (value == 0)) {
    refuse(origin, fmt::format("{} of {:g} {}: {} takes {} decimals, so {:g}, which is off by more "
                               "than {:g} %",
                               name, value, unit, target().name, range.decimals, nearest,
                               options_.value_tolerance * 100));
    return std::nullopt;
  }
  if (off > kSame * std::fabs(value)) ++count;
  return nearest;
}

std::optional<Feed> Adaptation::feed_of(const Origin& origin, Feed feed, double length) {
  const auto units = grid_.units();
  if (feed.per() == Feed::Per::Move) {
    ++counts_.inverse_time;
    feed = Feed::per_minute(Length::mm(feed.moves_per_minute() * length));
  }
  const bool is_per_minute = feed.per() == Feed::Per::Minute;
  const auto& range = range_of(is_per_minute ? target().feed : target().feed_per_revolution, units);
  if (range.max == 0) {
    refuse(origin,
           fmt::format("feed of {:g} {} per revolution: {} has feeds per minute alone",
                       feed.length().mm() / mm_per_unit(units), unit_name(units), target().name));
    return std::nullopt;
  }
  if (!(feed.length().mm() > 0)) {
    refuse(origin, fmt::format("feed of {:g}: no control moves at it", feed.length().mm()));
    return std::nullopt;
  }
  const auto value = rounded(origin, "feed", feed.length().mm() / mm_per_unit(units), range,
                             fmt::format("{}/{}", unit_name(units), is_per_minute ? "min" : "rev"),
                             counts_.rounded_feeds);
  if (!value) return std::nullopt;
  const Length length_of_feed = Length::mm(*value * mm_per_unit(units));
  return is_per_minute ? Feed::per_minute(length_of_feed) : Feed::per_revolution(length_of_feed);
}

void Adaptation::on_rapid(const interpreter::Rapid& event) {
  if (!is_open() || !check_target(event.origin, event.to)) return;
  if (!check_rotary(event.origin, event.to) || !check_length(event.origin, event.to)) return;
  if (is_short(event.to)) {
    if (!event.to.same_point(at_)) ++counts_.short_moves;
    return;
  }
  interpreter::Rapid adapted = event;
  adapted.to = of_target(target(), event.to, start_);
  has_waited_ = has_waited_ && event.to.same_point(at_);
  EventGate::on_rapid(adapted);
  at_ = event.to;
}

void Adaptation::move_line(const Line& line) {
  if (!is_open() || !check_target(line.origin, line.to)) return;
  if (!check_length(line.origin, line.to)) return;
  if (is_short(line.to)) {
    if (!line.to.same_point(at_)) ++counts_.short_moves;
    return;
  }
  if (!check_feed_axes(line.origin, line.to)) return;
  const auto feed = feed_of(line.origin, line.feed, distance(at_, line.to));
  if (!feed) return;
  Line adapted = line;
  adapted.feed = *feed;
  adapted.to = of_target(target(), line.to, start_);
  has_waited_ = has_waited_ && line.to.same_point(at_);
  EventGate::on_line(adapted);
  at_ = line.to;
}

void Adaptation::on_line(const Line& event) {
  if (event.rests) ++counts_.exact_stops;
  move_line(event);
}

/// Pieces of the sweep that the target has in one arc.
void Adaptation::on_arc(const Arc& event) {
  if (!is_open() || !check_target(event.origin, event.to)) return;
  if (!check_rotary(event.origin, event.to) || !check_length(event.origin, event.to)) return;
  if (!check_feed_axes(event.origin, event.to)) return;
  if (event.rests) ++counts_.exact_stops;
  constexpr double kNoise = 1e-9;
  const Position from = at_;
  Arc arc = event;
  if (event.feed.per() == Feed::Per::Move)
    arc.feed =
        Feed::per_minute(Length::mm(event.feed.moves_per_minute() * arc_length(from, event)));
  const double sweep = event.sweep.degrees();
  std::vector<double> ends;
  if (target().max_sweep == 90) {
    const PlaneVector start = from_center(from, event);
    const double begin = Angle::radians(std::atan2(start.second, start.first)).degrees();
    const double sense = event.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
    for (double at = sense > 0 ? std::floor(begin / 90 + 1) * 90 : std::ceil(begin / 90 - 1) * 90;
         std::fabs(at - begin) < sweep; at += sense * 90)
      ends.push_back(std::fabs(at - begin) / sweep);
  } else if (sweep > target().max_sweep + kNoise) {
    for (double at = target().max_sweep; at < sweep - kNoise; at += target().max_sweep)
      ends.push_back(at / sweep);
  }
  constexpr double kLeast = 1e-7;  // of an arc: noise of its angles
  std::erase_if(ends, [](double end) { return end < kLeast || end > 1 - kLeast; });
  if (!ends.empty()) ++counts_.split_arcs;
  ends.push_back(1);
  double done = 0;
  for (const double end : ends) {
    Arc piece = arc;
    if (end < 1) {
      piece.to = point_of(from, event, end);
      piece.rests = false;
    }
    piece.sweep = Angle::degrees(sweep * (end - done));
    done = end;
    arc_piece(piece);
  }
}

bool Adaptation::can_be_arc(const Arc& arc, std::string& reason) const {
  const auto axes = axes_of(arc.plane);
  if (!target().has_all_planes && arc.plane != interpreter::Plane::XY) {
    reason =
        fmt::format("arc in the plane {}: {} has arcs in XY", word_of(arc.plane), target().name);
    return false;
  }
  const bool is_helix = std::ranges::any_of(interpreter::kAllAxes, [&](Axis axis) {
    return axis != axes.first && axis != axes.second && arc.to.has(axis) &&
           arc.to.raw(axis) != at_.raw(axis);
  });
  if (is_helix && !target().has_helix) {
    reason = fmt::format("helix: {} has arcs in a plane", target().name);
    return false;
  }
  if (is_helix && !target().has_all_helices && arc.plane != interpreter::Plane::XY) {
    reason = fmt::format("helix in the plane {}: {} has helices in XY", word_of(arc.plane),
                         target().name);
    return false;
  }
  if (options_.is_off_grid) return true;
  const FittedArc fitted = fit_arc(grid_, at_, arc, options_.tolerance);
  if (fitted.is_possible && fitted.deviation <= options_.tolerance) return true;
  if (fitted.is_possible) {
    reason = fmt::format(
        "arc of {:.4f} degrees, {:.4f} mm long: the nearest that {} can have is "
        "{:.6f} mm off, the tolerance is {:g} mm",
        arc.sweep.degrees(), arc_length(at_, arc), target().name, fitted.deviation,
        options_.tolerance);
  } else {
    reason = fmt::format(
        "arc of {:.4f} degrees, {:.4f} mm long: rounded to the steps of {} its "
        "radii differ by {:.6f} mm, the limit is {:g} mm",
        arc.sweep.degrees(), arc_length(at_, arc), target().name, fitted.radius_error,
        target().max_radius_error);
  }
  return false;
}

void Adaptation::arc_piece(const Arc& arc) {
  if (!is_open() || !check_target(arc.origin, arc.to)) return;
  if (!check_length(arc.origin, arc.to)) return;
  const bool is_closed = is_short(arc.to);
  const double from_chord = distance_from_chord(at_, arc);
  const double unseen = std::min(options_.tolerance, grid_.center_step()) / 2;
  if (is_closed && from_chord <= unseen) {
    ++counts_.short_moves;
    return;
  }
  std::string reason;
  if (can_be_arc(arc, reason)) {
    const Feed own = target().feeds_along_circle ? circle_feed_of(arc.feed, arc, at_) : arc.feed;
    const auto feed = feed_of(arc.origin, own, arc_length(at_, arc));
    if (!feed) return;
    Arc adapted = arc;
    adapted.feed = *feed;
    adapted.to = of_target(target(), arc.to, start_);
    has_waited_ = false;
    EventGate::on_arc(adapted);
    at_ = arc.to;
    return;
  }
  if (from_chord <= unseen) {
    ++counts_.straightened_arcs;
    move_line({arc.origin, arc.to, arc.feed, arc.rests});
    return;
  }
  lines_of(arc, reason);
}

void Adaptation::lines_of(const Arc& arc, std::string_view reason) {
  if (!options_.chord) return refuse(arc.origin, std::string(reason));
  const double radius = std::max(length(from_center(at_, arc)), length(from_center(arc.to, arc)));
  const double share = std::clamp(1 - *options_.chord / radius, -1.0, 1.0);
  const double angle = std::min(2 * std::acos(share), Angle::kPi / 4);
  const double count = std::ceil(arc.sweep.radians() / angle);
  if (!(count <= kMaxLines)) {
    return refuse(arc.origin, fmt::format("arc of radius {:g} mm: more than {:.0f} lines within "
                                          "{:g} mm",
                                          radius, kMaxLines, *options_.chord));
  }
  ++counts_.arcs_as_lines;
  const Position from = at_;
  for (double i = 1; i <= count; ++i) {
    const bool is_last = i == count;
    move_line({arc.origin, is_last ? arc.to : point_of(from, arc, i / count), arc.feed,
               is_last && arc.rests});
  }
}

}  // namespace dripline::post
