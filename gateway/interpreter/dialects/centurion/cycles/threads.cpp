#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"

#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"

namespace dripline::interpreter::centurion {

namespace {

constexpr int kLeadChange = 100;
constexpr int kMethod = 105;
constexpr int kHeight = 106;
constexpr int kFirstThreadCut = 107;
constexpr int kNoseAngle = 108;
constexpr int kTaper = 125;
constexpr int kMinimumCut = 130;
constexpr int kFinishPasses = 131;
constexpr int kMaxPasses = 400;  // of five moves each: kMaxCycleMoves
constexpr std::uint8_t kVariableLead = 34;

/// The thread that G76 cuts; lengths in program units, all as radii.
struct MultipleThread {
  Point start;
  Point root;  ///< end of the thread at its full depth
  double taper = 0;
  double height = 0;
  double first_cut = 0;
  double minimum_cut = 0;
  double flank = 0;  ///< Z for each unit of depth left
  bool equal_depths = false;
  bool both_edges = false;
  int finish_passes = 1;
};

void keep_end(Run& run, const Point& end, double taper) {
  run.parameters[kEndPoint] = end.z - run.state.origin.z;
  run.parameters[kDiameter] = (end.x - run.state.origin.x) * 2;
  run.parameters[kTaper] = taper;
}

double taper_of(const Run& run) {
  return run.block.words.has(Address::I) ? run.block.words[Address::I] : 0;
}

bool refuse_parameter(Run& run, const char* what, double value, const char* limit) {
  return run.fail(ErrorCode::ParameterOutOfRange, motion_column(run),
                  fmt::format("{} {} is not {}", what, value, limit));
}

bool read_method(Run& run, MultipleThread& thread) {
  const double method = word_or_parameter(run, Address::P, kMethod);
  if (method != 1 && method != 2 && method != 3 && method != 4) {
    return refuse_parameter(run, "method P", method, "1, 2, 3 or 4");
  }
  thread.both_edges = method == 2 || method == 4;
  thread.equal_depths = method >= 3;
  const double angle = word_or_parameter(run, Address::A, kNoseAngle);
  if (!(angle >= 0 && angle < 180)) return refuse_parameter(run, "nose angle A", angle, "0 to 180");
  thread.flank = std::tan(angle / 2 * (Angle::kPi / 180));
  return true;
}

bool read_depths(Run& run, MultipleThread& thread) {
  thread.height = word_or_parameter(run, Address::K, kHeight);
  if (!(thread.height > 0)) return refuse_parameter(run, "height K", thread.height, "above 0");
  thread.first_cut = word_or_parameter(run, Address::D, kFirstThreadCut);
  if (!(thread.first_cut > 0)) {
    return refuse_parameter(run, "first cut D", thread.first_cut, "above 0");
  }
  thread.minimum_cut = run.parameters[kMinimumCut];
  if (!(thread.minimum_cut >= 0)) {
    return refuse_parameter(run, "minimum cut P130 =", thread.minimum_cut, "0 or more");
  }
  const double passes = run.parameters[kFinishPasses];
  if (!(passes >= 0 && passes <= kMaxPasses) || passes != std::trunc(passes)) {
    return refuse_parameter(run, "finish passes P131 =", passes, "a whole number from 0 to 400");
  }
  thread.finish_passes = passes > 1 ? static_cast<int>(passes) : 1;
  return true;
}

bool read_multiple_thread(Run& run, MultipleThread& thread) {
  Target target;
  if (!read_cycle_target(run, target)) return false;
  thread.start = run.state.position;
  thread.root = target.to;
  thread.taper = taper_of(run);
  if (thread.start.x == thread.root.x) {
    return run.fail(ErrorCode::IllegalStatement, motion_column(run),
                    "the start X must be outside or inside of the root X");
  }
  keep_end(run, target.to, thread.taper);
  return read_method(run, thread) && read_depths(run, thread);
}

/// The depth of a pass after one that was `before` deep.
double next_depth(const MultipleThread& thread, int pass, double before) {
  const double planned =
      thread.first_cut * (thread.equal_depths ? pass : std::sqrt(static_cast<double>(pass)));
  const double depth = std::fmax(planned, before + thread.minimum_cut);
  constexpr double kNothingLeft = 1e-9;
  return depth >= thread.height - kNothingLeft ? thread.height : depth;
}

/// Where the pass at `depth` runs. On one edge the tool slides down that flank and ends at the
/// programmed Z; on both it changes flanks with each pass. The taper is that of the whole
/// thread, wherever the pass begins.
ThreadPass pass_at(const MultipleThread& thread, int pass, double depth) {
  const double out = thread.start.x > thread.root.x ? 1 : -1;
  const double direction = thread.root.z >= thread.start.z ? 1 : -1;
  const double left = thread.height - depth;
  const double flank = thread.both_edges && pass % 2 == 0 ? thread.flank : -thread.flank;
  const double x = thread.root.x + out * left;
  const double start_z = thread.start.z + direction * left * flank;
  const double length = thread.root.z - thread.start.z;
  const double taper =
      length == 0 ? thread.taper : thread.taper * (thread.root.z - start_z) / length;
  return {thread.start, {x + taper, start_z}, {x, thread.root.z}};
}

bool count_passes(Run& run, const MultipleThread& thread) {
  int passes = thread.finish_passes - 1;
  for (double depth = 0; depth < thread.height;) {
    if (++passes > kMaxPasses) {
      return run.fail(ErrorCode::CycleTooLong, 0,
                      fmt::format("height K{} with first cut D{} takes more than {} passes",
                                  thread.height, thread.first_cut, kMaxPasses));
    }
    depth = next_depth(thread, passes - thread.finish_passes + 1, depth);
  }
  return true;
}

Length path_of(const Run& run, const Target& target, const std::optional<PathArc>& arc) {
  if (!arc) return run.length(distance(run.state.position, target.to));
  const Length radius = hypot(run.length(target.to.z) - arc->center_first,
                              run.length(target.to.x) - arc->center_second);
  return radius * arc->sweep.radians();
}

/// After G40 the next move leads the tool to the program's point, and would be tapered.
bool begins_at_program(Run& run) {
  if (!run.state.uses_compensator || run.block.is_back_line()) return true;
  if (!run.flush_path()) return false;
  return is_at_program(run) || run.fail(ErrorCode::IllegalStatement, motion_column(run),
                                        "a thread ends compensation: G40 needs a move before it");
}

}  // namespace

bool takes_lead(const Run& run) {
  const unsigned code = run.axis_code();
  return run.block.parts.thread_code != 0 || code == 92 || code == 76;
}

void take_lead_change(Run& run) {
  if (run.block.parts.thread_code != kVariableLead || !run.block.words.has(Address::K)) return;
  if (run.state.modes.motion >= MotionMode::Clockwise) return;  // K is the center
  run.parameters[kLeadChange] = run.block.words[Address::K];
  run.block.words.drop(Address::K);
}

bool thread_to(Run& run, const Target& target, const std::optional<PathArc>& arc) {
  Lead lead;
  if (!read_lead(run, lead) || !begins_at_program(run)) return false;
  if (!arc && target.to == run.state.position) return true;
  Thread event;
  event.origin = run.origin;
  event.lead = run.length(lead.length);
  event.arc = arc;
  if (lead.shift) event.start_angle = Angle::degrees(*lead.shift);
  if (run.block.parts.thread_code == kVariableLead) {
    event.lead_change = run.length(run.parameters[kLeadChange]);
    const double path = path_of(run, target, arc).mm();
    if (event.lead.mm() * event.lead.mm() + 2 * event.lead_change.mm() * path <= 0) {
      return refuse_parameter(run, "change of lead", run.parameters[kLeadChange],
                              "so small that the lead stays above 0");
    }
  }
  event.to = event_position(run, target.to, target.named);
  if (arc) run.state.moved_axes = 3;
  announce_back(run);
  run.events().on_thread(event);
  arrive(run, target.to, target.named);
  return true;
}

bool cut_single_thread(Run& run) {
  Target target;
  Lead lead;
  ThreadChamfer chamfer;
  if (!read_cycle_target(run, target) || !read_lead(run, lead) || !read_chamfer(run, chamfer)) {
    return false;
  }
  const Point start = run.state.position;
  const double taper = taper_of(run);
  const ThreadPass pass{start, {target.to.x + taper, start.z}, target.to};
  if (!check_pass(run, pass, chamfer)) return false;
  keep_end(run, target.to, taper);
  cut_pass(run, pass, chamfer, lead);
  return true;
}

bool cut_multiple_thread(Run& run) {
  MultipleThread thread;
  Lead lead;
  ThreadChamfer chamfer;
  if (!read_multiple_thread(run, thread) || !read_lead(run, lead) || !read_chamfer(run, chamfer) ||
      !count_passes(run, thread) || !check_pass(run, pass_at(thread, 1, 0), chamfer) ||
      !check_pass(run, pass_at(thread, 1, thread.height), chamfer)) {
    return false;
  }
  double depth = 0;
  for (int pass = 1; depth < thread.height; ++pass) {
    depth = next_depth(thread, pass, depth);
    cut_pass(run, pass_at(thread, pass, depth), chamfer, lead);
  }
  for (int pass = 1; pass < thread.finish_passes; ++pass) {
    cut_pass(run, pass_at(thread, pass, thread.height), chamfer, lead);
  }
  return true;
}

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
  arrive(run, to, kBothAxes);
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
  if (!check_uncompensated(run, "a thread")) return false;
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
