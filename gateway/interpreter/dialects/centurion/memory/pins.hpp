#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The pins of the axis cards (manual: HDW; chapter 4): inputs 1-12 and outputs 1-12 of Z are
/// 1000-1011 and 1012-1023, those of X 2000-2011 and 2012-2023.
namespace dripline::interpreter::centurion {

inline constexpr int kPinsPerKind = 12;

int input_pin(Axis axis, int number);

struct OutputPin {
  Axis axis = Axis::X;
  int number = 1;  ///< from 1
};
/// The output with this pin number, if it is one.
std::optional<OutputPin> output_of_pin(int pin);
void set_output(Run& run, OutputPin pin, bool state);
/// What PIN reads from now on; the machine receives an M function by its number instead.
void remember_output(Run& run, OutputPin pin, bool state);
/// To `state`, a wait, and back.
void pulse_output(Run& run, OutputPin pin, bool state, double milliseconds);

/// PIN[n]: an output as the program has left it, an input as the setup or the owner gives
/// it. A question pauses the item.
bool read_pin(Run& run, int pin, std::uint32_t column, double& value);

/// An M function that ends when the input reads 1. The machine receives the function and decides
/// when it is done; this checks that the input can come: by the setup's `pins`, or by a question
/// with the option `ask_inputs`. An input that reads 0 is error InputMissing.
bool wait_for_input(Run& run, int pin);

}  // namespace dripline::interpreter::centurion
