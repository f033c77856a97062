#pragma once

#include <string>

#include "clients/tools/conversational/events.hpp"
#include "protocol/base/result.hpp"

namespace dripline::conversational {

struct PostOptions {
  /// A thread given by its crest: the distance of the round nose from a sharp root is computed as
  /// the manual prints it, from compensated non-movement blocks, and subtracted twice, which makes
  /// the thread too shallow. False posts a formula of the nose radius (P261).
  bool has_printed_crest_formula = false;
};

/// The program the control posts for these events, one block a line, each ended by LF. Pure.
/// Errors: Syntax, naming the event by its number: events out of their order (set-up first, end of
/// program last, patterns begun, ended and finished).
Result<std::string> post(const Events& events, const PostOptions& options = {});

}  // namespace dripline::conversational
