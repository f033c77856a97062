#include "gateway/interpreter/rs274ngc/thread.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/rs274ngc/machine_functions.hpp"
#include "gateway/interpreter/rs274ngc/motion.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

bool is_turning(const Run& run) {
  const SpindleState state = run.state.spindle.state;
  return state == SpindleState::Clockwise || state == SpindleState::CounterClockwise;
}

void thread_to(Run& run, const Target& target, double lead_mm) {
  if (target.to == run.state.position) return;
  const Position& to = arrive(run, target);
  run.events().on_thread({run.origin, to, Length::mm(lead_mm), {}});
}

bool check_synchronised(Run& run) {
  const Words& words = run.block.words;
  if (words.has('F')) return run.fail_word(ErrorCode::ThreadF, 'F');
  if (!(words.value_or('K', 0) > 0)) return run.fail_word(ErrorCode::ThreadK, 'K');
  if (!is_turning(run)) return run.fail(ErrorCode::ThreadSpindle, 0);
  if (run.state.compensation.side == Side::Off) return true;
  return run.fail(ErrorCode::CompNotAllowed, 0, "a synchronised move");
}

/// G76 in millimetres (words of 16.5).
struct ThreadCycle {
  double pitch, peak, first_depth, full_depth, degression, angle, taper_length;
  int spring_passes, taper;
  double start_x, start_z, end_z, drive_x;
};

bool read_cycle(Run& run, ThreadCycle& cycle) {
  const Words& words = run.block.words;
  const State& state = run.state;
  for (const char needed : {'P', 'Z', 'I', 'J', 'K'}) {
    if (!words.has(needed))
      return run.fail(ErrorCode::ThreadWords, 0, fmt::format("no {}", needed));
  }
  cycle.pitch = run.mm(words['P']);
  cycle.peak = run.mm(words['I']);
  cycle.first_depth = run.mm(words['J']);
  cycle.full_depth = run.mm(words['K']);
  cycle.degression = words.value_or('R', 1);
  cycle.angle = words.value_or('Q', 0) * (Angle::kPi / 180);
  cycle.spring_passes = static_cast<int>(std::round(words.value_or('H', 0)));
  cycle.taper_length = run.mm(words.value_or('E', 0));
  cycle.taper = static_cast<int>(words.value_or('L', 0));
  cycle.start_x = state[Axis::X];
  cycle.start_z = state[Axis::Z];
  cycle.drive_x = cycle.start_x;
  Target target;
  if (!read_target(run, target)) return false;
  cycle.end_z = target.to[index_of(Axis::Z)];
  const bool is_sane = cycle.pitch > 0 && cycle.peak != 0 && cycle.first_depth > 0 &&
                       cycle.full_depth > cycle.first_depth && cycle.degression >= 1 &&
                       cycle.spring_passes >= 0 && cycle.spring_passes <= 100 && cycle.taper >= 0 &&
                       cycle.taper <= 3 && std::fabs(cycle.angle) < Angle::kPi / 2;
  return is_sane || run.fail(ErrorCode::ThreadWords, 0, "a word is out of range");
}

class ThreadPasses {
 public:
  ThreadPasses(Run& run, const ThreadCycle& cycle) : run_(run), cycle_(cycle) {}

  /// Depths by degression, then the finish and its spring passes.
  bool make() {
    constexpr int kMostPasses = 1000;
    double depth = cycle_.first_depth;
    int pass = 1;
    while (depth < cycle_.full_depth) {
      make_pass(depth);
      if (++pass > kMostPasses) {
        return run_.fail(ErrorCode::ThreadWords, 0,
                         fmt::format("more than {} passes", kMostPasses));
      }
      depth = cycle_.first_depth * std::pow(pass, 1 / cycle_.degression);
    }
    for (int i = 0; i <= cycle_.spring_passes; ++i) make_pass(cycle_.full_depth);
    return true;
  }

 private:
  double sign() const { return cycle_.peak > 0 ? 1 : -1; }
  void rapid(double x, double z) { rapid_to(run_, target(x, z)); }
  void cut(double x, double z) { thread_to(run_, target(x, z), cycle_.pitch); }
  Target target(double x, double z) const {
    Target to;
    to.to = run_.state.position;
    to.to[index_of(Axis::X)] = x;
    to.to[index_of(Axis::Z)] = z;
    to.named = static_cast<AxisBits>(bit_of(Axis::X) | bit_of(Axis::Z));
    return to;
  }
  /// Depth counts from the peak; an external thread (I negative) goes to smaller X.
  double x_at(double depth) const { return cycle_.drive_x + cycle_.peak + sign() * depth; }
  /// The flank that cuts is chosen by moving the start along Z.
  void make_pass(double depth) {
    const double shift = (depth - cycle_.full_depth) * std::tan(cycle_.angle);
    const double toward = cycle_.end_z < cycle_.start_z ? -1 : 1;
    const double begin = cycle_.start_z + toward * shift;
    const double end = cycle_.end_z + toward * shift;
    const double taper = cycle_.taper_length;
    const bool tapers_in = (cycle_.taper & 1) != 0 && taper > 0;
    const bool tapers_out = (cycle_.taper & 2) != 0 && taper > 0;
    rapid(cycle_.drive_x, begin);
    rapid(tapers_in ? x_at(0) : x_at(depth), begin);
    if (tapers_in) cut(x_at(depth), begin + toward * taper);
    cut(x_at(depth), tapers_out ? end - toward * taper : end);
    if (tapers_out) cut(x_at(0), end);
    rapid(cycle_.drive_x, end);
    rapid(cycle_.drive_x, cycle_.start_z);
  }

  Run& run_;
  const ThreadCycle& cycle_;
};

}  // namespace

bool synchronised_move(Run& run, int g_code) {
  if (!check_synchronised(run)) return false;
  Target target;
  if (!read_target(run, target)) return false;
  const double lead = run.mm(run.block.words['K']);
  if (g_code == 330) {
    thread_to(run, target, lead);
    return true;
  }
  const SpindleState turning = run.state.spindle.state;
  const SpindleState other =
      turning == SpindleState::Clockwise ? SpindleState::CounterClockwise : SpindleState::Clockwise;
  Target back;
  back.to = run.state.position;
  back.named = target.named;
  thread_to(run, target, lead);
  turn_spindle(run, other);
  thread_to(run, back, lead);
  turn_spindle(run, turning);
  return true;
}

bool thread_cycle(Run& run) {
  if (run.state.modes.plane != Plane::ZX)
    return run.fail(ErrorCode::ThreadWords, 0, "G76 needs G18");
  if (run.state.compensation.side != Side::Off) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "G76");
  }
  if (!is_turning(run)) return run.fail(ErrorCode::ThreadSpindle, 0, "G76");
  ThreadCycle cycle{};
  return read_cycle(run, cycle) && ThreadPasses(run, cycle).make();
}

}  // namespace dripline::interpreter::rs274ngc
