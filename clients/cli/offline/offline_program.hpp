#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "clients/cli/command_line.hpp"
#include "clients/cli/exit_status.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/machine_data.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// The request of `check` and `trace`.
struct OfflineCommand {
  std::string file;
  std::string control;  ///< empty: found out from the text and the file's name
  std::string setup;    ///< empty: everything at its default
};

/// A program on disk with everything its interpretation needs. An image of a punched tape, EIA or
/// ISO, is read as the text it holds.
class OfflineProgram {
 public:
  /// Errors: Io, Unsupported, Syntax, NotFound; all are usage errors (exit status 2). A control
  /// that is not clear from the text is NotFound, with the candidates.
  static Result<OfflineProgram> open(const OfflineCommand& command);

  const interpreter::Dialect& dialect() const { return *dialect_; }
  const interpreter::Setup& setup() const { return setup_; }
  /// `[machine]` of the setup.
  const interpreter::MachineData& machine() const { return machine_; }
  std::string_view text() const { return tape_text_ ? *tape_text_ : file_.text(); }
  /// Called programs come from the setup's library, or from the program's own folder when the setup
  /// names none. Must not outlive this object.
  interpreter::MemorySource source() const;
  /// The file of a program of a run on `source`: FILE, or where the called one was found.
  std::string file_of(const interpreter::MemorySource& source,
                      interpreter::ProgramIndex program) const;
  /// "line 5", or "line 5 of 2.h" in a called program.
  std::string place_of(const interpreter::MemorySource& source, interpreter::ProgramIndex program,
                       std::uint64_t line) const;
  /// That of an outcome's alarm.
  std::string alarm_place(const interpreter::MemorySource& source,
                          const interpreter::OfflineOutcome& outcome) const;

 private:
  OfflineProgram(MappedFile file, const interpreter::Dialect& dialect)
      : file_(std::move(file)), dialect_(&dialect) {}
  MappedFile file_;
  std::string path_;
  std::unique_ptr<const std::string>
      tape_text_;  ///< when the file is a tape image; stays where it is
  const interpreter::Dialect* dialect_;
  interpreter::Setup setup_;
  interpreter::MachineData machine_;
  std::string library_;
};

/// FILE, --control and --setup, as both offline verbs take them.
inline void add_offline_options(Command command, OfflineCommand& options) {
  command.add_option("FILE", options.file, "The NC program").required();
  command.add_option(
      "--control", options.control,
      "Its control, e.g. centurion (default: detected from the text and the file name)");
  command.add_option("--setup", options.setup,
                     "TOML file: start, tools, offsets, variables, answers, probe surfaces, "
                     "options of the control, library of called programs");
}

/// The setup in a file, for a control; without a path all is at its default. Errors: Io, Syntax,
/// LimitExceeded.
Result<interpreter::Setup> read_setup(const std::string& path, const interpreter::Dialect& dialect);
/// The same of its `[machine]`.
Result<interpreter::MachineData> read_machine(const std::string& path,
                                              const interpreter::Dialect& dialect);

/// The status for an interpretation that could not be carried through: a program that never ends is
/// the program's fault, anything else (setup, missing answers) the user's to correct.
inline int complain_offline(const Error& error) {
  complain(error);
  return error.code == Errc::LimitExceeded ? kExitNo : kExitUsage;
}

/// The file in `folder` that holds the program called `name`, with the folder: the first of
/// `interpreter::called_program_names` that can be read.
std::optional<std::string> find_called_program(const std::string& folder, std::string_view name);

/// Its text.
std::optional<std::string> load_called_program(const std::string& folder, std::string_view name);

}  // namespace dripline::cli
