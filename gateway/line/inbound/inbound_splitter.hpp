#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/dialects/centurion/reading/program_extraction.hpp"

namespace dripline::line {

class RuleSet;

/// Cuts what a control sends into programs and printed lines while it arrives. A line is an item
/// when it is complete, or when it is cut off: then it says so. A program is several items, because
/// it may be of any size. NUL, DEL and CR are dropped. With `extracts` a program ends where the
/// next one's O line begins, so a text with several becomes several; nothing is left out. One
/// thread; the rules must outlive it.
class InboundSplitter {
 public:
  /// A longer line that is printed becomes several items.
  static constexpr std::size_t kMaxLine = 4096;

  struct Item {
    enum class What : std::uint8_t {
      Line,           ///< text: without its LF
      ProgramBegan,   ///< text: the name, when the protocol carries one
      ProgramText,    ///< text: a piece, LF after each block
      ProgramEnded,   ///< text: its head, at most kProgramHead bytes
      ProgramFailed,  ///< it was cut off
    };
    What what = What::Line;
    std::string text;
    bool is_cut = false;       ///< Line: without its end of block, or text of it is missing
    bool may_be_rest = false;  ///< Line: of what was begun before this transfer
  };

  explicit InboundSplitter(const RuleSet& rules, bool extracts = false)
      : rules_(rules), extracts_(extracts) {}

  /// What such a control sends is a program whatever it looks like: it prints nothing.
  void take_programs_only(bool only) { takes_programs_only_ = only; }
  /// The beginning of what comes next may be missing: its first line may not be whole, and only
  /// what begins as a program is one, also of such a control; not where that line is the end of
  /// a comment. Until the transfer is over.
  void expect_rest() { may_be_rest_ = is_first_of_rest_ = is_lost_ = true; }
  /// Lines say that they may be the rest of an earlier transmission, until a program begins or the
  /// transfer is over.
  void mark_rest() { is_marking_ = true; }
  /// Text was printed that would have been a program otherwise.
  bool has_rest() const { return has_rest_; }
  /// A transfer begins; one with a name, or a requested one, is a program and nothing else.
  void begin(std::string name, bool is_program = false);
  std::vector<Item> take(std::string_view text);
  /// The transfer is over, whether one was begun or not.
  std::vector<Item> end();
  /// Silence ended it: a printed line that has no end of block may not be whole.
  std::vector<Item> end_silent();
  /// Text before what comes next is lost.
  void lose() { is_lost_ = true; }
  /// It was cut off: what was printed stays, a program does not.
  std::vector<Item> fail();
  /// What is coming in is a program, or may turn out to be one; false: it is printed.
  bool may_be_program() const;

 private:
  void end_line(bool is_cut = false);
  void add_line(std::string text, bool is_cut);
  void take_line(const std::string& line, bool is_cut);
  bool is_program_line(const std::string& line) const;
  bool takes_any() const { return takes_programs_only_ && !may_be_rest_; }
  bool begins_next(const std::string& line);
  void begin_program();
  void begin_program_with(const std::string& line);
  void add_to_program(std::string_view text);
  void flush_program();
  void end_program();
  std::vector<Item> taken();

  const RuleSet& rules_;
  const bool extracts_;
  bool takes_programs_only_ = false;
  bool may_be_rest_ = false, is_first_of_rest_ = false, has_rest_ = false;
  bool is_marking_ = false;
  interpreter::centurion::ProgramSplitter programs_;  ///< of the text in hand
  std::vector<Item> items_;
  std::string line_;   ///< not complete
  std::string piece_;  ///< of a program, not yet an item
  std::string head_;
  std::string name_;
  bool is_lost_ = false;  ///< text of the line in hand, or of the next
  bool is_program_ = false;
  bool is_after_percent_ = false;  ///< a line of % alone came, and nothing since
  bool is_printing_ = false;       ///< what is between two % is printed
  std::uint64_t blocks_ = 0;       ///< of the program
};

}  // namespace dripline::line
