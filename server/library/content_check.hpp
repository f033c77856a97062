#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/base/result.hpp"

namespace dripline::library {

/// Checks every byte of a program while it is uploaded, in pieces of any size: the verdict does not
/// depend on how the text was cut. Text that passes is UTF-8 without NUL and without endless lines,
/// so its readers need no such checks. Constant memory; one thread at a time.
class ContentCheck {
 public:
  static constexpr std::uint64_t kMaxLine = 64 * 1024;

  /// The next bytes. Errors: Syntax (NUL, invalid UTF-8), LimitExceeded (a line longer than
  /// kMaxLine); each names offset, line and value. After an error the check must not be used again.
  Result<void> feed(std::span<const std::byte> bytes);
  /// Nothing follows. Errors: Syntax (empty, or the last character is cut off).
  Result<void> finish() const;
  std::uint64_t offset() const { return offset_; }

 private:
  Result<void> take(std::uint8_t byte);
  Result<void> begin_character(std::uint8_t byte);
  Result<void> continue_character(std::uint8_t byte);

  std::uint64_t offset_ = 0;
  std::uint64_t line_ = 1;
  std::uint64_t line_length_ = 0;
  int missing_ = 0;              ///< continuation bytes of the character begun
  std::uint8_t lowest_ = 0x80;   ///< bounds of the next continuation byte: they keep out overlong
  std::uint8_t highest_ = 0xBF;  ///< forms, surrogates and numbers after U+10FFFF
};

}  // namespace dripline::library
