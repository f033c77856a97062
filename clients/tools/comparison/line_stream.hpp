#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/result.hpp"

namespace dripline::comparison {

struct TextLine {
  std::uint64_t number = 0;  ///< from 1
  std::uint64_t offset = 0;
  std::string_view text;  ///< without its LF; valid until the next call
  bool has_end = false;   ///< with LF; false: the last line, or a part of a line beyond the limit
};

/// The lines of a program, read in windows. A line of more than kMaxLine bytes comes in parts that
/// have one number. The source must hold all of the text.
class LineStream {
 public:
  explicit LineStream(interpreter::ProgramSource& source,
                      interpreter::ProgramIndex program = interpreter::kMainProgram)
      : source_(source), program_(program) {}

  /// The text ends here, for the stream: where a line begins.
  void set_limit(std::uint64_t limit) { limit_ = limit; }

  /// False: there are no more, or the text cannot be read (`error`).
  bool next(TextLine& line);
  const std::string& error() const { return error_; }  ///< empty: none

  /// Passes the lines that both programs have next, byte for byte.
  static void skip_equal(LineStream& a, LineStream& b);
  std::uint64_t offset() const { return offset_; }  ///< of the next line
  std::uint64_t number() const { return number_; }

  static constexpr std::size_t kMaxLine = interpreter::ProgramSource::kMaxWindow / 2;

 private:
  bool fetch(std::uint64_t offset);
  void move_to(std::uint64_t offset, std::uint64_t number);

  interpreter::ProgramSource& source_;
  interpreter::ProgramIndex program_;
  std::uint64_t offset_ = 0;
  std::uint64_t number_ = 1;
  std::uint64_t limit_ = UINT64_MAX;
  std::string_view window_;  ///< what follows of the window that was fetched last
  bool reaches_end_ = false;
  std::string error_;
};

}  // namespace dripline::comparison
