#pragma once

#include <cstdint>

namespace dripline::interpreter {

/// What program storage refuses and what controls have a message for too.
enum class Refusal : std::uint8_t {
  None,
  NameTaken,        ///< a program of that name exists
  BadNumber,        ///< no number that the control takes
  NothingToSelect,  ///< no program at all
  NotSaved,         ///< a program could not be stored
  NotLoaded,        ///< a stored program could not be read
  OntoItself,       ///< copied or renamed to its own name
  BadParameters,    ///< tools, offsets and parameters that the control would not take
  MemoryFull,       ///< the control's memory for programs
  DiskFull,         ///< of the computer that stores programs
  NoSuchProgram,
};

}  // namespace dripline::interpreter
