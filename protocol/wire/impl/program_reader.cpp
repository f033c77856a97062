#include "protocol/wire/impl/program_reader.hpp"

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/line_limits.hpp"

namespace dripline::wire {

ProgramReader::ProgramReader(const LineSettings& settings, Role role, TextSink& sink)
    : settings_(settings),
      sink_(sink),
      rules_(make_rules(settings, role)),
      end_character_(settings.end_character),
      decoder_(settings.code) {
  const bool is_prototrak =
      role == Role::Control && settings.control.kind == ControlKind::ProtoTrak;
  if (is_prototrak && !end_character_) end_character_ = '%';
}

void ProgramReader::begin() {
  decoder_ = CharacterDecoder(settings_.code);
  place_ = Place::Before;
  has_mark_ = may_print_ = false;
  block_length_ = 0;
  rules_->begin();
}

bool ProgramReader::begins(std::byte character) const {
  const auto plain = from_line(settings_.code, character);
  if (plain && !is_printable(*plain)) return is_mark(*plain) && *plain == settings_.start_character;
  const DecodedCharacter decoded = CharacterDecoder(settings_.code).decode(character);
  return decoded.text && *decoded.text != '\n' && *decoded.text != ' ' && !decoded.error;
}

Result<bool> ProgramReader::read(std::byte character) {
  const auto plain = from_line(settings_.code, character);
  if (plain && !is_printable(*plain)) {
    if (rules_->ends_at(*plain)) {
      sink_.report(Error{Errc::Syntax, fmt::format("the program ends with 0x{:02x}",
                                                   static_cast<unsigned>(*plain))});
      finish();
      return true;
    }
    if (is_mark(*plain)) return read_mark(*plain);
  }
  const DecodedCharacter decoded = decoder_.decode(character);
  if (decoded.error) {
    if (const auto fatal = rules_->fault(LineFault::Parity)) return fail(*fatal);
    sink_.report(*decoded.error);
  }
  if (!decoded.text) return false;
  if (is_mark(*decoded.text)) return read_mark(*decoded.text);
  return read_text(*decoded.text);
}

Result<void> ProgramReader::read_fault(LineFault fault) {
  if (const auto fatal = rules_->fault(fault)) return fail(*fatal);
  const DecodedCharacter decoded = decoder_.decode_fault(fault_text(fault));
  sink_.report(*decoded.error);
  const auto read = read_text('?');
  if (!read) return fail(read.error());
  return {};
}

/// The start or the end character.
Result<bool> ProgramReader::read_mark(char character) {
  if (place_ == Place::AfterMark && character == mark_ && is_printable(character)) {
    sink_.report(Error{Errc::Corrupt, fmt::format("'{}' came twice", character)});
    return false;
  }
  const bool is_at_start = place_ == Place::Before && !has_mark_;
  if (is_at_start && (is_printable(character) || character != end_character_)) {
    has_mark_ = true;
    mark_ = character;
    if (is_printable(character)) place_ = Place::AfterMark;
    return false;
  }
  if (character != end_character_) {
    if (!is_printable(character)) {
      sink_.report(Error{Errc::Corrupt, "the start character came again inside a program"});
      return false;
    }
    return take(character);  // an ordinary character by now
  }
  if (may_print_) report_missing_start();  // its end character shows that it is a program
  finish();
  return true;
}

Result<bool> ProgramReader::read_text(char character) {
  if (place_ == Place::AfterMark) {
    place_ = Place::Before;
    if (character == '\n') return false;
    begin_text();
    if (const auto taken = take(mark_); !taken) return taken;
    return take(character);
  }
  if (place_ == Place::Before) {
    if (character == '\n') return false;
    begin_text();
  }
  return take(character);
}

void ProgramReader::begin_text() {
  place_ = Place::Text;
  if (!may_print_) report_missing_start();
}

void ProgramReader::report_missing_start() {
  if (!settings_.start_character || has_mark_) return;
  sink_.report(Error{Errc::Corrupt, "the start character before the program is missing"});
}

Result<bool> ProgramReader::take(char character) {
  block_length_ = character == '\n' ? 0 : block_length_ + 1;
  if (block_length_ == kLongestBlock + 1) {
    sink_.report({Errc::Corrupt, fmt::format("line {} is longer than {} characters: ends of block "
                                             "are missing",
                                             decoder_.blocks() + 1, kLongestBlock)});
  }
  if (const auto taken = rules_->take(character, sink_); !taken) return fail(taken.error());
  return false;
}

void ProgramReader::finish() {
  rules_->finish(sink_);
}

}  // namespace dripline::wire
