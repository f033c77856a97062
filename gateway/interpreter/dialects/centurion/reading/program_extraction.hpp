#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace dripline::interpreter::centurion {

/// Finds, line by line, where the programs of a text that holds several begin: at each line whose
/// first word is O and a number (manual: RS-232, data format). Blank lines, `%` and comments before
/// the first one belong to it; with a block among them they are a text of their own. One thread.
class ProgramSplitter {
 public:
  /// `line`: without its end; any size. True: it begins the next program, and what came before is a
  /// text of its own.
  bool begins_next(std::string_view line);
  /// Of the program that the last line belongs to; 0: no O line came yet.
  std::uint32_t number() const { return number_; }

 private:
  std::uint32_t number_ = 0;
  bool has_blocks_ = false;  ///< since the last O line
};

/// One program of a text that holds several: from its O line, or the comments in front of the first
/// one, up to the next one. A line that holds nothing but % belongs to none.
struct ExtractedProgram {
  std::uint32_t number = 0;  ///< 0: blocks in front of the first O line
  std::string_view text;     ///< of the text given
};

/// In their order; a number may come twice, the control then keeps the later one. Pure; any
/// thread.
std::vector<ExtractedProgram> extract_programs(std::string_view text);

}  // namespace dripline::interpreter::centurion
