#pragma once

#include <cstddef>
#include <span>

#include "protocol/wire/discipline.hpp"

namespace dripline::fuzz {

/// Plays `script` to one end of a line: characters, faults, modem lines, time, and its owner's
/// wishes in any order. Ends the process unless
/// - characters cut into single ones give the same events and answers as whole pieces,
/// - no more text is kept, sent or offered than the interface allows, and
/// - a deadline that has passed is moved by tick and transmit.
void play_line_script(const wire::LineSettings& settings, wire::Role role,
                      std::span<const std::byte> script);

}  // namespace dripline::fuzz
