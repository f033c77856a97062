#pragma once

#include <memory>
#include <string>

#include "clients/cli/offline/mapped_file.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/memory_source.hpp"
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
  std::string library_;
};

}  // namespace dripline::cli
