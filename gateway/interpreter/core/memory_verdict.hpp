#pragma once

#include <vector>

#include "gateway/interpreter/core/diagnostic.hpp"

namespace dripline::interpreter {

/// Whether a control could keep a program, with all those it calls, in its part-program memory.
struct MemoryVerdict {
  /// The setup says that the control keeps its programs, so a program it refuses cannot run.
  /// Otherwise programs are drip-fed, and a refusal is only worth a warning.
  bool is_binding = false;
  /// In the order in which the programs would be loaded. Lines are those of the program that was
  /// started; for a called program it is the line of its call.
  std::vector<Diagnostic> refused;
};

}  // namespace dripline::interpreter
