#pragma once

#include <string>

#include "clients/cli/offline/graphics_options.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// Which TNC 151/155 a setup file describes; of no file (an empty name) the newest, which has
/// everything. Errors: Io, Syntax; naming the file.
Result<interpreter::tnc155::ControlVersion> tnc_version_of(const std::string& setup_file);

/// Whether the TNC that the program's setup describes could show what the command asks for; other
/// controls have no graphics of their own. Errors: Unsupported.
Result<void> check_tnc_graphics(const GraphicsCommand& command, const OfflineProgram& program);

}  // namespace dripline::cli
