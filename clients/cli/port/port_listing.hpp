#pragma once

#include <string>

#include "clients/cli/context.hpp"

/// Lists ports and their settings. Each function returns the exit status.
namespace dripline::cli {

int list_ports(Context& context, client::Client& client);
int show_port(Context& context, client::Client& client, const std::string& name);
/// `name` empty: all of them.
int list_templates(Context& context, client::Client& client, const std::string& name);

}  // namespace dripline::cli
