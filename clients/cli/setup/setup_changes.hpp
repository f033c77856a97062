#pragma once

#include <span>
#include <string>
#include <string_view>

#include "clients/cli/context.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// Verbs of `dnc setup` that change something in a machine's newest setup: `parameter`, `pockets`.
/// Versions stored since by others are never overwritten.
void add_setup_changes(Command group, Context& context);

/// The result of saving, as text or JSON, with what has to be done for it to be in force.
int report_saved(Context& context, client::Client& client, const client::Setup& setup);

/// A number in the text of a setup, and what it becomes.
struct SetupChange {
  std::string path;  ///< as tool[3].pocket, control.machine_parameters.MP7
  std::string value;
};

/// The same text with other numbers in it: comments, order and layout stay. Errors: Syntax (no
/// TOML, with the line), NotFound (no number is there).
Result<std::string> with_numbers(std::string_view toml, std::span<const SetupChange> changes);

}  // namespace dripline::cli
