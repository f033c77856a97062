#pragma once

#include <string>

#include "gateway/interpreter/dialects/prototrak/program_event.hpp"

namespace dripline::interpreter::prototrak {

/// The stored program as the control sends it: one event a line in its own event format, every
/// coordinate absolute, numbers with their point. Receiving it gives the same events.
std::string list_events(const StoredProgram& program);

}  // namespace dripline::interpreter::prototrak
