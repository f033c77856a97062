#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "gateway/interpreter/language/line_reader.hpp"

/// Places that jumps go to, found in text that may still be arriving.
namespace dripline::interpreter::tnc155 {

/// How a line of a program begins, in either form, as far as jumps care.
struct LineHead {
  bool begins_block = false;  ///< has a block number
  std::int64_t number = -1;   ///< the block number, N in ISO
  std::int32_t label = -1;    ///< LBL, G98 L
  bool ends_block = false;    ///< ISO: has its `*`
};
LineHead read_head(std::string_view line);

/// Looks through programs line by line. A search goes on where it stopped when it is called again,
/// and gives back after a bounded number of lines. What it learns is only ever a faster way to the
/// same answer. The windows of other readers of the source are stale after a search.
class TextSearch {
 public:
  enum class Outcome : std::uint8_t { Found, Missing, NotYet, More, Failed };

  explicit TextSearch(ProgramSource& source);

  /// The first block of the program that sets this label (not 0).
  Outcome find_label(ProgramIndex program, std::uint32_t label, TextPlace& found);
  /// The first block of the program that was started with this number.
  Outcome find_block(std::uint32_t number, TextPlace& found);

  /// Why the last call said Failed.
  const std::string& reason() const { return reason_; }

 private:
  static constexpr unsigned kLinesPerCall = 1u << 16;
  static constexpr std::size_t kIndexes = 5;  ///< as many programs as can be open
  static constexpr std::size_t kLabels = 255;

  /// First places of the labels of one program, as far as it has been read.
  struct Index {
    bool is_used = false;
    bool is_complete = false;
    bool after_end = true;     ///< the line before ended its block
    bool is_numbered = false;  ///< `block` has a number
    std::uint64_t last_use = 0;
    TextPlace next;
    TextPlace block;  ///< the block that the next line may go on with
    std::array<std::optional<TextPlace>, kLabels> labels;
  };

  static bool begins_block(const Index& index, std::string_view line, const LineHead& head);
  Index& index_of(ProgramIndex program);
  Outcome next_line(TextPlace& next, SourceLine& line);

  LineReader lines_;
  std::array<Index, kIndexes> indexes_;
  std::uint64_t uses_ = 0;
  TextPlace block_next_;
  std::int64_t block_number_ = -1;
  std::string reason_;
};

}  // namespace dripline::interpreter::tnc155
