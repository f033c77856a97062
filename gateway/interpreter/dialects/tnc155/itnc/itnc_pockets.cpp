#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/pocket_figure.hpp"

/// Cycles 251 to 254. Source: iTNC 530, User's Manual, Cycles: pocket milling, stud milling, slot
/// milling. What the manual states is in this folder's README; between that, the passes lie beside
/// each other so that the region is cut to its wall and nothing else is.
namespace dripline::interpreter::tnc155::itnc {
namespace {

/// One pocket or slot.
class Pocket {
 public:
  Pocket(const Table& table, int cycle, const PocketShape& shape)
      : milling_(table),
        table_(table),
        shape_(shape),
        tool_(milling_.tool_radius()),
        step_(stepover(table, cycle, tool_)),
        rough_(std::max(0.0, shape.room - table.mm(368))),
        turn_(milling_.inner_turn()) {
    const int plunge = whole_word(table, 366);
    const double angle = table.run().options.plunge_angle;
    if (rough_ < kSameLength) rough_ = 0;
    constexpr double kStraightDown = 90;
    if (plunge == 0 || angle >= kStraightDown) return;
    slope_ = std::tan(angle * (Angle::kPi / 180));
    if (plunge == kHelical) helix_ = helix_radius(rough_, tool_);
  }

  void make() {
    const int extent = whole_word(table_, 215);
    const bool finishes = extent != kRoughing && has_allowance(table_);
    milling_.over(extent == kFinishing ? shape_.anchor() : start());
    table_.rapid(table_.clearance());
    if (extent != kFinishing) rough();
    if (finishes) finish();
    table_.rapid(std::max(table_.clearance(), milling_.height()));
    table_.rapid(table_.last());
  }

 private:
  double milling_feed() const { return table_.feed(207); }
  double finishing_feed() const { return table_.feed(table_.of(385) > 0 ? 385 : 207); }
  double plunging_feed() const { return table_.feed(206); }

  PlaneVector start() const {
    if (shape_.is_rectangle) {
      const bool ramps = slope_ > 0 && helix_ == 0;
      return ramps ? ramp_end(false) : shape_.center + helix_ * shape_.outward();
    }
    return shape_.begin() + helix_ * unit_vector(shape_.angle);
  }
  PlaneVector ramp_end(bool far) const {
    const double half = ramp_length(shape_, rough_, tool_) / 2;
    return shape_.center + (far ? half : -half) * unit_vector(shape_.angle);
  }

  void rough() {
    const double bottom = table_.bottom() + table_.mm(369);
    double level = table_.surface();
    while (level > bottom + kSliverOfStep) {
      const double from = level;
      level = std::max(bottom, level - table_.mm(202));
      table_.cut(slope_ > 0 ? from : level, plunging_feed());
      if (slope_ > 0) plunge(from, level);
      cover_core(milling_feed());
      const int lines = lines_to(rough_, step_);
      clear_rings(rough_, lines, milling_feed());
      if (lines > 0) milling_.follow(shape_.departure(rough_, turn_), milling_feed());
      const bool is_convex = shape_.core != PocketShape::Core::Arc;
      const double above = std::min(table_.clearance(), level + table_.mm(200));
      table_.rapid(is_convex ? above : table_.clearance());
      if (level > bottom + kSliverOfStep) milling_.rapid(start());
    }
  }

  /// Along a helix, or to and fro along the core.
  void plunge(double from, double to) {
    if (helix_ > 0) {
      const PlaneVector center = shape_.is_rectangle ? shape_.center : shape_.begin();
      constexpr double kWhole = 360;
      const double sweep = kWhole * (from - to) / (2 * Angle::kPi * helix_ * slope_);
      const PlaneVector out = milling_.place() - center;
      const double angle = (turn_ == Turn::Counterclockwise ? 1 : -1) * sweep;
      const PlaneVector ray = unit_vector(angle);
      const PlaneVector end = center + ray.first * out + ray.second * left_of(out);
      milling_.follow({end, true, center, turn_, sweep}, to, plunging_feed());
      return milling_.line(center, plunging_feed());
    }
    const double length = ramp_length(shape_, rough_, tool_);
    const int passes = std::max(1, lines_to((from - to) / slope_, length));
    for (int pass = 1; pass <= passes; ++pass) {
      const bool far = pass % 2 == 1;
      const double height = from + (to - from) * pass / passes;
      const PathPiece piece =
          shape_.is_rectangle ? straight_piece(ramp_end(far)) : shape_.along_core(far);
      milling_.follow(piece, height, plunging_feed());
    }
  }

  /// The whole core at this height, to the anchor.
  void cover_core(double feed) {
    if (shape_.core == PocketShape::Core::Point) return milling_.line(shape_.center, feed);
    if (!is_at(shape_.begin())) milling_.follow(shape_.along_core(false), feed);
    milling_.follow(shape_.along_core(true), feed);
    if (shape_.is_rectangle) milling_.line(shape_.center, feed);
  }
  bool is_at(PlaneVector point) const {
    const PlaneVector by = milling_.place() - point;
    return std::hypot(by.first, by.second) <= kSameLength;
  }

  /// From the core to `room`, from the inside out.
  void clear_rings(double room, int lines, double feed) {
    for (int line = 1; line <= lines; ++line) {
      const double away = room * line / lines;
      milling_.line(shape_.anchor() + away * shape_.outward(), feed);
      milling_.follow(shape_.ring(away, turn_), feed);
    }
  }

  /// The wall, then the floor.
  void finish() {
    if (!is_at(shape_.anchor())) {
      table_.rapid(table_.clearance());
      milling_.rapid(shape_.anchor());
    }
    if (table_.mm(368) > 0) finish_wall();
    if (table_.mm(369) > 0) finish_floor();
  }

  void finish_wall() {
    const double infeed = table_.mm(338) > 0 ? table_.mm(338) : -table_.mm(201);
    for (double level = table_.surface(); level > table_.bottom() + kSliverOfStep;) {
      level = std::max(table_.bottom(), level - infeed);
      table_.cut(level, plunging_feed());
      milling_.follow(shape_.approach(shape_.room, turn_), finishing_feed());
      milling_.follow(shape_.ring(shape_.room, turn_), finishing_feed());
      milling_.follow(shape_.departure(shape_.room, turn_), finishing_feed());
    }
  }

  void finish_floor() {
    table_.cut(table_.bottom(), plunging_feed());
    cover_core(finishing_feed());
    const int lines = lines_to(shape_.room, step_);
    clear_rings(shape_.room, lines, finishing_feed());
    if (lines > 0) milling_.follow(shape_.departure(shape_.room, turn_), finishing_feed());
  }

  Milling milling_;
  const Table& table_;
  const PocketShape& shape_;
  double tool_;
  double step_;
  double rough_;      ///< room of the roughing
  double slope_ = 0;  ///< height by length; 0: straight down
  double helix_ = 0;  ///< its radius
  Turn turn_;
};

}  // namespace

void mill_pocket(const Table& table, int cycle) {
  const Milling milling(table);
  const PlaneVector start = milling.place();
  if (whole_word(table, 215) == kFinishing && !has_allowance(table)) return;
  const int repeats = cycle == kRoundSlot ? whole_word(table, 377) : 1;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const PocketShape shape = shape_of(table, cycle, start, milling.tool_radius(), repeat);
    Pocket(table, cycle, shape).make();
  }
  if (cycle == kRoundSlot) milling.over({table.mm(216), table.mm(217)});
  if (cycle != kRoundSlot && !leaves_place_open(table, cycle)) milling.over(start);
}

}  // namespace dripline::interpreter::tnc155::itnc
