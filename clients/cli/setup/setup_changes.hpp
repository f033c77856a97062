#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// Verbs of `dnc setup` that change something in a machine's newest setup: `parameter`, `pockets`.
/// Versions stored since by others are never overwritten.
void add_setup_changes(Command group, Context& context);

/// The result of saving, as text or JSON.
int report_saved(Context& context, const client::Setup& setup);

}  // namespace dripline::cli
