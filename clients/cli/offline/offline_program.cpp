#include "clients/cli/offline/offline_program.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include <fmt/core.h>

#include "gateway/interpreter/core/called_program_names.hpp"
#include "protocol/wire/tape_image.hpp"

namespace dripline::cli {

namespace {

namespace fs = std::filesystem;
using interpreter::Dialect;

constexpr std::size_t kHead = 64 * 1024;
constexpr std::size_t kTapeHead = 64 * 1024;
constexpr std::size_t kMaxSetupFile = 16 * 1024 * 1024;

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
                "the control of {} is not clear from its text; expected --control with one of: {}",
                command.file, names_of(all_dialects()));
  }
  return fail(Errc::NotFound,
              "{} could be for several controls; expected --control with one of: {}", command.file,
              names_of(candidates));
}

/// Program text has neither blank rows nor an eighth hole in its first rows.
bool looks_like_tape(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kTapeHead);
  return std::any_of(head.begin(), head.end(),
                     [](char c) { return c == '\0' || static_cast<unsigned char>(c) >= 0x80; });
}

/// The text of a tape image; nothing when the file is no tape. Errors: Corrupt, with the row.
Result<std::unique_ptr<const std::string>> read_tape(const std::string& path,
                                                     std::string_view bytes) {
  if (!looks_like_tape(bytes)) return std::unique_ptr<const std::string>();
  const auto rows = std::as_bytes(std::span(bytes.data(), bytes.size()));
  const auto code = wire::detect_code(rows);
  if (!code || code->code == wire::CharacterCode::Ascii) {
    return std::unique_ptr<const std::string>();  // whatever it is, its control will say so
  }
  wire::TapeReader reader({.code = code->code});
  auto text = std::make_unique<std::string>();
  auto done = reader.read(rows, *text);
  if (done) done = reader.finish(*text);
  if (!done) {
    return fail(done.error().code, "{} ({} tape): {}", path, wire::code_name(code->code),
                done.error().what);
  }
  return std::unique_ptr<const std::string>(std::move(text));
}

/// The folder of called programs.
std::string library_folder(const OfflineCommand& command, const interpreter::Setup& setup) {
  const fs::path own = fs::path(command.file).parent_path();
  if (!setup.library_path) return own.string();
  return (fs::path(command.setup).parent_path() / *setup.library_path).string();
}

}  // namespace

namespace {

/// What `parse` makes of the setup file; without a path all is at its default.
template <class Data>
Result<Data> read_setup_as(const std::string& path, const Dialect& dialect,
                           Result<Data> (*parse)(std::string_view, interpreter::Units)) {
  if (path.empty()) return Data{};
  auto file = MappedFile::open(path);
  if (!file) return fail(file.error());
  if (file->text().size() > kMaxSetupFile) {
    return fail(Errc::LimitExceeded, "setup file {} has {} bytes, expected at most {}", path,
                file->text().size(), kMaxSetupFile);
  }
  auto data = parse(file->text(), dialect.units);
  if (!data) return fail(data.error().code, "setup file {}: {}", path, data.error().what);
  return data;
}

}  // namespace

Result<interpreter::Setup> read_setup(const std::string& path, const Dialect& dialect) {
  return read_setup_as<interpreter::Setup>(path, dialect, interpreter::parse_setup);
}

Result<interpreter::MachineData> read_machine(const std::string& path, const Dialect& dialect) {
  return read_setup_as<interpreter::MachineData>(path, dialect, interpreter::parse_machine_data);
}

Result<OfflineProgram> OfflineProgram::open(const OfflineCommand& command) {
  auto file = MappedFile::open(command.file);
  if (!file) return fail(file.error());
  auto tape = read_tape(command.file, file->text());
  if (!tape) return fail(tape.error());
  const std::string_view text = *tape ? std::string_view(**tape) : file->text();
  auto dialect = choose_dialect(command, text);
  if (!dialect) return fail(dialect.error());
  auto setup = read_setup(command.setup, **dialect);
  if (!setup) return fail(setup.error());
  auto machine = read_machine(command.setup, **dialect);
  if (!machine) return fail(machine.error());
  OfflineProgram program(std::move(*file), **dialect);
  program.machine_ = *std::move(machine);
  program.path_ = command.file;
  program.tape_text_ = std::move(*tape);
  program.setup_ = std::move(*setup);
  program.library_ = library_folder(command, program.setup_);
  return program;
}

interpreter::MemorySource OfflineProgram::source() const {
  return interpreter::MemorySource(text(), [folder = library_](std::string_view name) {
    return load_called_program(folder, name);
  });
}

std::string OfflineProgram::file_of(const interpreter::MemorySource& source,
                                    interpreter::ProgramIndex program) const {
  const std::string name(source.name_of(program));
  if (name.empty()) return path_;
  return find_called_program(library_, name).value_or(name);
}

std::string OfflineProgram::place_of(const interpreter::MemorySource& source,
                                     interpreter::ProgramIndex program, std::uint64_t line) const {
  std::string place = fmt::format("line {}", line);
  if (program != interpreter::kMainProgram) place += " of " + file_of(source, program);
  return place;
}

std::string OfflineProgram::alarm_place(const interpreter::MemorySource& source,
                                        const interpreter::OfflineOutcome& outcome) const {
  return place_of(source, outcome.alarm_program, outcome.alarm->line);
}

std::optional<std::string> find_called_program(const std::string& folder, std::string_view name) {
  for (const auto& file_name : interpreter::called_program_names(name)) {
    const auto path = std::filesystem::path(folder) / file_name;
    std::error_code ec;
    if (std::filesystem::is_regular_file(path, ec) && std::ifstream(path, std::ios::binary)) {
      return path.string();
    }
  }
  return std::nullopt;
}

std::optional<std::string> load_called_program(const std::string& folder, std::string_view name) {
  const auto path = find_called_program(folder, name);
  if (!path) return std::nullopt;
  std::ifstream file(*path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace dripline::cli
