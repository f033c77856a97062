#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `list`, `insert` and `delete` of `dnc conversational`: the events of a file.
void add_event_editing(Command group, Context& context);

}  // namespace dripline::cli
