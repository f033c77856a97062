#include "protocol/wire/impl/program_writer.hpp"

#include "protocol/wire/impl/discipline_base.hpp"

namespace dripline::wire {
namespace {

bool is_blank(char character) {
  return character == '\n' || character == '\r' || character == ' ' || character == '\t';
}

}  // namespace

ProgramWriter::ProgramWriter(const LineSettings& settings)
    : settings_(settings),
      checked_(settings.code, settings.end_of_block),
      encoder_(settings.code, settings.end_of_block) {}

void ProgramWriter::begin() {
  checked_ = encoder_ = CharacterEncoder(settings_.code, settings_.end_of_block);
  checked_place_ = place_ = {};
  stage_ = Stage::Text;
  blanks_ = settings_.leader;
  pending_.clear();
  next_ = 0;
  last_ = '\n';
  pending_ends_block_ = ends_block_ = false;
}

/// Whether `character` is the text's own end character: it ends the program everywhere except at
/// the very beginning, where it marks the beginning.
bool ProgramWriter::Place::ends(char character, const LineSettings& settings) {
  const bool was_first = std::exchange(is_first, false);
  if (character == '\n') ++line;
  if (was_first || is_ended || character != settings.end_character) return false;
  is_ended = true;
  return true;
}

Result<void> ProgramWriter::check(std::string_view text) {
  std::vector<std::byte> scratch;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t line = checked_place_.line;
    const bool was_ended = checked_place_.is_ended;
    const bool ends = checked_place_.ends(text[i], settings_);
    if (was_ended && !is_blank(text[i])) {
      return fail(Errc::Syntax, "line {}: text after '{}', which ends a program on this line", line,
                  *settings_.end_character);
    }
    const bool is_control = !is_printable(text[i]) && !is_blank(text[i]);
    if (was_ended || (ends && is_control)) continue;
    if (const auto encoded = checked_.encode(text.substr(i, 1), scratch); !encoded) {
      return fail(encoded.error());
    }
    scratch.clear();
  }
  return {};
}

void ProgramWriter::put_mark(char mark) {
  if (const auto row = to_line(settings_.code, mark)) pending_.push_back(*row);
}

void ProgramWriter::put_end_of_block() {
  (void)encoder_.encode("\n", pending_);
  pending_ends_block_ = true;
}

void ProgramWriter::put_text(char character) {
  pending_.clear();
  next_ = 0;
  pending_ends_block_ = false;
  if (place_.is_first && settings_.start_character && character != *settings_.start_character) {
    put_mark(*settings_.start_character);
    if (is_printable(*settings_.start_character)) put_end_of_block();
  }
  const bool was_ended = place_.is_ended;
  const bool ends = place_.ends(character, settings_);
  if (was_ended) return;
  if (ends) {
    put_mark(character);
  } else {
    (void)encoder_.encode({&character, 1}, pending_);  // check() has checked it
  }
  pending_ends_block_ = character == '\n';
  last_ = character;
}

void ProgramWriter::end_text() {
  pending_.clear();
  next_ = 0;
  if (place_.is_first && settings_.start_character) put_mark(*settings_.start_character);
  if (!place_.is_ended && settings_.end_character) {
    const bool is_open = last_ != '\n' || (place_.is_first && settings_.start_character);
    if (is_printable(*settings_.end_character) && is_open) put_end_of_block();
    put_mark(*settings_.end_character);
  }
  pending_ends_block_ = false;
  stage_ = Stage::End;
  blanks_ = settings_.trailer;
}

std::byte ProgramWriter::next() {
  ends_block_ = false;
  const bool is_leader = stage_ == Stage::Text && blanks_ > 0;
  if (is_leader || next_ == pending_.size()) {
    --blanks_;
    return std::byte{0};
  }
  const std::byte character = pending_[next_++];
  ends_block_ = pending_ends_block_ && next_ == pending_.size();
  return character;
}

}  // namespace dripline::wire
