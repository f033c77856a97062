#include "gateway/interpreter/dialects/centurion/cycles/thread_words.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/core/override_inhibit.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr int kLead = 101;
constexpr int kShift = 102;
constexpr int kChamferLength = 103;
constexpr int kChamferAngle = 104;

double side_of(const ThreadPass& pass) {
  return pass.start.x >= pass.cut_to.x ? 1 : -1;
}

/// Where the pull-out leaves the thread's line, which may be tapered.
Point chamfer_start(const ThreadPass& pass, const ThreadChamfer& chamfer) {
  const double length = pass.cut_to.z - pass.cut_from.z;
  if (length == 0 || chamfer.along == 0) return pass.cut_to;  // exactly
  const double part = 1 - chamfer.along / std::fabs(length);
  return {pass.cut_from.x + (pass.cut_to.x - pass.cut_from.x) * part,
          pass.cut_from.z + length * part};
}

void thread_to_point(Run& run, const Point& to, const Lead& lead, bool is_start) {
  if (to == run.state.position) return;
  Thread event{run.origin, event_position(run, to, kBothAxes), run.length(lead.length), {}};
  if (is_start && lead.shift) event.start_angle = Angle::degrees(*lead.shift);
  run.events().on_thread(event);
  arrive(run, to);
}

bool refuse_lead(Run& run, Address address) {
  return run.fail(ErrorCode::FeedOutOfRange, run.block.words.column(address),
                  fmt::format("{}{} is no lead", to_string(address), run.block.words[address]));
}

}  // namespace

double word_or_parameter(Run& run, Address address, int number) {
  if (run.block.words.has(address)) run.parameters[number] = run.block.words[address];
  return run.parameters[number];
}

bool read_lead(Run& run, Lead& lead) {
  const Words& words = run.block.words;
  const double most = run.state.units == Units::Inch ? 999.9999 : 99999.99;
  if (words.has(Address::F) && words.has(Address::E)) {
    return run.fail(ErrorCode::IllegalStatement, words.column(Address::E),
                    "a thread has its lead F or its threads per unit E, not both");
  }
  if (words.has(Address::E)) {
    if (!(words[Address::E] > 0)) return refuse_lead(run, Address::E);
    run.parameters[kLead] = 1 / words[Address::E];
  } else if (words.has(Address::F)) {
    if (!(words[Address::F] > 0 && words[Address::F] <= most)) return refuse_lead(run, Address::F);
    run.parameters[kLead] = words[Address::F];
  }
  lead.length = run.parameters[kLead];
  if (!(lead.length > 0)) {
    return run.fail(ErrorCode::FeedOutOfRange, motion_column(run), "no lead was given");
  }
  run.parameters[kShift] = words.has(Address::Q) ? words[Address::Q] : 0;
  if (!words.has(Address::Q)) return true;
  lead.shift = words[Address::Q];
  if (*lead.shift >= 0 && *lead.shift <= 360) return true;
  return run.fail(ErrorCode::ParameterOutOfRange, words.column(Address::Q),
                  fmt::format("start angle Q{} is not in 0 to 360", *lead.shift));
}

bool read_chamfer(Run& run, ThreadChamfer& chamfer) {
  const double length = run.parameters[kChamferLength];
  const double angle = run.parameters[kChamferAngle];
  if (!(length >= 0)) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0,
                    fmt::format("chamfer length P103 = {} is below 0", length));
  }
  if (!(angle >= 0 && angle <= 90)) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0,
                    fmt::format("chamfer angle P104 = {} is not in 0 to 90", angle));
  }
  chamfer.along = length * language::sine(angle).value;
  chamfer.out = length * language::cosine(angle).value;
  return true;
}

bool read_cycle_target(Run& run, Target& target) {
  if (!read_target(run, target)) return false;
  if (target.named.x && target.named.z) return true;
  return run.fail(ErrorCode::IllegalStatement, motion_column(run),
                  target.named.x ? "the cycle needs Z or W" : "the cycle needs X or U");
}

bool check_pass(Run& run, const ThreadPass& pass, const ThreadChamfer& chamfer) {
  const double length = std::fabs(pass.cut_to.z - pass.cut_from.z);
  if (chamfer.along > length) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0,
                    fmt::format("the chamfer P103 = {} begins before the thread of length {}",
                                run.parameters[kChamferLength], length));
  }
  return check_target(run, pass.cut_from) && check_target(run, pass.cut_to);
}

void cut_pass(Run& run, const ThreadPass& pass, const ThreadChamfer& chamfer, const Lead& lead) {
  rapid_to(run, pass.cut_from, kBothAxes);
  const Point pull_out = chamfer_start(pass, chamfer);
  thread_to_point(run, pull_out, lead, true);
  // The pull-out follows in step with the spindle, so it has no start angle of its own.
  thread_to_point(run, {pull_out.x + side_of(pass) * chamfer.out, pass.cut_to.z}, lead,
                  pull_out == pass.cut_from);
  run.events().on_override_inhibit(lock_after_tap(override_inhibit(run)));
  rapid_to(run, {pass.start.x, run.state.position.z}, kBothAxes);
  run.events().on_override_inhibit(override_inhibit(run));
  rapid_to(run, pass.start, kBothAxes);
}

}  // namespace dripline::interpreter::centurion
