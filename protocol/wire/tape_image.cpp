#include "protocol/wire/tape_image.hpp"

#include <algorithm>

#include "protocol/wire/tape_title.hpp"

namespace dripline::wire {
namespace {

constexpr std::size_t kShownHead = 40;

void feed_blanks(unsigned count, std::vector<std::byte>& rows) {
  rows.insert(rows.end(), count, std::byte{0});
}

Result<void> check_feed(std::string_view what, unsigned rows) {
  if (rows <= kMaxTapeFeed) return {};
  return fail(Errc::LimitExceeded, "{} {} rows, at most {}", what, rows, kMaxTapeFeed);
}

}  // namespace

TapePunch::TapePunch(TapeForm form)
    : form_(std::move(form)), encoder_(form_.code, form_.end_of_block, form_.has_parentheses) {}

Result<void> TapePunch::begin(std::vector<std::byte>& rows) {
  if (auto good = check_feed("leader", form_.leader); !good) return good;
  if (auto good = check_feed("trailer", form_.trailer); !good) return good;
  if (form_.title.size() > kMaxTapeTitle) {
    return fail(Errc::LimitExceeded, "title of {} characters, at most {}", form_.title.size(),
                kMaxTapeTitle);
  }
  feed_blanks(form_.leader, rows);
  if (form_.title.empty()) return {};
  if (auto punched = punch_title(form_.title, rows); !punched) return punched;
  feed_blanks(kRowsPerInch, rows);
  return {};
}

Result<void> TapePunch::punch(std::string_view text, std::vector<std::byte>& rows) {
  if (text.empty()) return {};
  if (!has_begun_text_) {
    has_begun_text_ = true;
    if (form_.has_rewind_stop && text.front() != '%') {
      rows.push_back(static_cast<std::byte>(*encode_row(form_.code, '%')));
      for (const char row : end_of_block_rows(form_.code, form_.end_of_block)) {
        rows.push_back(static_cast<std::byte>(row));
      }
    }
  }
  is_line_begun_ = text.back() != '\n';
  return encoder_.encode(text, rows);
}

void TapePunch::finish(std::vector<std::byte>& rows) {
  if (is_line_begun_) (void)encoder_.encode("\n", rows);  // every code has an end of block
  feed_blanks(form_.trailer, rows);
}

TapeReader::TapeReader(TapeReading reading)
    : reading_(reading), decoder_(reading.code), is_hunting_(reading.skips_head) {}

Result<void> TapeReader::read(std::span<const std::byte> rows, std::string& text) {
  for (const auto row : rows) {
    if (auto done = read_row(static_cast<std::uint8_t>(row), text); !done) return done;
  }
  return {};
}

Result<void> TapeReader::read_row(std::uint8_t row, std::string& text) {
  ++summary_.rows;
  const TapeRow meaning = decode_row(reading_.code, row);
  const bool is_blank = meaning.kind == RowKind::Blank;
  summary_.trailer = is_blank ? summary_.trailer + 1 : 0;
  if (is_blank && summary_.trailer == summary_.rows) summary_.leader = summary_.rows;
  if (meaning.kind == RowKind::Delete) ++summary_.deletes;
  if (!is_hunting_) return read_data(row, meaning, text);
  hunt(row, meaning, text);
  return {};
}

void TapeReader::hunt(std::uint8_t row, TapeRow meaning, std::string& text) {
  if (meaning.kind == RowKind::Blank || meaning.kind == RowKind::Delete) return;
  const bool is_end = meaning.kind == RowKind::BlockEnd || meaning.kind == RowKind::CarriageReturn;
  if (!is_end) {
    if (!has_seen_block_end_) note_head(meaning);
    is_stop_last_ = meaning.kind == RowKind::RewindStop;
    return;
  }
  (void)decoder_.decode(static_cast<std::byte>(row));  // so that it knows the companion characters
  is_hunting_ = false;
  if (has_seen_block_end_) return;
  has_seen_block_end_ = true;
  summary_.has_rewind_stop = is_stop_last_;
  if (is_stop_last_) {
    --summary_.skipped;
    text += "%\n";
    ++summary_.blocks;
  } else {
    decoder_.count_from_here();
    if (is_head_text_) summary_.lost_block = head_;
  }
}

/// Skipped rows that hold only words of a block are likely to be a lost first block.
void TapeReader::note_head(TapeRow meaning) {
  ++summary_.skipped;
  if (meaning.kind == RowKind::WrongParity || meaning.kind == RowKind::Unassigned) {
    is_head_text_ = false;
  }
  if (meaning.kind == RowKind::Text && head_.size() < kShownHead) head_ += meaning.character;
}

Result<void> TapeReader::read_data(std::uint8_t row, TapeRow meaning, std::string& text) {
  if (meaning.kind == RowKind::RewindStop && reading_.skips_head) {
    if (is_line_begun_) text += '\n';
    summary_.blocks += is_line_begun_ ? 2 : 1;
    text += "%\n";
    is_line_begun_ = false;
    is_hunting_ = has_seen_block_end_ = true;
    return {};
  }
  const bool is_wrong_blank = reading_.blank_is_wrong_in_block && is_line_begun_ &&
                              meaning.kind == RowKind::Blank && reading_.code == CharacterCode::Eia;
  const DecodedCharacter decoded = is_wrong_blank
                                       ? decoder_.decode_fault("blank tape inside a block")
                                       : decoder_.decode(static_cast<std::byte>(row));
  if (decoded.error) {
    Error error{Errc::Corrupt, fmt::format("row {}, {}", summary_.rows, decoded.error->what)};
    if (!reading_.replaces_wrong_rows) return fail(std::move(error));
    if (summary_.wrong++ == 0) summary_.first_wrong = std::move(error);
  }
  if (!decoded.text) return {};
  text += *decoded.text;
  is_line_begun_ = *decoded.text != '\n';
  if (!is_line_begun_) ++summary_.blocks;
  return {};
}

Result<void> TapeReader::finish(std::string& text) {
  if (reading_.skips_head && !has_seen_block_end_) {
    return fail(Errc::Corrupt, "{} rows without an end of block of the {} code", summary_.rows,
                code_name(reading_.code));
  }
  if (!is_line_begun_) return {};
  is_line_begun_ = false;
  text += '\n';
  ++summary_.blocks;
  return {};
}

}  // namespace dripline::wire
