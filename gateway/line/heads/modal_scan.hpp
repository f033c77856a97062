#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/line/heads/modal_codes.hpp"
#include "gateway/line/heads/scan_block.hpp"

namespace dripline::line {

/// Something that the text before a run's beginning put in force, and that the rest relies on.
struct ModalWord {
  std::string words;       ///< "G21", "T2 M6", "G54.1 P3"; as in a block of its own
  std::uint64_t line = 0;  ///< in the program
  /// Words that can be sent again by themselves. Others depend on where the machine was (G41, G92,
  /// a cycle's data) or on what was computed (a call, a variable).
  bool can_be_sent = true;
};

/// Finds what a run that begins in the middle of a program misses. Looks at words, not at what an
/// interpreter makes of them, so that it works for text of every control and of any size: calls,
/// jumps and variables before the beginning are named as what they are. Nothing is left out that is
/// not programmed again before the rest needs it: F and the spindle by the first feed move, all
/// others by the first block with axis words. Bounded memory; pure; one thread.
class ModalScan {
 public:
  /// `control`: the machine's dialect; its codes are read by that control's rules. Empty: as the
  /// G codes of most controls are.
  explicit ModalScan(std::string_view control);

  /// A block before the beginning, without its line end.
  void skip(std::string_view block);
  /// A block of the rest. False: everything is decided, no more blocks are needed.
  bool look(std::string_view block);
  /// The rest is over: what nothing needed is not relied on.
  void end() { in_force_.clear(); }
  /// In order of their lines.
  std::vector<ModalWord> relied_on() const;

 private:
  using Word = ScannedWord;
  using Block = ScannedBlock;

  std::optional<ModalCode> code_of(const Word& word, const Block& block) const;
  bool is_known_one_shot(int code) const;
  bool can_be_sent(const ModalCode& row, const Block& block) const;
  void append(ModalGroup group, std::string words);
  void set(ModalGroup group, std::string words, bool can_be_sent = true);
  void skip_word(const Word& word, const Block& block, std::string_view text);
  void skip_function(const Word& word, const Block& block);
  void skip_tool(const Block& block);
  void skip_length(const Block& block);
  void skip_event(std::string_view text, const Block& block);
  void skip_plain_language(std::string_view text);
  void name_unknown(std::string_view text);
  void drop(ModalGroup group) { in_force_.erase(group); }
  void look_word(const Word& word, const Block& block);
  void look_function(int code);
  bool look_event(const Block& block);
  bool is_feed_move(const Block& block) const;
  void decide(bool is_feed_move);

  const interpreter::TextForm text_;
  const bool is_fanuc_, is_lathe_, is_rs274ngc_, is_tektronix_;
  std::uint64_t line_ = 0;
  std::uint64_t looked_ = 0;
  bool is_moving_ = false;  ///< G0 to G3: the last motion code of all is not G0
  bool is_axis_decided_ = false;
  bool has_events_ = false;
  std::map<ModalGroup, ModalWord> in_force_;    ///< of the skipped part, not yet programmed again
  std::map<ModalGroup, std::size_t> appended_;  ///< blocks that a group's words consist of
  std::vector<ModalWord> relied_, unknown_;
};

/// "G21 (line 2), T2 M6 (line 4)".
std::string words_text(const std::vector<ModalWord>& words);
/// The blocks that put `words` in force again, one for each line they stood in; LF after each.
std::string head_text(const std::vector<ModalWord>& words);

}  // namespace dripline::line
