#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/comparison/normal_form.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/result.hpp"

namespace dripline::comparison {

/// The text of one program; the source must hold all of it and outlive the comparison. Each side
/// has a source of its own.
struct TextSide {
  interpreter::ProgramSource& source;
  std::uint64_t size = 0;
  std::string_view control;  ///< whose lexical rules apply; empty: none
};

/// Lines that follow each other.
struct LineRange {
  std::uint64_t line = 1;  ///< the first one; of an empty range the line before which it is
  std::uint64_t count = 0;
  std::uint64_t offset = 0;  ///< of the first byte
  std::uint64_t size = 0;    ///< bytes, with the ends of the lines
};

/// Lines of one program in the place of lines of the other.
struct TextHunk {
  LineRange first, second;
  TextChange change = TextChange::None;
};

struct TextOptions {
  /// Lines are compared in their normal form (`append_normal`); lines without any are passed over.
  bool normalized = false;
  std::size_t max_hunks = 10'000;  ///< kept; all are counted
};

struct TextResult {
  bool is_same = true;
  std::uint64_t hunk_count = 0;
  std::uint64_t first_lines = 0, second_lines = 0;  ///< that are in hunks
  std::vector<TextHunk> hunks;                      ///< the first ones, in order
  /// The largest of all hunks. None: comments, blanks and forms of numbers alone. Only the motion
  /// proves it: an F word is the lead of a thread too.
  TextChange change = TextChange::None;
};

/// Compares two programs line by line. Equal beginnings and ends are passed by their bytes; what is
/// between is compared in windows of up to 65,536 lines, so that memory is bounded, whatever the
/// size (each window at most 16 MiB of text). Lines that moved further than a window are reported
/// as taken out and put in. One thread.
class TextComparison {
 public:
  /// Called with each hunk, in order; hunks never touch each other.
  using Take = std::function<void(const TextHunk&)>;

  TextComparison(const TextSide& first, const TextSide& second, TextOptions options,
                 Take take = {});
  TextComparison(TextComparison&&) noexcept;
  ~TextComparison();

  /// Compares up to one window. True: it is over. Errors: Io.
  Result<bool> step();
  const TextResult& result() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// All of it at once. Errors: Io.
Result<TextResult> compare_text(const TextSide& first, const TextSide& second,
                                TextOptions options = {}, TextComparison::Take take = {});

}  // namespace dripline::comparison
