#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

#include <fmt/format.h>
#include <cmath>

namespace dripline::interpreter::tektronix1704 {
namespace {

/// Shorter moves say nothing about a direction: a duplicate point is one count away.
constexpr double kShortest = 5;
const double kCosineOfTurn = std::cos(Angle::degrees(30).radians());
constexpr double kNoise = 1e-9;
constexpr double kReaderStart = 0.010;  ///< seconds

double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The next block must be read while the move before is made; T2 > T1 means that it waits.
void check_reader(Run& run, const PlannedMove& move) {
  const LastMove& last = run.state.last;
  if (!run.options.checks_reader || !last.flows || last.length <= 0) return;
  const double mean_feed = (last.feed + move.feed) / 2;
  const double moving = last.length * run.mm_per_count * 60 / mean_feed;
  const double reading =
      kReaderStart + (run.state.block.characters - 1.0) / run.options.reader_characters_per_second;
  if (reading > moving) {
    run.warn(Fault::ReaderLimited, last.origin, 0,
             fmt::format("{:.3f} s to read the next block, {:.3f} s to move", reading, moving));
  }
}

}  // namespace

void check_turn(Run& run, const PlannedMove& move) {
  LastMove& last = run.state.last;
  check_reader(run, move);
  const bool is_long = move.length >= kShortest;
  if (last.flows && is_long) {
    const double lengths =
        std::sqrt(dot(last.direction, last.direction) * dot(move.begin, move.begin));
    if (lengths > 0 && dot(last.direction, move.begin) < lengths * (kCosineOfTurn - kNoise)) {
      run.warn(Fault::Turn, last.origin);
    }
  }
  if (is_long || !move.flows) {
    last.direction = move.end;
    last.origin = run.origin;
  }
  last.flows = move.flows;
  last.block = run.origin.block;
  last.length = move.length;
  last.feed = move.feed;
}

bool check_stop(Run& run) {
  LastMove& last = run.state.last;
  if (!last.flows) return true;
  last.flows = false;
  if (run.options.is_strict) return run.fail(Fault::Synchronization);
  run.warn(Fault::TerminalMove, last.origin);
  return true;
}

void check_quill(Run& run) {
  LastMove& last = run.state.last;
  if (last.flows) run.warn(Fault::QuillAfterMove, last.origin);
  last.flows = false;
}

void check_m_word(Run& run, int code, bool moves) {
  const bool is_stop = code == 0 || code == 1;
  const LastMove& last = run.state.last;
  if (!is_stop && (moves || (last.flows && last.block + 1 == run.origin.block))) {
    run.warn(Fault::MAfterMove, run.origin, 0, fmt::format("M{:02}", code));
  }
}

}  // namespace dripline::interpreter::tektronix1704
