#include "clients/cli/offline_program.hpp"

#include <filesystem>

#include "clients/cli/program_folder.hpp"

namespace dripline::cli {
namespace {

namespace fs = std::filesystem;
using interpreter::Dialect;

constexpr std::size_t kHead = 64 * 1024;
constexpr std::size_t kMaxSetup = 16 * 1024 * 1024;

std::string names_of(const std::vector<const Dialect*>& dialects) {
  std::string names;
  for (const auto* dialect : dialects) {
    if (!names.empty()) names += ", ";
    names += dialect->name;
  }
  return names;
}

std::vector<const Dialect*> all_dialects() {
  std::vector<const Dialect*> all;
  for (const auto& dialect : interpreter::dialects()) all.push_back(&dialect);
  return all;
}

Result<const Dialect*> choose_dialect(const OfflineCommand& command, std::string_view text) {
  if (!command.control.empty()) return interpreter::find_dialect(command.control);
  const std::string name = fs::path(command.file).filename().string();
  const auto candidates = interpreter::detect_dialect(text.substr(0, kHead), name);
  if (candidates.size() == 1) return candidates.front();
  if (candidates.empty()) {
    return fail(Errc::NotFound,
                "the control of {} can not be told from its text; expected --control with one of: "
                "{}",
                command.file, names_of(all_dialects()));
  }
  return fail(Errc::NotFound,
              "{} could be for several controls; expected --control with one of: {}", command.file,
              names_of(candidates));
}

Result<interpreter::Setup> read_setup(const std::string& path, const Dialect& dialect) {
  if (path.empty()) return interpreter::Setup{};
  auto file = MappedFile::open(path);
  if (!file) return fail(file.error());
  if (file->text().size() > kMaxSetup) {
    return fail(Errc::LimitExceeded, "setup file {} has {} bytes, expected at most {}", path,
                file->text().size(), kMaxSetup);
  }
  auto setup = interpreter::parse_setup(file->text(), dialect.units);
  if (!setup) return fail(setup.error().code, "setup file {}: {}", path, setup.error().what);
  return setup;
}

/// The folder of called programs.
std::string library_folder(const OfflineCommand& command, const interpreter::Setup& setup) {
  const fs::path own = fs::path(command.file).parent_path();
  if (!setup.library_path) return own.string();
  return (fs::path(command.setup).parent_path() / *setup.library_path).string();
}

}  // namespace

Result<OfflineProgram> OfflineProgram::open(const OfflineCommand& command) {
  auto file = MappedFile::open(command.file);
  if (!file) return fail(file.error());
  auto dialect = choose_dialect(command, file->text());
  if (!dialect) return fail(dialect.error());
  auto setup = read_setup(command.setup, **dialect);
  if (!setup) return fail(setup.error());
  OfflineProgram program(std::move(*file), **dialect);
  program.setup_ = std::move(*setup);
  program.library_ = library_folder(command, program.setup_);
  return program;
}

interpreter::MemorySource OfflineProgram::source() const {
  return interpreter::MemorySource(file_.text(), [folder = library_](std::string_view name) {
    return load_called_program(folder, name);
  });
}

}  // namespace dripline::cli
