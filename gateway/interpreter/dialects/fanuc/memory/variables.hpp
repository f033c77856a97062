#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Macro variables: locals and commons here, the system's in system_variables.cpp.
namespace dripline::interpreter::fanuc {

Locals null_locals();

/// The cell of #1 to #33, #100 and up, #500 and up; nullptr when there is none of that number.
double* common_variable(ModalState& state, const ControlOptions& options, int number);

/// Alarm 115: there is none of that number. False.
bool refuse_variable(Run& run, int number, std::uint32_t column);
/// False: alarm 115 or 116, or a question.
bool read_variable(Run& run, int number, std::uint32_t column, double& value);
/// #3000 and #3006 take their text from the block in hand.
bool write_variable(Run& run, int number, std::uint32_t column, double value);

/// Numbers from 1000 up.
bool read_system_variable(Run& run, int number, std::uint32_t column, double& value);
bool write_system_variable(Run& run, int number, std::uint32_t column, double value);

}  // namespace dripline::interpreter::fanuc
