#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
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
