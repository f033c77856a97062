#include "clients/cli/offline/graphics_files.hpp"

#include <array>
#include <cmath>

#include "clients/tools/graphics/hardcopy.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"

namespace dripline::cli {
namespace {

/// The printer of the control's parameters; absent: the setup has none of the eight.
Result<std::optional<graphics::Printer>> printer_of(const interpreter::Setup& setup) {
  constexpr int kFirst = 226;
  constexpr double kMaxWord = 65'535;
  const auto parameters = interpreter::tnc155::all_machine_parameters(setup.control);
  if (!parameters) return fail(parameters.error());
  std::array<std::uint16_t, 8> words{};
  bool is_there = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const int number = kFirst + static_cast<int>(i);
    const auto found = parameters->find(number);
    if (found == parameters->end()) continue;
    const double value = found->second;
    if (value < 0 || value > kMaxWord || value != std::floor(value)) {
      return fail(Errc::LimitExceeded, "MP{} = {:g}: expected a whole number from 0 to {:g}",
                  number, value, kMaxWord);
    }
    words[i] = static_cast<std::uint16_t>(value);
    is_there = true;
  }
  if (!is_there) return std::optional<graphics::Printer>();
  auto printer = graphics::printer_of_parameters(words);
  if (!printer) return fail(printer.error());
  return std::optional(std::move(*printer));
}

Result<graphics::Printer> choose_printer(const std::string& name, const interpreter::Setup& setup) {
  if (!name.empty()) return graphics::find_printer(name);
  auto own = printer_of(setup);
  if (!own) return fail(own.error());
  if (*own) return std::move(**own);
  return graphics::find_printer("epson");
}

}  // namespace

Result<void> write_picture(const GraphicsCommand& command, const interpreter::Setup& setup,
                           const graphics::Picture& picture) {
  std::optional<graphics::Printer> printer;
  if (!command.print.empty()) {
    auto chosen = choose_printer(command.printer, setup);
    if (!chosen) return fail(chosen.error());
    printer = std::move(*chosen);
  }
  if (!command.output.empty()) {
    const auto bytes = picture.png();
    if (!bytes) return fail(bytes.error());
    if (auto done = write_file(command.output, *bytes); !done) return done;
  }
  return printer ? write_file(command.print, graphics::hardcopy(picture, *printer))
                 : Result<void>();
}

}  // namespace dripline::cli
