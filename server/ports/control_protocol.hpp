#pragma once

#include <string>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"
#include "storage/setup_store.hpp"

namespace dripline::ports {

/// Whether the machine's control has a line's protocol, as far as its newest setup names the
/// control: a TNC 151/155 E or V has no transfer blockwise. Without a setup nothing is known, and
/// nothing is refused. Errors: Unsupported, naming machine and setup.
Result<void> check_protocol(storage::SetupStore& store, const std::string& machine,
                            wire::Flow flow);

}  // namespace dripline::ports
