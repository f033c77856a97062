#pragma once

#include <string>
#include <string_view>

#include "gateway/interpreter/core/refusal.hpp"
#include "protocol/base/result.hpp"

namespace dripline::library {

using interpreter::Refusal;

/// The control's own words: "error 300: program already exists"; empty: it has no number for this
/// refusal, or numbers none. Pure.
std::string control_words(std::string_view control, Refusal refusal);

/// The error with the control's words after it, for an operator who knows those:
/// "... exists already (centurion error 300: program already exists)".
Error with_control_words(Error error, std::string_view control, Refusal refusal);

}  // namespace dripline::library
