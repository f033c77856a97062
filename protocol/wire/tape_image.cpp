#include "protocol/wire/tape_image.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace dripline::wire {

namespace {

constexpr std::size_t kTapeHead = 40;

void feed_blanks(unsigned count, std::vector<std::byte>& rows) {
  rows.insert(rows.end(), count, std::byte{0});
}

Result<void> check_feed(std::string_view what, unsigned rows) {
  if (rows <= kMaxTapeFeed) return {};
  return fail(Errc::LimitExceeded, "{} {} rows, at most {}", what, rows, kMaxTapeFeed);
}

struct Glyph {
  char character;
  std::array<std::uint8_t, 5> rows;  ///< the columns of a 5 x 7 letter, track 1 at the top
};

// clang-format off
constexpr std::array kGlyphs{
    Glyph{'0', {0x3E, 0x51, 0x49, 0x45, 0x3E}}, Glyph{'1', {0x00, 0x42, 0x7F, 0x40, 0x00}},
    Glyph{'2', {0x42, 0x61, 0x51, 0x49, 0x46}}, Glyph{'3', {0x21, 0x41, 0x45, 0x4B, 0x31}},
    Glyph{'4', {0x18, 0x14, 0x12, 0x7F, 0x10}}, Glyph{'5', {0x27, 0x45, 0x45, 0x45, 0x39}},
    Glyph{'6', {0x3C, 0x4A, 0x49, 0x49, 0x30}}, Glyph{'7', {0x01, 0x71, 0x09, 0x05, 0x03}},
    Glyph{'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, Glyph{'9', {0x06, 0x49, 0x49, 0x29, 0x1E}},
    Glyph{'A', {0x7E, 0x11, 0x11, 0x11, 0x7E}}, Glyph{'B', {0x7F, 0x49, 0x49, 0x49, 0x36}},
    Glyph{'C', {0x3E, 0x41, 0x41, 0x41, 0x22}}, Glyph{'D', {0x7F, 0x41, 0x41, 0x22, 0x1C}},
    Glyph{'E', {0x7F, 0x49, 0x49, 0x49, 0x41}}, Glyph{'F', {0x7F, 0x09, 0x09, 0x09, 0x01}},
    Glyph{'G', {0x3E, 0x41, 0x49, 0x49, 0x7A}}, Glyph{'H', {0x7F, 0x08, 0x08, 0x08, 0x7F}},
    Glyph{'I', {0x00, 0x41, 0x7F, 0x41, 0x00}}, Glyph{'J', {0x20, 0x40, 0x41, 0x3F, 0x01}},
    Glyph{'K', {0x7F, 0x08, 0x14, 0x22, 0x41}}, Glyph{'L', {0x7F, 0x40, 0x40, 0x40, 0x40}},
    Glyph{'M', {0x7F, 0x02, 0x0C, 0x02, 0x7F}}, Glyph{'N', {0x7F, 0x04, 0x08, 0x10, 0x7F}},
    Glyph{'O', {0x3E, 0x41, 0x41, 0x41, 0x3E}}, Glyph{'P', {0x7F, 0x09, 0x09, 0x09, 0x06}},
    Glyph{'Q', {0x3E, 0x41, 0x51, 0x21, 0x5E}}, Glyph{'R', {0x7F, 0x09, 0x19, 0x29, 0x46}},
    Glyph{'S', {0x46, 0x49, 0x49, 0x49, 0x31}}, Glyph{'T', {0x01, 0x01, 0x7F, 0x01, 0x01}},
    Glyph{'U', {0x3F, 0x40, 0x40, 0x40, 0x3F}}, Glyph{'V', {0x1F, 0x20, 0x40, 0x20, 0x1F}},
    Glyph{'W', {0x3F, 0x40, 0x38, 0x40, 0x3F}}, Glyph{'X', {0x63, 0x14, 0x08, 0x14, 0x63}},
    Glyph{'Y', {0x07, 0x08, 0x70, 0x08, 0x07}}, Glyph{'Z', {0x61, 0x51, 0x49, 0x45, 0x43}},
    Glyph{'-', {0x08, 0x08, 0x08, 0x08, 0x08}}, Glyph{'.', {0x00, 0x60, 0x60, 0x00, 0x00}},
    Glyph{'/', {0x20, 0x10, 0x08, 0x04, 0x02}}, Glyph{' ', {0x00, 0x00, 0x00, 0x00, 0x00}},
};
// clang-format on

const Glyph* find(char c) {
  for (const auto& glyph : kGlyphs) {
    if (glyph.character == c) return &glyph;
  }
  return nullptr;
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
  if (meaning.kind == RowKind::Text && head_.size() < kTapeHead) head_ += meaning.character;
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

Result<void> punch_title(std::string_view title, std::vector<std::byte>& rows) {
  for (const char c : title) {
    const Glyph* glyph = find(c);
    if (glyph == nullptr) {
      return fail(Errc::Syntax,
                  "title '{}': only A-Z, 0-9, blank, '-', '.' and '/' can be punched as shapes",
                  title);
    }
    for (const auto row : glyph->rows) rows.push_back(static_cast<std::byte>(row));
    rows.push_back(std::byte{0});
  }
  return {};
}

}  // namespace dripline::wire
