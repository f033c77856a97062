#include "gateway/interpreter/dialects/rs274ngc/cycles/cycles.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// Holes of one line, or pecks in all of them: keeps the events of a line bounded.
constexpr double kMaxStrokes = 10'000;

/// One line's cycle while it is made. Millimeters, program coordinates.
class CycleRun {
 public:
  CycleRun(Run& run, const CycleRow& row)
      : run_(run), row_(row), axes_(axes_of(run.state.modes.plane)) {}

  bool check_line();
  bool read_words();
  bool make();

 private:
  bool check_sticky(bool is_missing, const DiagnosticRow& code, const char* what);
  bool check_words_of_code();
  bool place_heights();
  void raise_to_r();
  bool place_next_hole();
  bool make_hole(double height);
  bool make_step(Step step);
  bool peck(bool goes_out);
  void back_bore();

  void rapid(double first, double second, double height) { move(first, second, height, true); }
  void move(double first, double second, double height, bool is_rapid);
  void rapid_height(double height) { move(first_, second_, height, true); }
  void feed_height(double height) { move(first_, second_, height, false); }

  double present(Axis axis) const { return run_.state[axis]; }
  const Words& words() const { return run_.block.words; }

  Run& run_;
  const CycleRow& row_;
  PlaneAxes axes_;
  SpindleState spindle_ = SpindleState::Off;
  double first_ = 0, second_ = 0;
  double first_step_ = 0, second_step_ = 0;
  double r_ = 0, bottom_ = 0, clear_ = 0;
  double level_ = 0;    ///< G98 goes back to it
  double present_ = 0;  ///< height at the start
  double repeats_ = 1;
  bool has_place_ = false;  ///< by polar words
};

void CycleRun::move(double first, double second, double height, bool is_rapid) {
  Target target;
  target.to = run_.state.position;
  const auto put = [&](Axis axis, double value) {
    double& coordinate = target.to[index_of(axis)];
    if (coordinate == value) return;
    coordinate = value;
    target.named = static_cast<AxisBits>(target.named | bit_of(axis));
  };
  put(axes_.first, first);
  put(axes_.second, second);
  put(axes_.normal, height);
  move_to(run_, target, is_rapid, run_.modal_feed());
}

bool CycleRun::check_line() {
  const State& state = run_.state;
  if (words().has_any(set_of("ABC"))) return run_.fail(ErrorCode::CycleRotary, 0);
  if (state.modes.has_tilted_plane) return run_.fail(ErrorCode::CyclePlane, 0);
  if (state.modes.feed == FeedMode::InverseTime) return run_.fail(ErrorCode::CycleG93, 0);
  if (state.compensation.side != Side::Off) return run_.fail(ErrorCode::CycleComp, 0);
  if (state.feed == 0) return run_.fail(ErrorCode::ZeroFeedCycle, 0);
  if (!check_polar_words(run_)) return false;
  if (words().has('L')) {
    repeats_ = words()['L'];
    if (repeats_ < 1) return run_.fail_word(ErrorCode::ZeroRepeats, 'L');
    if (repeats_ > kMaxStrokes) {
      return run_.fail_word(ErrorCode::NotSupported, 'L',
                            fmt::format("more than {} holes", kMaxStrokes));
    }
  }
  return true;
}

bool CycleRun::check_sticky(bool is_missing, const DiagnosticRow& code, const char* what) {
  if (!is_missing || run_.state.modes.motion == row_.code) return true;
  return run_.fail(code, 0, fmt::format("G{} needs {}", row_.code / 10.0, what));
}

/// The later program finds these missing only when it has gone up to R.
bool CycleRun::check_words_of_code() {
  const bool has_offsets = words().has('I') && words().has('J') && words().has('K');
  return check_sticky(row_.needs_p() && !words().has('P'), ErrorCode::CycleMissingP, "P") &&
         check_sticky(row_.has(Step::Peck, Step::Chip) && !words().has('Q'),
                      ErrorCode::CycleMissingQ, "Q") &&
         check_sticky(row_.has(Step::BackBore) && !has_offsets, ErrorCode::CycleMissingIjk,
                      "I, J and K");
}

/// Words of this line, or those that stay in force while the same code does.
bool CycleRun::read_words() {
  CycleWords& cycle = run_.state.cycle;
  const std::string bottom(1, letter(axes_.normal));
  if (!check_sticky(!words().has('R'), ErrorCode::CycleRMissing, "R") ||
      !check_sticky(!words().has(letter(axes_.normal)), ErrorCode::CycleDepthMissing,
                    bottom.c_str()) ||
      (!run_.is_linuxcnc() && !check_words_of_code())) {
    return false;
  }
  run_.ledger.take(set_of(letter(axes_.first)) | set_of(letter(axes_.second)) |
                   set_of(letter(axes_.normal)) | kPolarWords);
  cycle.r = words().value_or('R', cycle.r);
  cycle.bottom = words().value_or(letter(axes_.normal), cycle.bottom);
  cycle.p = words().value_or('P', cycle.p);
  cycle.q = words().value_or('Q', cycle.q);
  cycle.d = words().value_or('D', 0);
  if (row_.has(Step::BackBore)) {
    cycle.i = words().value_or('I', cycle.i);
    cycle.j = words().value_or('J', cycle.j);
    cycle.k = words().value_or('K', cycle.k);
  }
  spindle_ = run_.state.spindle.state;
  if (row_.code == 840 && spindle_ != SpindleState::Clockwise) {
    return run_.fail(ErrorCode::SpindleG84, 0);
  }
  if (row_.code == 740 && spindle_ != SpindleState::Counterclockwise) {
    return run_.fail(ErrorCode::SpindleCycle, 0, "G74 needs it counterclockwise");
  }
  if (row_.uses_spindle() && !run_.state.spindle.is_turning()) {
    return run_.fail(ErrorCode::SpindleCycle, 0, fmt::format("G{}", row_.code / 10.0));
  }
  return place_heights();
}

bool CycleRun::place_heights() {
  const State& state = run_.state;
  CycleWords& cycle = run_.state.cycle;
  const bool is_later = run_.is_linuxcnc();
  present_ = present(axes_.normal);
  if (!cycle.is_series || !is_later) cycle.initial = present_;
  cycle.is_series = true;
  level_ = cycle.initial;
  first_ = present(axes_.first);
  second_ = present(axes_.second);
  const double first = run_.mm(words().value_or(letter(axes_.first), 0));
  const double second = run_.mm(words().value_or(letter(axes_.second), 0));
  r_ = run_.mm(cycle.r);
  bottom_ = run_.mm(cycle.bottom);
  if (state.modes.is_incremental) {
    first_step_ = first;
    second_step_ = second;
    r_ += level_;
    bottom_ += r_;
  } else {
    if (words().has(letter(axes_.first))) first_ = first;
    if (words().has(letter(axes_.second))) second_ = second;
  }
  if (r_ >= bottom_) return true;
  return run_.fail(ErrorCode::CycleRBelow, 0,
                   fmt::format("R {} is below {} {}", cycle.r, letter(axes_.normal), cycle.bottom));
}

void CycleRun::raise_to_r() {
  if (level_ < r_) {
    rapid(present(axes_.first), present(axes_.second), r_);
    level_ = present_ = r_;
  }
  clear_ = run_.state.modes.retracts_to_start ? level_ : r_;
}

bool CycleRun::make() {
  raise_to_r();
  if (run_.is_linuxcnc() && !check_words_of_code()) return false;
  // The first hole is reached at the height where the tool is, the others at the clear one.
  double height = present_ > r_ || !run_.is_linuxcnc() ? present_ : clear_;
  for (double left = repeats_; left > 0; --left) {
    if (!place_next_hole() || !make_hole(height)) return false;
    height = clear_;
  }
  // G88 leaves the tool to the operator; it is taken to be clear afterwards.
  if (present(axes_.normal) != clear_) {
    run_.state[axes_.normal] = clear_;
    run_.state.is_displaced = true;
    run_.state.machine = to_machine(run_, run_.state.position);
  }
  return true;
}

/// Polar words count from the hole before in G91; in G90 all repeats are at one place.
bool CycleRun::place_next_hole() {
  first_ += first_step_;
  second_ += second_step_;
  const bool is_placed = has_place_ && !run_.state.modes.is_incremental;
  if (is_placed || !words().has_any(kPolarWords)) return true;
  has_place_ = true;
  Target target;
  if (!read_target(run_, target)) return false;
  first_ = target.to[index_of(Axis::X)];
  second_ = target.to[index_of(Axis::Y)];
  return true;
}

bool CycleRun::make_hole(double height) {
  rapid(first_, second_, height);
  rapid_height(r_);
  const bool is_tap = row_.code == 740 || row_.code == 840;
  if (is_tap) run_.events().on_override_inhibit(tapping_lock(run_.origin));
  for (const Step step : row_.steps) {
    if (step == Step::End) break;
    if (!make_step(step)) return false;
  }
  if (is_tap) run_.events().on_override_inhibit(override_inhibit(run_));
  return true;
}

bool CycleRun::make_step(Step step) {
  switch (step) {
    case Step::FeedToBottom:
      feed_height(bottom_);
      return true;
    case Step::FeedToClear:
      feed_height(clear_);
      return true;
    case Step::FeedToR:
      feed_height(r_);
      return true;
    case Step::RapidToClear:
      rapid_height(clear_);
      return true;
    case Step::Dwell:
    case Step::DwellIfGiven:
      if (run_.state.cycle.p > 0) run_.events().on_dwell({run_.origin, run_.state.cycle.p, {}});
      return true;
    case Step::SpindleStop:
      turn_spindle(run_, SpindleState::Off);
      return true;
    case Step::SpindleReverse:
      turn_spindle(run_, spindle_ == SpindleState::Clockwise ? SpindleState::Counterclockwise
                                                             : SpindleState::Clockwise);
      return true;
    case Step::SpindleRestore:
      turn_spindle(run_, spindle_);
      return true;
    case Step::OperatorStop:
      run_.events().on_stop({run_.origin, StopKind::Operator});
      return true;
    case Step::Peck:
      return peck(true);
    case Step::Chip:
      return peck(false);
    case Step::BackBore:
      back_bore();
      return true;
    case Step::End:
      break;
  }
  return true;
}

bool CycleRun::peck(bool goes_out) {
  const double depth = run_.mm(run_.state.cycle.q);
  if (!(depth > 0)) {
    return run_.fail_word(ErrorCode::NegativeQ, 'Q', fmt::format("Q{}", run_.state.cycle.q));
  }
  if (repeats_ * (r_ - bottom_) / depth > kMaxStrokes) {
    return run_.fail_word(ErrorCode::NotSupported, 'Q',
                          fmt::format("more than {} pecks", kMaxStrokes));
  }
  const double usual = run_.state.units == Units::Inch ? 0.01 : 0.254;
  const double back = run_.mm(run_.state.cycle.d > 0 ? run_.state.cycle.d : usual);
  for (double at = r_ - depth; at > bottom_; at -= depth) {
    feed_height(at);
    if (goes_out) rapid_height(run_.is_linuxcnc() ? r_ : clear_);
    rapid_height(at + back);
  }
  feed_height(bottom_);
  return true;
}

/// Through the hole beside it, and up against the work from below.
void CycleRun::back_bore() {
  const auto word = [&](char letter) {
    const CycleWords& cycle = run_.state.cycle;
    return run_.mm(letter == 'I' ? cycle.i : letter == 'J' ? cycle.j : cycle.k);
  };
  const double first = first_ + word(offset_word(axes_.first));
  const double second = second_ + word(offset_word(axes_.second));
  const double top =
      word(offset_word(axes_.normal)) + (run_.state.modes.is_incremental ? bottom_ : 0);
  rapid(first, second, r_);
  turn_spindle(run_, SpindleState::Oriented);
  rapid(first, second, bottom_);
  rapid_height(bottom_);
  turn_spindle(run_, spindle_);
  feed_height(top);
  feed_height(bottom_);
  turn_spindle(run_, SpindleState::Oriented);
  rapid(first, second, bottom_);
  rapid(first, second, clear_);
  rapid_height(clear_);
  turn_spindle(run_, spindle_);
}

}  // namespace

bool execute_cycle(Run& run, int g_code) {
  CycleRun cycle(run, cycle_row(g_code, run.is_linuxcnc()));
  return cycle.check_line() && cycle.read_words() && cycle.make();
}

}  // namespace dripline::interpreter::rs274ngc
