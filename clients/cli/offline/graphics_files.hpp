#pragma once

#include <string>
#include <string_view>

#include "clients/cli/offline/graphics_options.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/graphics/picture.hpp"

namespace dripline::cli {

/// The picture as PNG, and for a printer, where the command asks for them. The printer is the one
/// that was named, else that of the setup's machine parameters 226 to 233, else an EPSON. Errors:
/// Io, NotFound (the printer), Syntax, LimitExceeded (a machine parameter); nothing is written
/// then.
Result<void> write_picture(const GraphicsCommand& command, const interpreter::Setup& setup,
                           const graphics::Picture& picture);

}  // namespace dripline::cli
