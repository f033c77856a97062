#pragma once

#include <string>

#include "gateway/interpreter/core/refusal.hpp"

namespace dripline::interpreter::centurion {

/// "error 300: program already exists"; empty: the control has no number for it. Pure.
std::string refusal_words(Refusal refusal);

}  // namespace dripline::interpreter::centurion
