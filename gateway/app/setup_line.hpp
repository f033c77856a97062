#pragma once

#include "gateway/app/options.hpp"
#include "gateway/interpreter/core/option.hpp"

namespace dripline::gateway {

/// The settings of the gateway's line where it is the control: what the line's own options leave
/// open and the setup says, as a TNC's `heading_letter`. Errors: Syntax, naming the option.
Result<wire::LineSettings> line_settings_of(const LineOptions& line,
                                            const interpreter::Options& control);

}  // namespace dripline::gateway
