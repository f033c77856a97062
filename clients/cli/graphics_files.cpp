#include "clients/cli/graphics_files.hpp"

#include "clients/lib/output_file.hpp"
#include "gateway/graphics/hardcopy.hpp"

namespace dripline::cli {

Result<void> write_file(const std::string& path, std::string_view bytes) {
  auto file = client::OutputFile::create(path);
  if (!file) return fail(file.error());
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

Result<void> write_picture(const GraphicsCommand& command, const graphics::Picture& picture) {
  if (!command.output.empty()) {
    const auto bytes = picture.png();
    if (!bytes) return fail(bytes.error());
    if (auto done = write_file(command.output, *bytes); !done) return done;
  }
  if (command.print.empty()) return {};
  const auto printer = graphics::find_printer(command.printer);
  if (!printer) return fail(printer.error());
  return write_file(command.print, graphics::hardcopy(picture, *printer));
}

}  // namespace dripline::cli
