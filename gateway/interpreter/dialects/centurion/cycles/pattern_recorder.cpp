#include "gateway/interpreter/dialects/centurion/cycles/pattern_recorder.hpp"

#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {

namespace {

PatternMove move_of(PatternMove::Kind kind, const Origin& origin) {
  PatternMove move;
  move.kind = kind;
  move.line = origin.line;
  move.sequence = origin.sequence;
  return move;
}

PlanePoint point_of(const Position& at) {
  return {at.raw(Axis::X), at.raw(Axis::Z)};
}

void set_feed(PatternMove& move, const Feed& feed) {
  move.is_feed_per_revolution = feed.per() == Feed::Per::Revolution;
  move.feed = feed.length().mm();
}

}  // namespace

void PatternRecorder::refuse(PatternFault fault) {
  if (state_.pattern.fault == PatternFault::None) state_.pattern.fault = fault;
}

void PatternRecorder::record(const PatternMove& move) {
  if (state_.pattern.moves.size() == kMaxPatternMoves) return refuse(PatternFault::TooManyMoves);
  state_.pattern.moves.push_back(move);
}

void PatternRecorder::on_rapid(const Rapid& event) {
  if (!is_reading()) return out().on_rapid(event);
  PatternMove move = move_of(PatternMove::Kind::Rapid, event.origin);
  move.to = point_of(event.to);
  record(move);
}

void PatternRecorder::on_line(const Line& event) {
  if (!is_reading()) return out().on_line(event);
  PatternMove move = move_of(PatternMove::Kind::Line, event.origin);
  move.to = point_of(event.to);
  set_feed(move, event.feed);
  record(move);
}

void PatternRecorder::on_arc(const Arc& event) {
  if (!is_reading()) return out().on_arc(event);
  PatternMove move = move_of(PatternMove::Kind::Arc, event.origin);
  move.to = point_of(event.to);
  move.center = {event.center_second.mm(), event.center_first.mm()};
  move.sweep = event.sweep.degrees();
  move.is_clockwise = event.turn == Turn::Clockwise;
  set_feed(move, event.feed);
  record(move);
}

void PatternRecorder::on_thread(const Thread& event) {
  if (!is_reading()) return out().on_thread(event);
  refuse(PatternFault::Thread);
}

void PatternRecorder::on_probe(const Probe& event) {
  if (!is_reading()) return out().on_probe(event);
  refuse(PatternFault::Probe);
}

void PatternRecorder::on_spindle(const Spindle& event) {
  if (!is_reading()) return out().on_spindle(event);
  PatternMove move = move_of(PatternMove::Kind::Spindle, event.origin);
  move.spindle = event.state;
  move.revolutions = event.revolutions_per_minute;
  if (event.surface_speed) move.surface = event.surface_speed->mm();
  if (event.max_revolutions) move.max_revolutions = *event.max_revolutions;
  record(move);
}

namespace {

constexpr int kFirstLabel = 110;
constexpr int kLastLabel = 111;
constexpr int kFinishX = 112;
constexpr int kFinishZ = 113;
constexpr int kRoughX = 114;
constexpr int kRoughZ = 115;
constexpr int kIncrement = 116;
constexpr int kReliefKind = 117;
constexpr int kReliefLength = 118;
constexpr int kFirstCut = 119;

bool read_label(Run& run, Address address, int parameter, std::uint32_t& label) {
  constexpr double kMax = 9999;
  const Words& words = run.block.words;
  if (!words.has(address)) {
    return run.fail(ErrorCode::IllegalStatement, 0,
                    fmt::format("{} is to name a block of the pattern", to_string(address)));
  }
  const double value = words[address];
  if (!(value >= 0 && value <= kMax) || value != std::trunc(value)) {
    return run.fail(
        ErrorCode::ParameterOutOfRange, words.column(address),
        fmt::format("{}{} is not a whole number from 0 to {}", to_string(address), value, kMax));
  }
  label = static_cast<std::uint32_t>(value);
  run.parameters[parameter] = value;
  return true;
}

/// A stock or a length that is missing is 0, as blank fields of the control's screens are.
double take_length(Run& run, Address address, int parameter) {
  const Words& words = run.block.words;
  run.parameters[parameter] = words.has(address) ? words[address] : 0;
  return run.length(run.parameters[parameter]).mm();
}

bool refuse(Run& run, Address address, const char* limit) {
  const Words& words = run.block.words;
  return run.fail(ErrorCode::ParameterOutOfRange, words.column(address),
                  fmt::format("{}{} is not {}", to_string(address),
                              words.has(address) ? words[address] : 0, limit));
}

bool read_passes(Run& run, PatternCycle& cycle) {
  constexpr double kMax = 9999;
  const double passes = run.block.words.has(Address::D) ? run.block.words[Address::D] : 0;
  if (!(passes >= 1 && passes <= kMax) || passes != std::trunc(passes)) {
    return refuse(run, Address::D, "a whole number of passes from 1 to 9999");
  }
  run.parameters[kIncrement] = passes;
  cycle.passes = static_cast<std::uint32_t>(passes);
  return true;
}

/// No step can be finer than the least increment.
bool read_levels(Run& run, PatternCycle& cycle) {
  const bool is_inch = run.state.units == Units::Inch;
  cycle.step = take_length(run, Address::D, kIncrement);
  if (!(run.parameters[kIncrement] >= (is_inch ? 0.0001 : 0.001))) {
    return refuse(run, Address::D, is_inch ? ".0001 or more" : ".001 or more");
  }
  cycle.relief = take_length(run, Address::R, kReliefLength);
  if (!(cycle.relief >= 0)) return refuse(run, Address::R, "0 or more");
  const double kind = run.parameters[kReliefKind];
  if (kind != 0 && kind != 1) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0,
                    fmt::format("relief P117 = {} is not 0 (pattern) or 1 (45 degrees)", kind));
  }
  cycle.relief_is_45 = kind == 1;
  cycle.has_first_level = run.block.words.has(Address::V);
  if (!cycle.has_first_level) return true;
  const double first = run.block.words[Address::V];
  run.parameters[kFirstCut] = first;
  const bool is_facing = cycle.code == 72;
  cycle.first_level =
      run.length(is_facing ? first + run.state.origin.z : first / 2 + run.state.origin.x).mm();
  return true;
}

}  // namespace

bool read_pattern_words(Run& run, PatternCycle& cycle, std::uint32_t& first_label) {
  if (!read_label(run, Address::P, kFirstLabel, first_label) ||
      !read_label(run, Address::Q, kLastLabel, cycle.last_label)) {
    return false;
  }
  if (first_label == cycle.last_label) {
    return run.fail(ErrorCode::IllegalStatement, run.block.words.column(Address::Q),
                    fmt::format("P and Q both name block N{}", first_label));
  }
  if (cycle.code == 70) return true;
  cycle.finish = {take_length(run, Address::U, kFinishX) / 2,
                  take_length(run, Address::W, kFinishZ)};
  cycle.rough = {take_length(run, Address::I, kRoughX), take_length(run, Address::K, kRoughZ)};
  cycle.feed = run.active_feed();
  if (!check_feed(run)) return false;
  return cycle.code == 73 ? read_passes(run, cycle) : read_levels(run, cycle);
}

}  // namespace dripline::interpreter::centurion
