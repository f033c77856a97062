#pragma once

#include <cstdint>
#include <string>

#include "server/library/programs.hpp"

namespace dripline::ports {

/// A program that a control sends while it arrives: the first 64 KiB in memory, longer ones as an
/// upload. It becomes a revision that is held until it is accepted. One thread; dropped when
/// it is destroyed before `store`.
class UploadedProgram {
 public:
  static constexpr std::size_t kInMemory = 64 * 1024;
  struct Origin {
    std::string machine;
    std::string control;  ///< of the machine; empty: found out from the text
  };
  UploadedProgram(library::Programs& programs, Origin origin)
      : programs_(programs), origin_(std::move(origin)) {}
  ~UploadedProgram();
  UploadedProgram(const UploadedProgram&) = delete;
  UploadedProgram& operator=(const UploadedProgram&) = delete;

  /// Errors: those of library::Programs; nothing is kept then, and every later call fails too.
  Result<void> append(const std::string& text);
  /// `name` in the library, made fit to be one. Errors: the same, Syntax (empty).
  Result<library::Committed> store(const std::string& name);
  /// Part of it was received damaged: its comment warns the operator who accepts it. A long one,
  /// whose comment was written before, cannot be stored any more.
  void damage(const std::string& how);
  /// Its name when neither the protocol nor a rule nor the text gives one.
  std::string fallback_name() const { return origin_.machine + "-punched"; }

 private:
  Result<void> spill(const std::string& name);
  std::string comment() const;
  std::string who() const { return "machine " + origin_.machine; }

  library::Programs& programs_;
  const Origin origin_;
  std::string text_;
  std::string upload_;
  std::string upload_name_;
  std::uint64_t spilled_ = 0;
  std::string first_damage_;
  std::uint64_t damages_ = 0;
  std::optional<Error> error_;
};

/// `name` with what a program name cannot have replaced by `-`; empty when nothing is left.
std::string fit_program_name(std::string_view name);

}  // namespace dripline::ports
