#pragma once

#include <string>

#include "clients/cli/context.hpp"

/// `dnc program`: what is beside the texts of programs.
namespace dripline::cli {

/// --part, --operation, --material, --machine-group, --cam-file.
void add_field_options(Command command, client::FieldChange& fields);
/// --part, --operation, --material, --machine-group, --control, --author, --state.
void add_choice_options(Command command, client::ProgramChoice& choice);

/// set, search.
void add_library_commands(Command group, Context& context);
/// attach, attachments, download, detach.
void add_attachment_commands(Command group, Context& context);

}  // namespace dripline::cli
