#pragma once

#include <string>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"
#include "storage/port_store.hpp"
#include "storage/setup_store.hpp"

namespace dripline::ports {

/// The line of a port: its template's settings, then its own over them, in order. Errors: NotFound
/// (template, key), Syntax, LimitExceeded (also a baud rate that the template's control, a TNC,
/// does not have); they name the port and the key.
Result<wire::LineSettings> effective_settings(const storage::Port& port);
/// The dialect of the control that the port's template is for; may be empty.
std::string template_control(const storage::Port& port);
/// What two ports must not share: a device by its real path, whatever link names it.
std::string line_identity(const std::string& address);

/// Whether the machine's control has a line's protocol, as far as its newest setup names the
/// control: a TNC 151/155 E or V has no transfer blockwise. Without a setup nothing is known, and
/// nothing is refused. Errors: Unsupported, naming machine and setup.
Result<void> check_protocol(storage::SetupStore& store, const std::string& machine,
                            wire::Flow flow);

}  // namespace dripline::ports
