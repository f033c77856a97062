#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/length_in_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr std::array<Axis, 8> kVariableAxes{Axis::X, Axis::Y, Axis::Z, Axis::A,
                                            Axis::B, Axis::C, Axis::U, Axis::V};

bool refuse_write(Run& run, int number, std::uint32_t column) {
  return run.fail(ErrorCode::WriteProtected, column, fmt::format("#{}", number));
}

/// A lathe counts X, Z, C, Y.
constexpr std::array<Axis, 8> kLatheVariableAxes{Axis::X, Axis::Z, Axis::C, Axis::Y,
                                                 Axis::A, Axis::B, Axis::U, Axis::V};

/// Axis of the last digit of #5001 and the like; nullptr beyond the eighth.
const Axis* axis_at(const Run& run, int number, int base) {
  const int place = number - base - 1;
  const auto& axes = run.options.is_lathe ? kLatheVariableAxes : kVariableAxes;
  return place >= 0 && place < 8 ? &axes[static_cast<std::size_t>(place)] : nullptr;
}

bool read_pin(Run& run, int pin, double& value) {
  if (run.options.answers_pins) {
    const auto& ones = run.options.pins_at_one;
    value = std::find(ones.begin(), ones.end(), pin) != ones.end() ? 1 : 0;
    return true;
  }
  const Answer* answer = run.next_answer();
  if (answer == nullptr) return run.ask(InputQuestion{pin});
  value = std::get<bool>(*answer) ? 1 : 0;
  return true;
}

bool read_inputs(Run& run, int number, std::uint32_t column, double& value) {
  constexpr int kWord = 1032;
  if (number >= 1000 && number <= 1015) return read_pin(run, number, value);
  if (number != kWord) return refuse_variable(run, number, column);
  value = 0;
  for (int bit = 0; bit < 16; ++bit) {
    double one = 0;
    if (!read_pin(run, 1000 + bit, one)) return false;
    value += one * static_cast<double>(1 << bit);
  }
  return true;
}

bool ask_time(Run& run, LocalTime& now) {
  const Answer* answer = run.next_answer();
  if (answer == nullptr) return run.ask(TimeQuestion{});
  now = std::get<LocalTime>(*answer);
  return true;
}

constexpr double kTimerEnd = 2'147'483'648;  ///< #3001 begins again at 0

/// Milliseconds since #3001 was 0; read for the first time, since midnight. A clock that was set
/// back before that begins again.
double timer_at(Run& run, const LocalTime& now) {
  double& base = run.state.counters[kClockBase];
  const auto time = static_cast<double>(milliseconds_of(now));
  if (std::isnan(base)) {
    base = static_cast<double>(milliseconds_of({now.year, now.month, now.day}));
  }
  if (time < base) base = time;
  return std::fmod(time - base, kTimerEnd);
}

bool read_clock(Run& run, int number, double& value) {
  LocalTime now;
  if (!ask_time(run, now)) return false;
  if (number == 3011) value = now.year * 10000 + now.month * 100 + now.day;
  if (number == 3012) value = now.hour * 10000 + now.minute * 100 + now.second;
  if (number == 3001) value = timer_at(run, now);
  return true;
}

/// Variables that are counters of the control.
struct KeptCounter {
  int number;
  Counter place;
  double highest;
};
const KeptCounter* kept_counter(int number) {
  static constexpr std::array kCounters{
      KeptCounter{3002, kHours, 1e9}, KeptCounter{3005, kSettings, 65535},
      KeptCounter{3901, kMade, 1e9}, KeptCounter{3902, kRequired, 1e9}};
  const auto* at =
      std::find_if(kCounters.begin(), kCounters.end(),
                   [number](const KeptCounter& each) { return each.number == number; });
  return at == kCounters.end() ? nullptr : at;
}

bool read_control(Run& run, int number, std::uint32_t column, double& value) {
  if (const KeptCounter* kept = kept_counter(number)) {
    value = run.state.counters[kept->place];
    return true;
  }
  switch (number) {
    case 3001:
    case 3011:
    case 3012:
      return read_clock(run, number, value);
    case 3007: {
      int mirrored = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const bool is_scaled = run.state.g[kScalingGroup] == 51 && run.state.scaling.factor[i] < 0;
        mirrored |= is_scaled != run.state.mirror.is_on[i] ? 1 << i : 0;
      }
      value = mirrored;
      return true;
    }
    case 3000:
    case 3003:
    case 3004:
    case 3006:
      return run.fail(ErrorCode::WriteProtected, column, fmt::format("#{} cannot be read", number));
    default:
      return refuse_variable(run, number, column);
  }
}

bool read_modal(Run& run, int number, std::uint32_t column, double& value) {
  const ModalState& state = run.state;
  if (number == 4022 && state.mirror.any()) {
    value = 51.1;
    return true;
  }
  if (number > 4000 && number <= 4000 + kPolarGroup) {
    const std::uint8_t code = state.g[static_cast<std::size_t>(number - 4000)];
    value = code == kMoreWorkSystems ? 54.1
            : code == kTipControl    ? 43.4
            : code == kTipVector     ? 43.5
            : code == kTiltedPlane   ? 68.2
            : code == kRigidTap      ? 84.2
            : code == kRigidTapLeft  ? 84.3
                                     : code;
    return true;
  }
  const LastWords& last = state.last;
  const std::pair<int, double> shown[] = {
      {4022, 0.0},    {4102, last.b},         {4107, state.d_number},
      {4109, last.f}, {4111, state.h_number}, {4113, last.m},
      {4114, last.n}, {4115, last.o},         {4119, last.s},
      {4120, last.t}};
  for (const auto& [known, held] : shown) {
    if (known != number) continue;
    value = held;
    return true;
  }
  return refuse_variable(run, number, column);
}

/// The short number of a variable that later controls have a long one for, or the number itself: 50
/// places for the axes instead of 20, #42xx for the block in hand, #14001 and up for G54.1.
int short_number(int number) {
  constexpr int kShown = 8;  // axes that have a short number
  const auto of_row = [](int base, int row_step, int from_first) {
    const int axis = from_first % 50;
    return axis < kShown ? base + row_step * (from_first / 50) + axis + 1 : -1;
  };
  if (number > 100'000 && number <= 100'300) return of_row(5000, 20, number - 100'001);
  if (number > 100'300 && number <= 100'650) return of_row(5200, 20, number - 100'301);
  if (number > 101'000 && number <= 101'000 + 50 * kMoreWorkCount)
    return of_row(7000, 20, number - 101'001);
  if (number > 14'000 && number <= 14'000 + 20 * kMoreWorkCount) return number - 7000;
  if (number > 4200 && number < 4400) return number - 200;
  return number;
}

/// As above, on a control that has them. A number that means nothing stays as it is.
int known_number(const Run& run, int number) {
  if (number < 4200 || !run.options.has_long_variables) return number;
  const int known = short_number(number);
  return known < 0 ? number : known;
}

/// Zero offsets: #2500 .. by axis and #5201 .. by system; nullptr when it is none.
double* work_variable(Run& run, int number, Axis& axis) {
  Coordinates& all = run.memory.coordinates;
  if (!run.options.is_lathe && number >= 2500 && number < 2900 && number % 100 <= 6) {
    axis = kVariableAxes[static_cast<std::size_t>((number - 2500) / 100)];
    return &all.work[static_cast<std::size_t>(number % 100)][static_cast<std::size_t>(axis)];
  }
  const bool is_basic = number > 5200 && number < 5340;
  const bool is_more = number > 7000 && number < 7000 + 20 * kMoreWorkCount;
  if (!is_basic && !is_more) return nullptr;
  const int base = is_basic ? 5200 : 7000;
  const auto system = static_cast<std::size_t>((number - base) / 20) + (is_basic ? 0u : 7u);
  const Axis* at = axis_at(run, number, base + 20 * ((number - base) / 20));
  if (at == nullptr || system >= all.work.size()) return nullptr;
  axis = *at;
  return &all.work[system][static_cast<std::size_t>(axis)];
}

/// In G41 and G42 the position of the axes holds the radius, which the next moves decide about.
bool check_position(Run& run, int number, Axis axis, std::uint32_t column) {
  const PlaneAxes plane = axes_of(run.state.plane());
  const bool is_of_axes = (number > 5020 && number <= 5028) || (number > 5040 && number <= 5048);
  const bool is_compensated =
      run.state.is_compensating() && (axis == plane.first || axis == plane.second);
  if (!is_of_axes || !is_compensated) return true;
  return run.fail(ErrorCode::IllegalVariable, column,
                  fmt::format("#{} holds the radius of G41 and G42: G40 comes before it", number));
}

/// #5021 is where the axes are, #5041 and #5061 are the same in the work system, with the tool's
/// offset; #5001 is the end of the last block without it (custom macro, position information).
bool read_position(Run& run, int number, std::uint32_t column, double& value) {
  const ModalState& state = run.state;
  const int base = number / 20 * 20;
  const Axis* axis = axis_at(run, number, base);
  if (axis == nullptr) return refuse_variable(run, number, column);
  if (!check_position(run, number, *axis, column)) return false;
  double raw = 0;
  switch (base) {
    case 5000:
      raw = run.work_position(*axis);
      break;
    case 5020:
      raw = (run.tilted.is_on() ? run.tilted.machine() : state.position).raw(*axis) +
            length_along(run, *axis);
      break;
    case 5040:
      raw = run.work_position(*axis) + length_in_work_position(run, *axis);
      break;
    case 5060:
      raw = state.skip[static_cast<std::size_t>(*axis)];
      break;
    case 5080:
      if (run.options.is_lathe)
        raw = length_in_work_position(run, *axis);
      else if (*axis == state.length_axis)
        raw = state.length_offset;
      break;
    case 5100:
      break;
    default:
      return refuse_variable(run, number, column);
  }
  if (std::isnan(raw)) {
    return run.fail(ErrorCode::IllegalVariable, column,
                    fmt::format("#{} with a geometry offset: whether it holds it is a parameter of "
                                "the lathe",
                                number));
  }
  value = run.in_units(*axis, raw);
  return true;
}

/// An alarm of the program's own.
bool raise_alarm(Run& run, std::uint32_t column, double value) {
  const double number = std::isnan(value) ? 0 : std::round(value);
  if (!(number >= 0 && number <= kHighestUserAlarm)) {
    return run.fail(ErrorCode::IllegalVariable, column,
                    fmt::format("#3000 = {} is not 0 to {}", value, kHighestUserAlarm));
  }
  const Block::Parts& parts = run.block.parts;
  const std::string_view message(run.text.begin() + parts.message_begin,
                                 parts.message_end - parts.message_begin);
  return run.fail({user_alarm_id(static_cast<int>(number)), message}, column);
}

void stop_with_message(Run& run) {
  const Block::Parts& parts = run.block.parts;
  if (parts.message_begin != parts.message_end) {
    run.events().on_message(
        {run.origin, std::string_view(run.text.begin() + parts.message_begin,
                                      parts.message_end - parts.message_begin)});
  }
  run.state.limits = {};
  run.events().on_stop({run.origin, StopKind::Operator});
}

bool write_outputs(Run& run, int number, std::uint32_t column, double value) {
  const auto set = [&](int output, bool is_on) {
    run.events().on_pin({run.origin, Axis::X, output, is_on, {}});
  };
  if (number >= 1100 && number <= 1115) {
    set(number, value != 0 && !std::isnan(value));
    return true;
  }
  if (number != 1132 && number != 1133) {
    return number <= 1032 ? refuse_write(run, number, column)
                          : refuse_variable(run, number, column);
  }
  const double bits = std::isnan(value) ? 0 : std::round(value);
  if (!(bits >= 0 && bits <= 65535)) {
    return run.fail(ErrorCode::IllegalVariable, column, fmt::format("#{} = {}", number, value));
  }
  for (int bit = 0; bit < 16; ++bit) {
    set(1100 + bit, (static_cast<std::uint32_t>(bits) >> bit & 1u) != 0);
  }
  return true;
}

bool write_control(Run& run, int number, std::uint32_t column, double value) {
  auto& counters = run.state.counters;
  const double stored = std::isnan(value) ? 0 : value;
  const auto keep = [&](Counter place, double highest) {
    if (!(stored >= 0 && stored <= highest)) {
      return run.fail(ErrorCode::IllegalVariable, column, fmt::format("#{} = {}", number, value));
    }
    counters[place] = stored;
    return true;
  };
  if (const KeptCounter* kept = kept_counter(number)) return keep(kept->place, kept->highest);
  switch (number) {
    case 3000:
      return raise_alarm(run, column, value);
    case 3006:
      stop_with_message(run);
      return true;
    case 3001: {
      LocalTime now;
      if (!ask_time(run, now)) return false;
      if (!(stored >= 0 && stored < kTimerEnd)) {
        return run.fail(ErrorCode::IllegalVariable, column, fmt::format("#3001 = {}", value));
      }
      counters[kClockBase] = static_cast<double>(milliseconds_of(now)) - std::round(stored);
      return true;
    }
    case 3003:
      if (!keep(kSingle, 3)) return false;
      show_override_inhibit(run);
      return true;
    case 3004:
      if (!keep(kHold, 7)) return false;
      show_override_inhibit(run);
      return true;
    case 3007:
    case 3011:
    case 3012:
      return refuse_write(run, number, column);
    default:
      return refuse_variable(run, number, column);
  }
}

}  // namespace

bool read_system_variable(Run& run, int written, std::uint32_t column, double& value) {
  const int number = known_number(run, written);
  if (number < 1100) return read_inputs(run, number, column, value);
  if (number < 1134) return run.fail(ErrorCode::WriteProtected, column, "outputs cannot be read");
  if (const OffsetRegister cell = offset_variable(run, number); cell.value != nullptr) {
    value = read_register(cell);
    if (!cell.is_number)
      value = cell.is_x ? run.in_units(Axis::X, value) : run.in_length_units(value);
    return true;
  }
  Axis axis{};
  if (const double* cell = work_variable(run, number, axis)) {
    value = run.in_units(axis, *cell);
    return true;
  }
  if (number >= 3000 && number < 4000) return read_control(run, number, column, value);
  if (number >= 4000 && number < 5000) return read_modal(run, number, column, value);
  if (number >= 5000 && number < 5200) return read_position(run, number, column, value);
  return refuse_variable(run, number, column);
}

bool write_system_variable(Run& run, int written, std::uint32_t column, double value) {
  const int number = known_number(run, written);
  if (number < 1200) return write_outputs(run, number, column, value);
  const double stored = std::isnan(value) ? 0 : value;
  if (const OffsetRegister cell = offset_variable(run, number); cell.value != nullptr) {
    if (cell.is_number && !(stored >= 0 && stored <= 9 && stored == std::trunc(stored))) {
      return run.fail(ErrorCode::IllegalVariable, column, fmt::format("#{} = {}", number, stored));
    }
    const Axis as = cell.is_x ? Axis::X : Axis::Z;
    write_register(run, cell, cell.is_number ? stored : run.from_units(as, stored), column);
    return true;
  }
  Axis axis{};
  if (double* cell = work_variable(run, number, axis)) {
    if (run.tilted.is_on()) {
      return run.fail(ErrorCode::WriteProtected, column,
                      fmt::format("#{} while G68.2 or G43.4 is in force", number));
    }
    *cell = run.from_units(axis, stored);
    run.update_origin();
    return true;
  }
  if (number >= 3000 && number < 4000) return write_control(run, number, column, value);
  if (number >= 4000 && number < 5200) return refuse_write(run, number, column);
  return refuse_variable(run, number, column);
}

}  // namespace dripline::interpreter::fanuc
