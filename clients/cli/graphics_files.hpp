#pragma once

#include <string>
#include <string_view>

#include "clients/cli/graphics_options.hpp"
#include "gateway/graphics/picture.hpp"

namespace dripline::cli {

/// The whole file or none of it. Errors: Io.
Result<void> write_file(const std::string& path, std::string_view bytes);

/// The picture as PNG, and for a printer, where the command asks for them. Errors: Io, NotFound
/// (the printer).
Result<void> write_picture(const GraphicsCommand& command, const graphics::Picture& picture);

}  // namespace dripline::cli
