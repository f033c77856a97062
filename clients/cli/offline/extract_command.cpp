#include <fmt/format.h>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <system_error>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "gateway/interpreter/dialects/centurion/reading/program_extraction.hpp"

namespace dripline::cli {
namespace {

namespace fs = std::filesystem;
using interpreter::centurion::ExtractedProgram;

struct ExtractCommand {
  std::string input;
  std::string folder = ".";
  bool replaces = false;
};

int complain_with(const Error& error, int status = kExitUsage) {
  complain(error);
  return status;
}

Result<void> write_program(const fs::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) {
    const std::string why = std::generic_category().message(errno);
    return fail(Errc::Io, "{}: cannot be written: {}", path.string(), why);
  }
  return {};
}

/// By number: of two with the same number the later one stays, as on the control.
std::map<std::uint32_t, std::string_view> by_number(const std::vector<ExtractedProgram>& programs) {
  std::map<std::uint32_t, std::string_view> numbered;
  for (const auto& program : programs) {
    if (program.number != 0) numbered[program.number] = program.text;
  }
  return numbered;
}

int extract(const Context& context, const ExtractCommand& command) {
  auto file = MappedFile::open(command.input);
  if (!file) return complain_with(file.error());
  const auto programs = interpreter::centurion::extract_programs(file->text());
  if (!programs.empty() && programs.front().number == 0) {
    return complain_with(
        Error{Errc::Syntax,
              fmt::format("{}: there is text in front of the first O number", command.input)},
        kExitNo);
  }
  const auto numbered = by_number(programs);
  if (numbered.empty()) {
    return complain_with(Error{Errc::NotFound, fmt::format("{}: no O number", command.input)},
                         kExitNo);
  }
  if (std::error_code ec; !fs::is_directory(command.folder, ec)) {
    const std::string why = ec && ec != std::errc::no_such_file_or_directory
                                ? ec.message()
                                : "there is no such folder; make it first";
    return complain_with(Error{Errc::NotFound, fmt::format("{}: {}", command.folder, why)});
  }
  const auto path_of = [&](std::uint32_t number) {
    return fs::path(command.folder) / fmt::format("O{:04}", number);
  };
  for (const auto& program : numbered) {
    if (command.replaces || !fs::exists(path_of(program.first))) continue;
    return complain_with(Error{Errc::Busy, fmt::format("{} exists; --replace writes over it",
                                                       path_of(program.first).string())},
                         kExitNo);
  }
  for (const auto& program : numbered) {
    const auto path = path_of(program.first);
    if (auto done = write_program(path, program.second); !done) return complain_with(done.error());
    context.print(fmt::format("{}  {} bytes\n", path.string(), program.second.size()));
  }
  return kExitOk;
}

}  // namespace

void add_extract_command(Command app, Context& context) {
  auto command = app.add_subcommand("extract", "Split a text with several programs at its O lines");
  auto options = std::make_shared<ExtractCommand>();
  command.add_option("FILE", options->input, "Text that a control or another computer sent")
      .required();
  command.add_option("-o,--output", options->folder, "Folder for O0001 and so on [.]");
  command.add_flag("--replace", options->replaces, "Overwrite files that exist");
  command.footer("No server is needed.\n\nExample:\n  dnc extract received.txt -o programs");
  command.callback([&context, options] { context.status = extract(context, *options); });
}

}  // namespace dripline::cli
