#pragma once

#include <string>

#include "clients/lib/api_types.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// The tools, offsets and variables of a setup as tables; lengths in the setup's own units. Errors:
/// those of parse_control_data.
Result<std::string> setup_tables(const client::Setup& setup, bool has_color);

}  // namespace dripline::cli
