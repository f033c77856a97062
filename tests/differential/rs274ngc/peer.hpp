#pragma once

#include <filesystem>
#include <string>

#include "tests/differential/rs274ngc/moves.hpp"

namespace dripline::differential {

/// The stand-alone interpreter of Debian's linuxcnc-uspace.
bool has_peer();

/// The peer's tool table; `tools_of_setup` says the same to ours.
std::string tool_table();

/// Runs the peer on a program file, lengths with nine decimals.
Behavior run_peer(const std::filesystem::path& program, const std::filesystem::path& tools);

/// Ours, with the profile `linuxcnc` and the same tools. `folder` holds called files.
Behavior run_ours(const std::string& program, const std::filesystem::path& folder);

}  // namespace dripline::differential
