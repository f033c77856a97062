#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

/// Threads, and the modal cycles of one cut: G32, G34, and G90, G92, G94 of system A.
namespace dripline::interpreter::fanuc {

Length lead_of_path(const Position& from, const Position& to, double lead) {
  const double x = std::fabs(to.raw(Axis::X) - from.raw(Axis::X));
  const double z = std::fabs(to.raw(Axis::Z) - from.raw(Axis::Z));
  const double longer = std::max(x, z);
  return Length::mm(longer > 0 ? lead * std::hypot(x, z) / longer : lead);
}

namespace {

bool refuse_compensated(Run& run) {
  return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                  "threads and cycles of one cut need G40");
}

std::optional<Angle> start_angle(Run& run) {
  const Words& words = run.block.words;
  run.ledger.take(set_of(Q));
  if (!words.has(Q)) return {};
  return Angle::degrees(run.angle(words[Q]));
}

Position moved(const Position& from, std::optional<double> x, std::optional<double> z) {
  Position to = from;
  if (x) to.set_raw(Axis::X, *x);
  if (z) to.set_raw(Axis::Z, *z);
  return to;
}

bool cut_thread_box(Run& run, const Position& cut, const Position& end, const Position& start) {
  if (!(run.state.feed[1] > 0)) {
    return run.fail(ErrorCode::NoFeed, run.block.words.first_column(kAxisWords));
  }
  const std::optional<Angle> angle = start_angle(run);
  // The manual's limit of R: beyond where X began, the pull-out leads into the work.
  const double depth = end.raw(Axis::X) - start.raw(Axis::X);
  const double rise = cut.raw(Axis::X) - start.raw(Axis::X);
  if (depth == 0 ? rise != 0 : rise * depth < -1e-9 * std::fabs(depth)) {
    return run.fail(ErrorCode::ImproperCommand, run.block.words.column(R),
                    "the taper begins beyond where X is at the cycle's start");
  }
  if (!rapid_to(run, cut)) return false;
  const Length lead = lead_of_path(cut, end, run.state.feed[1]);
  const double out = run.state.turning.thread_chamfer * run.state.feed[1];
  const double along = end.raw(Axis::Z) - cut.raw(Axis::Z);
  if (out > 0 && std::fabs(along) > out) {
    // the pull-out of 45 degrees begins so far before the end, and ends where X began at the latest
    const double part = (std::fabs(along) - out) / std::fabs(along);
    const double x = cut.raw(Axis::X) + part * (end.raw(Axis::X) - cut.raw(Axis::X));
    const double z = cut.raw(Axis::Z) + part * along;
    const double clear = start.raw(Axis::X) - x;
    const double pull = std::fmin(out, std::fabs(clear));
    if (!thread_to(run, moved(cut, x, z), lead, angle)) return false;
    const Position pulled =
        moved(end, x + std::copysign(pull, clear), z + std::copysign(pull, along));
    if (!thread_to(run, pulled, lead_of_path(run.state.position, pulled, run.state.feed[1]), {}))
      return false;
  } else if (!thread_to(run, end, lead, angle)) {
    return false;
  }
  return rapid_to(run, moved(run.state.position, start.raw(Axis::X), {})) && rapid_to(run, start);
}

}  // namespace

bool cut_turned_thread(Run& run, const Position& to) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  if (state.is_compensating()) return refuse_compensated(run);
  if (!(state.feed[1] > 0)) return run.fail(ErrorCode::NoFeed, words.first_column(kAxisWords));
  const std::optional<Angle> start = start_angle(run);
  if (state.position.same_point(to)) return true;
  if (!check_stroke(run, to)) return false;
  const Length lead = lead_of_path(state.position, to, state.feed[1]);
  Thread thread{run.origin, to, lead, start};
  if (state.g[kMotionGroup] == kVariableThread) {
    run.ledger.take(set_of(K));
    if (!words.has(K)) {
      return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column, "G34 without K");
    }
    const Word& word = words[K];
    if (word.form == WordForm::Whole && word.value != 0 && !run.options.calculator_point) {
      return run.fail(ErrorCode::DecimalPoint, word.column, "the K of G34 is written with a point");
    }
    thread.lead_change =
        Length::mm(word.value * run.increments.mm_per_unit * lead.mm() / state.feed[1]);
  }
  run.events().on_thread(thread);
  arrive(run, to);
  return true;
}

bool cut_box(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  if (state.is_compensating()) return refuse_compensated(run);
  constexpr AddressSet kOldTaper = kCenterWords | set_of(Q);
  const AddressSet unknown =
      words.present() & (state.g[kMotionGroup] == kBoxThread ? kCenterWords : kOldTaper);
  if (unknown != 0) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(unknown),
                    "the taper of a cycle is written with R");
  }
  BoxCycle& box = state.box;
  const std::uint8_t code = state.g[kMotionGroup];
  if (box.code != code) {
    if (box.code != 0 && box.taper != 0 && !words.has(R)) {
      return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                      "another cycle without R, and R of the one before is not 0");
    }
    box = {.code = code};
  }
  if (words.has(R)) box.taper = run.length(words[R]);
  run.ledger.take(kAxisWords | set_of(R));
  const Position start = state.position;
  Position end;
  if (!read_target(run, end)) return false;
  if (words.has(X)) box.x = end.raw(Axis::X) - state.origin[0];
  if (words.has(Z)) box.z = end.raw(Axis::Z) - state.origin[2];
  box.has_x |= words.has(X);
  box.has_z |= words.has(Z);
  if (!box.has_x || !box.has_z) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kAxisWords),
                    "the first block of the cycle names X and Z");
  }
  end.set_raw(Axis::X, state.origin[0] + box.x);
  end.set_raw(Axis::Z, state.origin[2] + box.z);
  if (words.has_any(kAxisWords & ~set_of(X, Z))) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kAxisWords & ~set_of(X, Z)),
                    "the cycle moves X and Z alone");
  }
  if (code == kBoxThread) {
    return cut_thread_box(run, moved(start, end.raw(Axis::X) + box.taper, {}), end, start);
  }
  if (!check_feed(run)) return false;
  const Feed feed = run.active_feed();
  if (code == kBoxTurning) {
    return rapid_to(run, moved(start, end.raw(Axis::X) + box.taper, {})) &&
           line_to(run, end, feed) && line_to(run, moved(end, start.raw(Axis::X), {}), feed) &&
           rapid_to(run, start);
  }
  return rapid_to(run, moved(start, {}, end.raw(Axis::Z) + box.taper)) && line_to(run, end, feed) &&
         line_to(run, moved(end, {}, start.raw(Axis::Z)), feed) && rapid_to(run, start);
}

}  // namespace dripline::interpreter::fanuc
