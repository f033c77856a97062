#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/wire/tape_image.hpp"

namespace dripline::cli {

/// Removes text in parentheses for a code that has none, a piece at a time.
class CommentFilter {
 public:
  /// Appends what is left of `text`. Errors: Syntax (a comment that does not end in its block, or
  /// an end without a beginning; names the line).
  Result<void> filter(std::string_view text, std::string& left);
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t line_ = 1, count_ = 0;
  bool is_inside_ = false;
};

/// From one tape code, or text, to another; in pieces, so that any length passes in little memory.
class TapeConversion {
 public:
  struct Parts {
    wire::TapeReading from;
    wire::TapeForm to;
    bool drops_comments = false;
  };
  using Write = std::function<Result<void>(std::string_view)>;

  TapeConversion(Parts parts, Write write);
  /// Errors: those of TapePunch and TapeReader, and of `write`.
  Result<void> begin();
  Result<void> convert(std::span<const std::byte> rows);
  Result<void> finish();

  const wire::TapeSummary& source() const { return reader_.summary(); }
  std::uint64_t dropped_comments() const { return comments_.count(); }

 private:
  Result<void> punch_text();
  Result<void> write_rows();
  wire::TapeReader reader_;
  wire::TapePunch punch_;
  bool drops_comments_;
  CommentFilter comments_;
  Write write_;
  std::string text_, kept_;
  std::vector<std::byte> rows_;
};

}  // namespace dripline::cli
