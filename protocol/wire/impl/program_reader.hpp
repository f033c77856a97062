#pragma once

#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/impl/control_rules.hpp"

namespace dripline::wire {

/// The characters of a plain transfer as program text. Leading blank characters and empty blocks
/// are dropped; so is a start character (or an end character before any text), with its block if
/// that holds nothing else.
class ProgramReader {
 public:
  /// `settings` and `sink` must outlive it.
  ProgramReader(const LineSettings& settings, Role role, TextSink& sink);

  void begin();
  /// After `begin`: the text may be printed lines, which have no start character.
  void expect_print() { may_print_ = true; }
  /// true: the end character, the program is complete. Errors: the reception fails.
  Result<bool> read(std::byte character);
  Result<void> read_fault(LineFault fault);
  /// The program is complete for another reason.
  void finish();

  bool has_begun() const { return place_ != Place::Before || has_mark_; }
  /// The start character has come.
  bool has_mark() const { return has_mark_; }
  bool is_framed() const { return end_character_.has_value(); }
  ControlRules& rules() { return *rules_; }
  const ControlRules& rules() const { return *rules_; }
  /// Whether this character, on an idle line, begins a text.
  bool begins(std::byte character) const;

 private:
  enum class Place : std::uint8_t { Before, AfterMark, Text };
  Result<bool> read_text(char character);
  Result<bool> read_mark(char character);
  void begin_text();
  void report_missing_start();
  Result<bool> take(char character);
  bool is_mark(char character) const {
    return character == settings_.start_character || character == end_character_;
  }

  const LineSettings& settings_;
  TextSink& sink_;
  std::unique_ptr<ControlRules> rules_;
  std::optional<char> end_character_;
  CharacterDecoder decoder_;
  Place place_ = Place::Before;
  bool has_mark_ = false, may_print_ = false;
  char mark_ = 0;
  std::size_t block_length_ = 0;
};

}  // namespace dripline::wire
