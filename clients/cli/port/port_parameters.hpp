#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/context.hpp"
#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::cli {

/// `dnc port parameters`: the interface of a TNC 151/155 by its machine parameters, and the line.
void add_port_parameters_command(Command group, Context& context);

// Lines on the command line: how one is named, and how it is written for `dnc port add`.

/// A template or a short form such as 9600e72, and KEY=VALUE over it. Errors: NotFound, and those
/// of the settings.
Result<wire::LineSettings> line_named(const std::string& name,
                                      const std::vector<std::string>& changes);

/// Prints `--template NAME KEY=VALUE ...`: what the line has otherwise than its template. Gives the
/// exit status.
int show_line(Context& context, std::string_view template_name, const wire::LineSettings& line);

}  // namespace dripline::cli
