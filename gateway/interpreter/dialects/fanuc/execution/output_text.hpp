#pragma once

#include <string>

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// POPEN, DPRNT, BPRNT, PCLOS: what goes out through the control's interface.
namespace dripline::interpreter::fanuc {

/// Reads the brackets after DPRNT or BPRNT and makes their text in `run.scratch`.
bool read_decimal_output(Run& run, const char*& at);
bool read_binary_output(Run& run, const char*& at);
/// POPEN, PCLOS, or the text that was read.
bool execute_output(Run& run);

struct DecimalField {
  int whole = 0;     ///< digits before the point
  int decimals = 0;  ///< after it
  bool blanks_for_zeros = true;
  bool expands = false;  ///< digits that do not fit are printed, not lost
};
/// As DPRNT does: sign, then blanks or nothing for leading zeros, digits that do not fit are lost.
void append_decimal(std::string& text, double value, const DecimalField& field);
/// As BPRNT does: 32 bits, high byte first; bytes as \xNN.
void append_binary(std::string& text, double value, int decimals);

}  // namespace dripline::interpreter::fanuc
