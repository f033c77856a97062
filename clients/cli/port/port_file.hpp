#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/lib/client.hpp"
#include "protocol/base/result.hpp"

/// Files about ports.
namespace dripline::cli {

/// All of a file, of at most `limit` bytes. Errors: Io, Unsupported, LimitExceeded; each names it.
Result<std::string> read_small_file(const std::string& path, std::size_t limit);

inline constexpr std::size_t kMaxRulesFile = 32 * 1024;

/// The ports of a TOML file, as dncd takes them in its settings, see deploy/examples/ports.toml;
/// rules files are beside it. Errors:
/// Syntax and LimitExceeded (naming file, line and key), and those of read_small_file.
Result<std::vector<client::PortRequest>> read_port_file(const std::string& path);

/// One `key=value` of a command line, or a short form such as 9600e72, which takes away what stood
/// over it (baud, parity ...); an empty value takes the port's own setting away. Errors: Syntax.
Result<void> apply_setting(client::Settings& settings, std::string_view text);

}  // namespace dripline::cli
