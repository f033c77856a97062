#include "gateway/interpreter/dialects/rs274ngc/cycles/cycles.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

void thread_to(Run& run, const Target& target, double lead_mm) {
  if (target.to == run.state.position) return;
  const Position& to = arrive(run, target);
  run.events().on_thread({run.origin, to, Length::mm(lead_mm), {}});
}

bool check_synchronized(Run& run) {
  const Words& words = run.block.words;
  if (words.has('F')) return run.fail_word(ErrorCode::ThreadF, 'F');
  if (!(words.value_or('K', 0) > 0)) return run.fail_word(ErrorCode::ThreadK, 'K');
  if (!run.state.spindle.is_turning()) return run.fail(ErrorCode::ThreadSpindle, 0);
  if (!shifts_moves(run)) return true;
  return run.fail(ErrorCode::CompNotAllowed, 0, "a synchronized move");
}

/// G76 in millimeters. Depths count from the peak, across the drive line.
struct ThreadCycle {
  double pitch, peak, first_depth, full_depth, degression, angle, taper_length;
  int spring_passes, taper;
  double drive_x, start_z, end_z;
};

bool is_sane(const ThreadCycle& cycle) {
  return cycle.pitch > 0 && cycle.peak != 0 && cycle.first_depth > 0 &&
         cycle.full_depth > cycle.first_depth && cycle.degression >= 1 &&
         cycle.spring_passes >= 0 && cycle.spring_passes <= 100 && cycle.taper >= 0 &&
         cycle.taper <= 3 && std::fabs(cycle.angle) < Angle::kPi / 2 && cycle.taper_length >= 0 &&
         2 * cycle.taper_length <= std::fabs(cycle.end_z - cycle.start_z);
}

bool read_cycle(Run& run, ThreadCycle& cycle) {
  const Words& words = run.block.words;
  const State& state = run.state;
  for (const char needed : {'P', 'Z', 'I', 'J', 'K'}) {
    if (!words.has(needed))
      return run.fail(ErrorCode::ThreadWords, 0, fmt::format("no {}", needed));
  }
  if (words.has_any(set_of("XYABCUVW@^"))) {
    return run.fail(ErrorCode::ThreadWords, 0, "G76 takes Z alone of the axes");
  }
  // The peer halves them twice there, with G7, or does not at all.
  if (run.block.g(GGroup::Lathe) >= 0)
    return run.fail(ErrorCode::ThreadWords, 0, "G7 and G8 need a line before that of G76");
  const double across = state.modes.is_diameter ? 0.5 : 1;  // I, J, K are diameters with G7
  cycle.pitch = run.mm(words['P']);
  cycle.peak = run.mm(words['I']) * across;
  cycle.first_depth = run.mm(words['J']) * across;
  cycle.full_depth = run.mm(words['K']) * across;
  cycle.degression = words.value_or('R', 1);
  cycle.angle = words.value_or('Q', 0) * (Angle::kPi / 180);
  cycle.spring_passes = static_cast<int>(std::round(words.value_or('H', 0)));
  cycle.taper_length = run.mm(words.value_or('E', 0));
  cycle.taper = static_cast<int>(words.value_or('L', 0));
  cycle.drive_x = state[Axis::X];
  cycle.start_z = state[Axis::Z];
  Target target;
  if (!read_target(run, target)) return false;
  cycle.end_z = target.to[index_of(Axis::Z)];
  return is_sane(cycle) || run.fail(ErrorCode::ThreadWords, 0, "a word is out of range");
}

/// As the peer makes them.
class ThreadPasses {
 public:
  ThreadPasses(Run& run, const ThreadCycle& cycle) : run_(run), cycle_(cycle) {}

  /// Depths by degression, then the finish and its spring passes. Ends on the drive line at the
  /// end.
  bool make() {
    constexpr int kMaxPasses = 1000;
    constexpr double kRounding = 1e-9;  // a last pass that deep is the finish
    double depth = cycle_.first_depth;
    int pass = 1;
    while (depth < cycle_.full_depth * (1 - kRounding)) {
      make_pass(depth);
      if (++pass > kMaxPasses) {
        return run_.fail(ErrorCode::ThreadWords, 0, fmt::format("more than {} passes", kMaxPasses));
      }
      depth = cycle_.first_depth * std::pow(pass, 1 / cycle_.degression);
    }
    for (int i = 0; i <= cycle_.spring_passes; ++i) make_pass(cycle_.full_depth);
    rapid(cycle_.drive_x, cycle_.end_z);
    return true;
  }

 private:
  void rapid(double x, double z) { rapid_to(run_, target(x, z)); }
  void cut(double x, double z, double lead) { thread_to(run_, target(x, z), lead); }
  Target target(double x, double z) const {
    Target to;
    to.to = run_.state.position;
    to.to[index_of(Axis::X)] = x;
    to.to[index_of(Axis::Z)] = z;
    to.named = static_cast<AxisBits>(bit_of(Axis::X) | bit_of(Axis::Z));
    return to;
  }
  /// So far from the drive line; an external thread (I negative) lies at smaller X.
  double x_at(double distance) const {
    return cycle_.drive_x + (cycle_.peak > 0 ? distance : -distance);
  }
  /// Along a taper as long as `taper_length` and as high as the thread.
  double taper_lead() const {
    const double length = cycle_.taper_length;
    return cycle_.pitch * std::hypot(length, cycle_.full_depth) / length;
  }
  /// The flank that cuts is chosen by moving the pass along Z. The tool keeps the same retract out
  /// of every pass: in deep ones to the drive line.
  void make_pass(double depth) {
    const double toward = cycle_.end_z < cycle_.start_z ? -1 : 1;
    const double slope = toward * std::tan(cycle_.angle);
    const double begin = cycle_.start_z + depth * slope;
    const double end = cycle_.end_z + (depth - cycle_.full_depth) * slope;
    const double taper = toward * cycle_.taper_length;
    const bool tapers_in = (cycle_.taper & 1) != 0 && taper != 0;
    const bool tapers_out = (cycle_.taper & 2) != 0 && taper != 0;
    const double bottom = x_at(std::fabs(cycle_.peak) + depth);
    const double top = x_at(std::fabs(cycle_.peak) + depth - cycle_.full_depth);
    const double out = x_at(depth - cycle_.full_depth);
    rapid(out, begin);
    if (tapers_in) {
      cut(top, begin, taper_lead());
      cut(bottom, begin + taper, taper_lead());
    } else {
      rapid(bottom, begin);
    }
    cut(bottom, tapers_out ? end - taper : end, cycle_.pitch);
    if (tapers_out) cut(top, end, taper_lead());
    rapid(out, end);
  }

  Run& run_;
  const ThreadCycle& cycle_;
};

}  // namespace

bool synchronized_move(Run& run, int g_code) {
  if (!check_synchronized(run)) return false;
  Target target;
  if (!read_target(run, target)) return false;
  const double lead = run.mm(run.block.words['K']);
  // The lead of G95 ends with the synchronized one.
  run.state.has_lost_lead = run.is_linuxcnc() && run.state.modes.feed == FeedMode::PerRevolution;
  if (g_code == 330) {
    thread_to(run, target, lead);
    return true;
  }
  const SpindleState turning = run.state.spindle.state;
  const SpindleState other =
      turning == SpindleState::Clockwise ? SpindleState::Counterclockwise : SpindleState::Clockwise;
  Target back;
  back.to = run.state.position;
  back.named = target.named;
  run.events().on_override_inhibit(tapping_lock(run.origin));
  thread_to(run, target, lead);
  // LinuxCNC's I, 1 at least, is how many times as fast it is during the return.
  const double speed = run.state.spindle.speed;
  run.state.spindle.speed *= std::fmax(1, run.block.words.value_or('I', 1));
  turn_spindle(run, other);
  thread_to(run, back, lead);
  run.state.spindle.speed = speed;
  turn_spindle(run, turning);
  run.events().on_override_inhibit(override_inhibit(run));
  return true;
}

bool thread_cycle(Run& run) {
  if (run.state.modes.plane != Plane::ZX)
    return run.fail(ErrorCode::ThreadWords, 0, "G76 needs G18");
  if (run.state.compensation.side != Side::Off) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "G76");
  }
  if (!run.state.spindle.is_turning()) return run.fail(ErrorCode::ThreadSpindle, 0, "G76");
  ThreadCycle cycle{};
  return read_cycle(run, cycle) && ThreadPasses(run, cycle).make();
}

}  // namespace dripline::interpreter::rs274ngc
