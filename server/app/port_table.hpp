#pragma once

#include <toml++/toml.h>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"
#include "storage/port_store.hpp"

namespace dripline::app {

/// Reads the serial ports of a configuration file:
///
///     [[port]]
///     name = "mill-3"                  # default: the machine's name
///     machine = "mill-3"
///     address = "/dev/ttyUSB0"         # or tcp://host:port, rfc2217://host:port
///     template = "tnc155"
///     enabled = true                   # the default
///     rules_file = "rules.toml"        # or rules = '''...''', the text itself
///     baud = 4800                      # and every other key of a line (dnc port templates)
///
/// What the line's keys mean is judged when the port is saved. Errors: Syntax, NotFound (a file),
/// LimitExceeded; they name line and key.
Result<std::vector<storage::Port>> read_ports(const toml::node& node, const std::string& folder);

}  // namespace dripline::app
