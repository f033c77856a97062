#include "gateway/interpreter/dialects/centurion/memory/pins.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/dialects/centurion/codes/modes.hpp"

namespace dripline::interpreter::centurion {

namespace {

constexpr int kFirstOfZ = 1000;
constexpr int kFirstOfX = 2000;

std::uint32_t output_bit(int number, Axis axis) {
  const int place = number - 1 + (axis == Axis::X ? kPinsPerKind : 0);
  return std::uint32_t{1} << place;
}

bool is_listed(const Run& run, int pin) {
  const auto& ones = run.options.pins_at_one;
  return std::find(ones.begin(), ones.end(), pin) != ones.end();
}

void emit(Run& run, OutputPin pin, bool state, std::optional<double> pulse_ms) {
  run.events().on_pin({run.origin, pin.axis, pin.number, state, pulse_ms});
}

bool refuse_missing(Run& run, int pin) {
  return run.fail(ErrorCode::InputMissing, 0, fmt::format("pin {} does not read 1", pin));
}

}  // namespace

int input_pin(Axis axis, int number) {
  return (axis == Axis::X ? kFirstOfX : kFirstOfZ) + number - 1;
}

std::optional<OutputPin> output_of_pin(int pin) {
  for (const Axis axis : {Axis::Z, Axis::X}) {
    const int number = pin - input_pin(axis, 1) - kPinsPerKind + 1;
    if (number >= 1 && number <= kPinsPerKind) return OutputPin{axis, number};
  }
  return std::nullopt;
}

void remember_output(Run& run, OutputPin pin, bool state) {
  const std::uint32_t bit = output_bit(pin.number, pin.axis);
  run.state.outputs = state ? run.state.outputs | bit : run.state.outputs & ~bit;
}

void set_output(Run& run, OutputPin pin, bool state) {
  remember_output(run, pin, state);
  emit(run, pin, state, {});
}

void pulse_output(Run& run, OutputPin pin, bool state, double milliseconds) {
  remember_output(run, pin, !state);
  emit(run, pin, state, milliseconds);
}

bool read_pin(Run& run, int pin, std::uint32_t column, double& value) {
  if (const auto output = output_of_pin(pin)) {
    value = (run.state.outputs & output_bit(output->number, output->axis)) != 0 ? 1 : 0;
    return true;
  }
  const bool is_input = (pin >= kFirstOfZ && pin < kFirstOfZ + kPinsPerKind) ||
                        (pin >= kFirstOfX && pin < kFirstOfX + kPinsPerKind);
  if (!is_input) {
    return run.fail(ErrorCode::ParameterOutOfRange, column, fmt::format("there is no pin {}", pin));
  }
  if (run.options.answers_pins) {
    value = is_listed(run, pin) ? 1 : 0;
    return true;
  }
  const Answer* answer = run.next_answer();
  if (answer == nullptr) return run.ask(InputQuestion{pin});
  value = std::get<bool>(*answer) ? 1 : 0;
  return true;
}

bool wait_for_input(Run& run, int pin) {
  if (run.options.answers_pins) return is_listed(run, pin) || refuse_missing(run, pin);
  if (!run.options.asks_for_inputs) return true;
  const Answer* answer = run.next_answer();
  if (answer == nullptr) return run.ask(InputQuestion{pin});
  const bool has_come = std::get<bool>(*answer);
  run.item_done();
  return has_come || refuse_missing(run, pin);
}

namespace {

struct Request {
  int first = 0;
  int count = 0;
  std::uint32_t file = 0;
};

/// A whole number from 0 to `maximum`, `fallback` where the block has no such word.
bool read_word(Run& run, Address address, int fallback, int maximum, int& value) {
  const Words& words = run.block.words;
  value = fallback;
  if (!words.has(address)) return true;
  const double number = words[address];
  if (!(number >= 0 && number <= maximum) || number != std::trunc(number)) {
    return run.fail(ErrorCode::ParameterOutOfRange, words.column(address),
                    fmt::format("{}{} is not a whole number from 0 to {}", to_string(address),
                                number, maximum));
  }
  value = static_cast<int>(number);
  return true;
}

bool read_request(Run& run, Request& request) {
  constexpr int kHighestFile = 9999;
  int file = 0;
  if (!read_word(run, Address::P, 0, kUserParameters - 1, request.first)) return false;
  if (!read_word(run, Address::L, 10, kUserParameters - request.first, request.count)) return false;
  if (!read_word(run, Address::Q, 0, kHighestFile, file)) return false;
  if (request.first + request.count > kUserParameters) {
    return run.fail(ErrorCode::ParameterOutOfRange, run.block.words.column(Address::P),
                    fmt::format("{} parameters from P{}", request.count, request.first));
  }
  request.file = static_cast<std::uint32_t>(file);
  return true;
}

ParameterFile* find_file(ModalState& state, std::uint32_t number) {
  const auto file = std::find_if(state.files.begin(), state.files.end(),
                                 [number](const auto& each) { return each.number == number; });
  return file == state.files.end() ? nullptr : &*file;
}

}  // namespace

bool save_parameters(Run& run, const GRow&) {
  Request request;
  if (!read_request(run, request)) return false;
  ParameterFile* file = find_file(run.state, request.file);
  if (file == nullptr) {
    if (run.state.files.size() == kMaxParameterFiles) {
      return run.fail(ErrorCode::DiskFull, 0, fmt::format("{} files", kMaxParameterFiles));
    }
    file = &run.state.files.emplace_back();
    file->number = request.file;
  }
  file->values.clear();
  for (int i = 0; i < request.count; ++i) {
    run.start.note_read(request.first + i);
    file->values.push_back(run.parameters[request.first + i]);
  }
  return true;
}

bool load_parameters(Run& run, const GRow&) {
  Request request;
  if (!read_request(run, request)) return false;
  const ParameterFile* file = find_file(run.state, request.file);
  if (file == nullptr || file->values.size() < static_cast<std::size_t>(request.count)) {
    return run.fail(ErrorCode::FileNotFound, 0, fmt::format("Q{:04}", request.file));
  }
  for (int i = 0; i < request.count; ++i) {
    run.start.note_set(request.first + i);
    run.parameters[request.first + i] = file->values[static_cast<std::size_t>(i)];
  }
  return true;
}

}  // namespace dripline::interpreter::centurion
