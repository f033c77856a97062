#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"
#include "protocol/base/result.hpp"

/// The control's program memory as data: what it can hold, and its directory.
namespace dripline::interpreter::tnc155 {

struct MemoryLimits {
  std::size_t programs = 32;
  std::size_t blocks = 3'100;  ///< of all programs; a TNC 151 may have 1200
  std::size_t blocks_per_program = 999;
  /// Counting may stop after this many, the highest block number.
  static constexpr std::size_t kMaxCounted = 65'534;
  static constexpr std::int32_t kHighestNumber = 99'999'999;
};

/// A line of the directory.
struct StoredProgram {
  std::int32_t number = 0;  ///< 0 is the central tool store
  Form form = Form::Plain;
  Units units = Units::Millimeter;
  bool is_protected = false;   ///< against erasing and editing: P, G50
  std::size_t blocks = 0;      ///< all of them, the first and the last included
  std::size_t characters = 0;  ///< what an ISO directory shows
};

/// Whether the program that begins with `head` is marked as protected against erasing and editing.
bool is_protected(std::string_view head);

/// Loads the program and those it calls as if into an empty memory (`memory_check.cpp`). Errors:
/// those of the control's options.
Result<MemoryVerdict> check_memory(const Setup& setup, ProgramSource& source);

/// Programs by number. A program of a number that is there replaces it, unless it is protected.
class ProgramMemory {
 public:
  explicit ProgramMemory(MemoryLimits limits = {}) : limits_(limits) {}

  /// Errors: LimitExceeded (programs, blocks, blocks of one program), Denied (protected).
  Result<void> store(const StoredProgram& program);
  /// Errors: NotFound, Denied (protected).
  Result<void> erase(std::int32_t number);

  const std::vector<StoredProgram>& directory() const { return programs_; }
  std::size_t vacant_blocks() const { return limits_.blocks - used_blocks(); }
  /// As on the screen: "12345678   17" with blocks, or "12345678/  530" with characters in ISO.
  std::string listing() const;

 private:
  std::size_t used_blocks() const;
  std::vector<StoredProgram>::iterator find(std::int32_t number);

  MemoryLimits limits_;
  std::vector<StoredProgram> programs_;
};

}  // namespace dripline::interpreter::tnc155
