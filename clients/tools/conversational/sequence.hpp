#pragma once

#include "clients/tools/conversational/events.hpp"
#include "protocol/base/result.hpp"

namespace dripline::conversational {

/// What must hold between events: the set-up is event 0 and only that, the end is the last and only
/// that, every pattern ends before another begins or is finished, and no number is used for two
/// (the control looks for a pattern's labels from the program's start). Errors: Syntax.
Result<void> check_sequence(const Events& events);

}  // namespace dripline::conversational
