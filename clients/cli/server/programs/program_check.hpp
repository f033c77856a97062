#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "clients/cli/command_line.hpp"

namespace dripline::cli {

class Context;

/// `program check`: what is wrong with a revision of the server, on a machine's setup.
void add_program_check(Command group, Context& context);

/// The server's findings (server/paths/README.md) as NAME@REVISION:LINE:COLUMN lines, then the
/// summary. Lengths in the program's units, X as it is programmed.
std::string program_check_text(const nlohmann::ordered_json& result, bool has_color);

}  // namespace dripline::cli
