#include "gateway/interpreter/dialects/centurion/cycles/cycle_words.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

bool refuse(Run& run, Address address, double value, const char* why) {
  const Words& words = run.block.words;
  return run.fail(ErrorCode::ParameterOutOfRange, words.has(address) ? words.column(address) : 0,
                  fmt::format("{}{} {}", to_string(address), value, why));
}

}  // namespace

double cycle_position_word(Run& run, Address address, int parameter, double from) {
  const Words& words = run.block.words;
  if (words.has(address)) {
    const double value = words[address];
    run.parameters[parameter] = run.state.modes.is_incremental ? from + value : value;
  }
  return run.parameters[parameter];
}

bool cycle_length_word(Run& run, Address address, int parameter, double& value) {
  const Words& words = run.block.words;
  value = words.has(address) ? words[address] : run.parameters[parameter];
  if (value < 0) return refuse(run, address, value, "has no sign in this cycle");
  run.parameters[parameter] = value;
  return true;
}

bool cycle_step_word(Run& run, Address address, int parameter, double& value) {
  if (!cycle_length_word(run, address, parameter, value)) return false;
  return value > 0 || refuse(run, address, value, "makes no step");
}

bool cycle_dwell_word(Run& run, double& seconds) {
  constexpr double kMax = 9999.99;
  const Words& words = run.block.words;
  seconds = words.has(Address::P) ? words[Address::P] : run.parameters[kCycleDwell];
  if (!(seconds >= 0 && seconds <= kMax)) {
    return run.fail(ErrorCode::DwellOutOfRange,
                    words.has(Address::P) ? words.column(Address::P) : 0,
                    fmt::format("{} s is not in 0 to {}", seconds, kMax));
  }
  run.parameters[kCycleDwell] = seconds;
  return true;
}

bool cycle_feed_word(Run& run, Feed& feed) {
  constexpr std::uint8_t kPerMinute = 98, kPerRevolution = 99;
  ModalState& state = run.state;
  double& stored = run.parameters[kCycleFeed];
  const std::uint8_t code = state.modes.is_feed_per_revolution ? kPerRevolution : kPerMinute;
  if (run.block.words.has(Address::F) || !(stored > 0)) {
    if (!check_feed(run)) return false;
    stored = state.active_feed();
  } else if (state.cycle_feed_code != 0 && state.cycle_feed_code != code) {
    return run.fail(ErrorCode::FeedOutOfRange, 0,
                    fmt::format("the feed of an earlier cycle, P145 = {}, is of G{} and G{} is in "
                                "force: F in the block of the cycle",
                                stored, state.cycle_feed_code, code));
  }
  state.cycle_feed_code = code;
  const Length per = run.length(stored);
  feed = code == kPerRevolution ? Feed::per_revolution(per) : Feed::per_minute(per);
  return true;
}

}  // namespace dripline::interpreter::centurion
