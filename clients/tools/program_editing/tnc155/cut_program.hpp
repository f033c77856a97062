#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/program_editing/program_edit.hpp"
#include "clients/tools/tnc_conversion/program_text.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"
#include "protocol/base/result.hpp"

namespace dripline::program_editing {

using interpreter::tnc155::Form;
using interpreter::tnc155::ReadingState;
using tnc_conversion::TextLayout;

/// A block as written in the text.
struct TextBlock {
  const char* begin = nullptr;
  const char* end = nullptr;    ///< without what ends it and blanks in front of that
  const char* stop = nullptr;   ///< the character that ends it, as a reader wants it
  const char* after = nullptr;  ///< where the next block begins
  std::int64_t number = kNoNumber;

  /// In one line.
  std::string text() const;
};

/// A whole program cut into blocks as the readers cut it, but without reading its words, so that
/// a faulty block can be repaired. Keeps a copy of the text, which its blocks point into.
class CutProgram {
 public:
  explicit CutProgram(std::string_view text);
  CutProgram(const CutProgram&) = delete;
  CutProgram& operator=(const CutProgram&) = delete;

  /// Errors: Syntax (no program of this control).
  Result<void> check() const;
  Form form() const { return state_.program.form; }
  /// Ends with a line end; `is_line_end_added` where the program's own text does not.
  const std::string& text() const { return text_; }
  bool is_line_end_added() const { return is_line_end_added_; }
  const std::vector<TextBlock>& blocks() const { return blocks_; }
  std::vector<std::int64_t> numbers() const;
  /// What is in force after the first block.
  const ReadingState& state() const { return state_; }
  /// Line ends and decimal signs as the text has them.
  const TextLayout& layout() const { return layout_; }
  /// The first block names the program and its units.
  bool has_head() const { return has_head_; }
  bool is_numbered() const { return is_numbered_; }        ///< at least one block is
  bool is_consecutive() const { return is_consecutive_; }  ///< plain language: as in the memory

 private:
  void cut();
  void take_numbers();
  void read_head_block();

  bool is_line_end_added_;
  std::string text_;
  ReadingState state_;
  std::vector<TextBlock> blocks_;
  TextLayout layout_;
  bool has_head_ = false;
  bool is_numbered_ = false;
  bool is_consecutive_ = true;
};

}  // namespace dripline::program_editing
