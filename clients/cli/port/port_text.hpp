#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "clients/cli/context.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/lib/api_types.hpp"

/// How ports look. Pure.

namespace dripline::cli {

/// "9600e72 xonxoff".
std::string line_text(const client::Settings& effective);
/// The activity of the line: "sending, stopped by the control, waits for ACK without limit since
/// 12:01".
std::string state_text(const client::Port& port);
/// The same in two cells of a listing: "sending, stopped" and "ACK for 12:34, no limit". `now` is
/// ISO 8601 UTC.
std::string short_state(const client::Port& port);
std::string wait_text(const client::Port& port, std::string_view now);
/// The unanswered request of the control: "the control asked for a program at 12:01; no run waits".
std::string request_text(const std::optional<client::Port::Request>& request);
Style style_of_state(const client::Port& port);
Details port_details(const client::Port& port);
/// A note where the baud rate of the control's setup is not the line's; else empty.
std::string baud_warning(const client::Port& port, std::optional<int> control_rate);

// Lists ports and their settings. Each function returns the exit status.

int list_ports(Context& context, client::Client& client);
int show_port(Context& context, client::Client& client, const std::string& name);
/// `name` empty: all of them.
int list_templates(Context& context, client::Client& client, const std::string& name);

}  // namespace dripline::cli
