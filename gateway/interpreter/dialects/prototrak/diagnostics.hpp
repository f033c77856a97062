#pragma once

#include "gateway/interpreter/core/diagnostic.hpp"

/// What can be wrong with a program. The control has no error texts; ids and texts are decided
/// here.
namespace dripline::interpreter::prototrak {

// The rows are named as enumerators are, because they are used as such.
// NOLINTBEGIN(readability-identifier-naming): a row is named as an enumerator would be
struct Fault {
  static constexpr DiagnosticRow NoBlockEnd{"PTK0102", "no end of block"};
  static constexpr DiagnosticRow Character{"PTK0103", "invalid character"};
  static constexpr DiagnosticRow Range{"PTK0104", "value out of range"};
  static constexpr DiagnosticRow NoNumber{"PTK0105", "address without number"};
  static constexpr DiagnosticRow MemoryFull{"PTK0106", "memory full"};
  static constexpr DiagnosticRow NoFunction{"PTK0107", "axis words without motion or event code"};
  static constexpr DiagnosticRow MissingWord{"PTK0108", "required word is missing"};
  static constexpr DiagnosticRow UnknownWord{"PTK0109", "unknown word"};
  static constexpr DiagnosticRow NoEnd{"PTK0110", "end of data without %"};
  static constexpr DiagnosticRow TextFailed{"PTK0111", "program text cannot be read"};
  static constexpr DiagnosticRow ArcRadii{"PTK0201", "radii at begin and end of the arc differ"};
  static constexpr DiagnosticRow RepeatRange{"PTK0202", "bad repeat range"};
  static constexpr DiagnosticRow Join{"PTK0203", "conrad or offset join is impossible"};
  static constexpr DiagnosticRow ToolDoesNotFit{"PTK0204", "tool does not fit"};
  static constexpr DiagnosticRow LoopLimit{"PTK0205", "repeats go on without end"};
  static constexpr DiagnosticRow NotConnectable{"PTK0301", "next event cannot be connected"};
  static constexpr DiagnosticRow Ignored{"PTK0302", "ignored"};
  static constexpr DiagnosticRow SideContradicts{"PTK0303", "tool side contradicts the pocket"};
  static constexpr DiagnosticRow Noticed{"PTK0304", "taken as it is"};
};
// NOLINTEND(readability-identifier-naming)

}  // namespace dripline::interpreter::prototrak
