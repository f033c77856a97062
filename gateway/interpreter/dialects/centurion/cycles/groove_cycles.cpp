
#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/cycles/cycle_moves.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/cycle_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr double kSame = 1e-9;

/// The words and parameters of a kind: a face groove is cut along Z and widens in X.
struct GrooveKind {
  bool cuts_along_x;
  Address bottom;     ///< final depth
  Address end;        ///< where the groove ends, across
  Address step;       ///< across
  Address end_stock;  ///< finish stock on each side
  Address bottom_stock;
  int clearance_parameter;
  int end_parameter;
};
constexpr GrooveKind kOnFace{false,      Address::Z, Address::X,  Address::I,
                             Address::A, Address::C, kClearanceZ, kGrooveEndX};
constexpr GrooveKind kOnDiameter{true,       Address::X, Address::Z,  Address::K,
                                 Address::C, Address::A, kClearanceX, kGrooveEndZ};

/// A groove by its depth and across it, radii where X is meant.
struct Groove {
  bool cuts_along_x = false;
  double initial = 0, clearance = 0, bottom = 0;  ///< by depth
  double start = 0, end = 0;                      ///< across
  double first = 0, increment = 0;                ///< pecks
  double peckup = 0, peck_clearance = 0;
  double step = 0;
  double relief = 0;  ///< signed, added to the place across
  double side_stock = 0, bottom_stock = 0;
  bool has_width = false;
  Feed feed = Feed::per_minute(Length::mm(0));

  double inward() const { return bottom < clearance ? -1 : 1; }
  double across() const { return end < start ? -1 : 1; }
  double rough_bottom() const { return bottom - inward() * bottom_stock; }
  double rough_start() const { return start + across() * side_stock; }
  double rough_end() const { return end - across() * side_stock; }
  bool has_finish_pass() const { return side_stock > 0 || bottom_stock > 0; }
};

bool refuse(Run& run, Address address, std::string_view why) {
  const Words& words = run.block.words;
  return run.fail(ErrorCode::ParameterOutOfRange, words.has(address) ? words.column(address) : 0,
                  fmt::format("{}{} {}", to_string(address), words[address], why));
}

/// A position by depth or across, from the program's diameters to radii.
double read_place(Run& run, Address address, int parameter, double from, bool is_x) {
  const double scale = is_x ? 2 : 1;
  return cycle_position_word(run, address, parameter, from * scale) / scale;
}

bool read_stock(Run& run, Address address, double& stock) {
  const Words& words = run.block.words;
  if (!words.has(address)) return true;
  stock = words[address];
  return stock >= 0 || refuse(run, address, "is no stock");
}

/// Without an end and a step it is one column of high-speed pecks; the sign of D is then
/// the direction in which the tool backs off; else it backs off toward the start.
bool read_width(Run& run, const GrooveKind& kind, Groove& groove) {
  const Words& words = run.block.words;
  groove.has_width = words.has_any(set_of(kind.end, kind.step));
  groove.end = groove.start;
  const bool has_relief = words.has(Address::D);
  if (!groove.has_width) {
    if (words.has_any(set_of(Address::A, Address::C))) {
      return refuse(run, words.has(Address::A) ? Address::A : Address::C,
                    "is finish stock of a groove that has no width");
    }
    if (has_relief) groove.relief = run.parameters[kRelief] = words[Address::D];
    return true;
  }
  groove.end = read_place(run, kind.end, kind.end_parameter, groove.start, !kind.cuts_along_x);
  if (!cycle_step_word(run, kind.step, kStepOver, groove.step)) return false;
  if (has_relief) run.parameters[kRelief] = words[Address::D];
  const double toward = run.options.groove_relief_goes_on ? 1 : -1;
  groove.relief = toward * groove.across() * run.parameters[kRelief];
  return true;
}

bool read_depths(Run& run, const GrooveKind& kind, Groove& groove) {
  const bool is_x = kind.cuts_along_x;
  run.parameters[kInitialLevel] = groove.initial * (is_x ? 2 : 1);
  groove.clearance = read_place(run, Address::R, kind.clearance_parameter, groove.initial, is_x);
  groove.bottom = read_place(run, kind.bottom, kFinalDepth, groove.clearance, is_x);
  if (groove.bottom == groove.clearance) return refuse(run, kind.bottom, "is no depth below R");
  if (!cycle_step_word(run, Address::Q, kPeckIncrement, groove.increment)) return false;
  if (!run.block.words.has(Address::V)) {
    run.parameters[kFirstDepth] =
        (groove.clearance + groove.inward() * groove.increment) * (is_x ? 2 : 1);
  }
  groove.first = read_place(run, Address::V, kFirstDepth, groove.clearance, is_x);
  if ((groove.first - groove.clearance) * groove.inward() > 0) return true;
  return refuse(run, Address::V, "is not after R");
}

bool check_places(Run& run, const Groove& groove) {
  for (const double depth : {groove.clearance, groove.bottom}) {
    for (const double across : {groove.start, groove.end}) {
      const Point at = groove.cuts_along_x ? Point{depth, across} : Point{across, depth};
      if (!check_target(run, at)) return false;
    }
  }
  return true;
}

bool read_groove(Run& run, const GrooveKind& kind, Groove& groove) {
  groove.cuts_along_x = kind.cuts_along_x;
  const Point at = cycle_position(run);
  groove.initial = kind.cuts_along_x ? at.x : at.z;
  groove.start = kind.cuts_along_x ? at.z : at.x;
  if (!read_depths(run, kind, groove) || !read_width(run, kind, groove)) return false;
  if (!cycle_length_word(run, Address::U, kPeckup, groove.peckup)) return false;
  if (!cycle_length_word(run, Address::E, kPeckClearance, groove.peck_clearance)) return false;
  if (!read_stock(run, kind.end_stock, groove.side_stock)) return false;
  if (!read_stock(run, kind.bottom_stock, groove.bottom_stock)) return false;
  if (groove.has_width && 2 * groove.side_stock > std::fabs(groove.end - groove.start)) {
    return refuse(run, kind.end_stock, "leaves nothing to rough between the sides");
  }
  if (groove.bottom_stock >= std::fabs(groove.bottom - groove.clearance)) {
    return refuse(run, kind.bottom_stock, "leaves nothing to rough above the bottom");
  }
  return check_places(run, groove) && cycle_feed_word(run, groove.feed);
}

/// The moves of one groove.
class GrooveCutter {
 public:
  GrooveCutter(Run& run, const Groove& groove)
      : run_(run), groove_(groove), across_(groove.start) {}

  double column_count() const {
    const double width = std::fabs(groove_.rough_end() - groove_.rough_start());
    return width > 0 ? std::ceil(width / groove_.step - kSame) + 1 : 1;
  }
  double pecks_after_first() const {
    const double left = (groove_.rough_bottom() - groove_.first) * groove_.inward();
    return left > 0 ? std::ceil(left / groove_.increment - kSame) : 0;
  }

  void cut() {
    const double columns = column_count();
    cycle_rapid_to_clearance(run_, at(groove_.clearance));
    for (double column = 0; column < columns; ++column) {
      across_ = column + 1 == columns
                    ? groove_.rough_end()
                    : groove_.rough_start() + groove_.across() * column * groove_.step;
      rapid(groove_.clearance);
      cut_column(has_room_beside(column, columns));
    }
    if (groove_.has_finish_pass()) finish();
    if (!run_.state.modes.returns_to_clearance) rapid(groove_.initial);
  }

 private:
  Point at(double depth) const {
    return groove_.cuts_along_x ? Point{depth, across_} : Point{across_, depth};
  }
  void rapid(double depth) { cycle_rapid(run_, at(depth)); }
  void feed(double depth) { cycle_feed(run_, at(depth), groove_.feed); }

  /// `by` outwards from `depth`, but not above the clearance.
  double above(double depth, double by) const {
    const double out = depth - groove_.inward() * by;
    const bool is_out = (out - groove_.clearance) * groove_.inward() < 0;
    return is_out ? groove_.clearance : out;
  }

  /// Whether there is room to back off: the first column has the groove's wall on the side of the
  /// start, the last one on the side of the end.
  bool has_room_beside(double column, double columns) const {
    if (!groove_.has_width) return true;
    return groove_.relief * groove_.across() < 0 ? column > 0 : column + 1 < columns;
  }

  void cut_column(bool has_relief) {
    const double pecks = pecks_after_first();
    const double bottom = groove_.rough_bottom();
    double depth = pecks == 0 ? bottom : groove_.first;
    feed(depth);
    for (double peck = 1; peck <= pecks; ++peck) {
      rapid(above(depth, groove_.peckup));
      if (groove_.peck_clearance < groove_.peckup) rapid(above(depth, groove_.peck_clearance));
      depth = peck == pecks ? bottom : groove_.first + groove_.inward() * peck * groove_.increment;
      feed(depth);
    }
    if (has_relief) {
      across_ += groove_.relief;
      rapid(bottom);
    }
    rapid(groove_.clearance);
  }

  /// Down the end side, along the bottom to the middle, out; down the start side, along the whole
  /// bottom, out.
  void finish() {
    across_ = groove_.end;
    rapid(groove_.clearance);
    feed(groove_.bottom);
    across_ = (groove_.start + groove_.end) / 2;
    feed(groove_.bottom);
    rapid(groove_.clearance);
    across_ = groove_.start;
    rapid(groove_.clearance);
    feed(groove_.bottom);
    across_ = groove_.end;
    feed(groove_.bottom);
    rapid(groove_.clearance);
  }

  Run& run_;
  const Groove& groove_;
  double across_;
};

bool cut_groove(Run& run) {
  const bool is_face = run.axis_code() == 74;
  Groove groove;
  if (!read_groove(run, is_face ? kOnFace : kOnDiameter, groove)) return false;
  GrooveCutter cutter(run, groove);
  const double moves_of_column = 3 * cutter.pecks_after_first() + 4;
  if (!check_cycle_length(run, cutter.column_count() * moves_of_column + 12)) return false;
  if (!check_cycle_spindle(run)) return false;
  cutter.cut();
  return true;
}

}  // namespace

bool run_groove_cycle(Run& run) {
  return run_canned_cycle(run, cut_groove);
}

}  // namespace dripline::interpreter::centurion
