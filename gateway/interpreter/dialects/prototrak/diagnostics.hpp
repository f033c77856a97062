#pragma once

#include <cstdint>
#include <string_view>

/// What can be wrong with a program. The control has no error texts; the numbers are ours (spec
/// 18).
namespace dripline::interpreter::prototrak {

enum class Fault : std::uint8_t {
  NoBlockEnd,       // 102
  Character,        // 103
  Range,            // 104
  NoNumber,         // 105
  MemoryFull,       // 106
  NoFunction,       // 107
  MissingWord,      // 108
  UnknownWord,      // 109
  NoEnd,            // 110
  TextFailed,       // 111
  ArcRadii,         // 201
  RepeatRange,      // 202
  Join,             // 203
  ToolDoesNotFit,   // 204
  LoopLimit,        // 205
  NotConnectable,   // 301
  Ignored,          // 302
  SideContradicts,  // 303
  Noticed,          // 304
};

struct FaultRow {
  Fault fault;
  std::string_view id;
  std::string_view text;
};
const FaultRow& fault_row(Fault fault);

}  // namespace dripline::interpreter::prototrak
