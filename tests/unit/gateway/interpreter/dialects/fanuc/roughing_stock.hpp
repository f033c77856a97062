#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/unit/gateway/interpreter/dialects/fanuc/tilting_machine.hpp"

/// Roughing on a lathe as the tests see it: contours by their own formulas, and stock as a row of
/// columns along the cuts. Nothing of the interpreter's own geometry.
namespace dripline::interpreter::fanuc {

/// The directions of a cycle: `depth` grows out of the work, `along` with the cuts.
struct CutDirections {
  bool is_facing = false;
  bool is_inside = false;    ///< out of the work is toward smaller positions
  bool cuts_forward = true;  ///< along grows toward smaller positions

  double out() const { return is_inside ? -1 : 1; }
  double forward() const { return cuts_forward ? -1 : 1; }
  static constexpr double kDepthBase = 40, kAlongBase = 70;

  double depth_of(const Position& at) const {
    return out() * (at.raw(is_facing ? Axis::Z : Axis::X) - kDepthBase);
  }
  double along_of(const Position& at) const {
    return forward() * (at.raw(is_facing ? Axis::X : Axis::Z) - kAlongBase);
  }
  double x_of(double depth, double along) const {
    return is_facing ? kAlongBase + forward() * along : kDepthBase + out() * depth;
  }
  double z_of(double depth, double along) const {
    return is_facing ? kDepthBase + out() * depth : kAlongBase + forward() * along;
  }
  /// Whether counterclockwise (along to the right, depth up) is so on the machine.
  bool keeps_rotation() const { return (out() * forward() > 0) != is_facing; }
};

/// A line, or an arc within the upper or the lower half of its circle.
struct ContourPart {
  double from_depth = 0, from_along = 0, to_depth = 0, to_along = 0;
  bool is_arc = false;
  bool is_upper = false;
  double center_depth = 0, center_along = 0, radius = 0;

  double depth_at(double along) const {
    if (is_arc) {
      const double off = along - center_along;
      const double height = std::sqrt(std::max(0.0, radius * radius - off * off));
      return center_depth + (is_upper ? height : -height);
    }
    const double length = to_along - from_along;
    if (length <= 0) return std::max(from_depth, to_depth);
    return from_depth + (to_depth - from_depth) * (along - from_along) / length;
  }
  double highest() const {
    const double ends = std::max(from_depth, to_depth);
    const bool has_top =
        is_arc && is_upper && from_along <= center_along && to_along >= center_along;
    return has_top ? center_depth + radius : ends;
  }
};
using Contour = std::vector<ContourPart>;

/// Where there is no contour nothing may be cut.
inline double depth_of(const Contour& contour, double along) {
  double depth = std::numeric_limits<double>::infinity();
  if (contour.empty() || along < contour.front().from_along) return -depth;
  for (const ContourPart& part : contour) {
    if (along >= part.from_along && along <= part.to_along && part.to_along > part.from_along)
      return part.depth_at(along);
  }
  return depth;
}

/// Columns of stock from where the cuts begin.
class Stock {
 public:
  static constexpr double kWidth = 0.013;

  Stock(double begin, double end, double height)
      : begin_(begin),
        initial_(height),
        columns_(static_cast<std::size_t>((end - begin) / kWidth), height) {}

  double begin() const { return begin_; }
  double initial() const { return initial_; }
  std::size_t size() const { return columns_.size(); }
  double center(std::size_t column) const {
    return begin_ + (static_cast<double>(column) + 0.4871) * kWidth;
  }
  double height(std::size_t column) const { return columns_[column]; }
  void cut(std::size_t column, double depth) {
    columns_[column] = std::min(columns_[column], depth);
  }
  /// The columns whose centers are between two places.
  std::pair<std::size_t, std::size_t> between(double a, double b) const {
    return {first_after(std::min(a, b)), first_after(std::max(a, b))};
  }

 private:
  std::size_t first_after(double along) const {
    const double column = std::ceil((along - begin_) / kWidth - 0.4871);
    return static_cast<std::size_t>(std::clamp(column, 0.0, static_cast<double>(columns_.size())));
  }

  double begin_, initial_;
  std::vector<double> columns_;
};

/// Makes moves in the stock; `fault` is the first thing that must not be.
class RoughingCheck {
 public:
  static constexpr double kTolerance = 0.006;

  RoughingCheck(const CutDirections& directions, Stock& stock)
      : directions_(directions), stock_(stock) {}

  /// No cut goes below `contour` and none takes more than `max_depth`.
  void limit(const Contour& contour, double max_depth) {
    limits_.clear();
    for (std::size_t n = 0; n < stock_.size(); ++n)
      limits_.push_back(depth_of(contour, stock_.center(n)));
    max_depth_ = max_depth;
  }

  void make(const MachineLog::Move& move) {
    if (move.kind != 'A') return go(move.kind == 'R', move.from, move.to);
    const int pieces = std::max(2, static_cast<int>(std::ceil(move.arc.sweep.degrees() / 0.25)));
    const double cx = move.arc.center_second.mm(), cz = move.arc.center_first.mm();
    const double x = move.from.raw(Axis::X) - cx, z = move.from.raw(Axis::Z) - cz;
    const double sense = move.arc.turn == Turn::Counterclockwise ? 1 : -1;
    Position from = move.from;
    for (int n = 1; n <= pieces; ++n) {
      const double angle = sense * move.arc.sweep.radians() * n / pieces;
      Position to = move.to;
      if (n < pieces) {
        to.set_raw(Axis::X, cx + x * std::cos(angle) + z * std::sin(angle));
        to.set_raw(Axis::Z, cz + z * std::cos(angle) - x * std::sin(angle));
      }
      go(false, from, to);
      from = to;
    }
    const double end = std::hypot(move.to.raw(Axis::X) - cx, move.to.raw(Axis::Z) - cz);
    const double miss = std::fabs(std::hypot(x, z) - end);
    if (miss > kTolerance)
      note("the end is not on the arc", directions_.along_of(move.to), miss, 0);
  }

  std::string fault;

 private:
  void note(const char* what, double along, double depth, double limit) {
    if (!fault.empty()) return;
    fault = std::string(what) + " at " + std::to_string(along) + ": " + std::to_string(depth) +
            ", limit " + std::to_string(limit);
  }

  void go(bool is_rapid, const Position& from, const Position& to) {
    const double a = directions_.along_of(from), b = directions_.along_of(to);
    const double da = directions_.depth_of(from), db = directions_.depth_of(to);
    const auto [first, last] = stock_.between(a, b);
    if (is_rapid) {
      // Where it begins the tool is already.
      const double surface = surface_at(b);
      if (db < surface - kTolerance) note("a rapid move in the stock", b, db, surface);
    } else {
      cuts_.push_back({std::min(a, b), std::max(a, b), a <= b ? da : db, a <= b ? db : da});
    }
    for (std::size_t n = first; n < last; ++n) {
      const double along = stock_.center(n);
      const double depth = da + (db - da) * (along - a) / (b - a);
      const double taken = stock_.height(n) - depth;
      if (is_rapid) {
        if (taken > kTolerance)
          note("a rapid move through the stock", along, depth, stock_.height(n));
        continue;
      }
      const double limit = limits_[n];
      if (depth < limit - kTolerance) note("a cut below the contour", along, depth, limit);
      if (taken > max_depth_ + kTolerance) note("a cut too deep", along, taken, max_depth_);
      stock_.cut(n, depth);
    }
  }

  /// Where the columns may be too wide: by all cuts there.
  double surface_at(double along) const {
    if (along <= stock_.begin() + 1e-6) return -std::numeric_limits<double>::infinity();
    double surface = stock_.initial();
    for (const Cut& cut : cuts_) {
      if (along < cut.from - 1e-6 || along > cut.to + 1e-6) continue;
      const double length = cut.to - cut.from;
      const double part = length > 0 ? (along - cut.from) / length : 0;
      const double depth = cut.from_depth + (cut.to_depth - cut.from_depth) * part;
      surface = std::min(surface, length > 1e-6 ? depth : std::min(cut.from_depth, cut.to_depth));
    }
    return surface;
  }

  struct Cut {
    double from = 0, to = 0, from_depth = 0, to_depth = 0;
  };

  const CutDirections& directions_;
  Stock& stock_;
  std::vector<Cut> cuts_;
  std::vector<double> limits_;  ///< of the columns
  double max_depth_ = 0;
};

}  // namespace dripline::interpreter::fanuc
