#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::library {

/// What is refused here and what controls have a message for too.
enum class Refusal {
  None,
  NameTaken,        ///< a program of that name exists
  BadNumber,        ///< no number that the control takes
  NothingToSelect,  ///< no program at all
  NotSaved,         ///< a program could not be stored
  NotLoaded,        ///< a stored program could not be read
  OntoItself,       ///< copied or renamed to its own name
  BadParameters,    ///< tools, offsets and parameters that the control would not take
  MemoryFull,       ///< the control's memory for programs
  DiskFull,         ///< ours
  NoSuchProgram,
};

/// The control's own words: "error 300: program already exists"; empty: it has no number for this
/// refusal, or numbers none. Pure.
std::string control_words(std::string_view control, Refusal refusal);

/// The error with the control's words after it, for an operator who knows those:
/// "... exists already (centurion error 300: program already exists)".
Error with_control_words(Error error, std::string_view control, Refusal refusal);

}  // namespace dripline::library
