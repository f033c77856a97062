#include "protocol/wire/character_coder.hpp"

#include <utility>

#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {
namespace {

void append(std::string_view rows, std::vector<std::byte>& line) {
  for (const char row : rows) line.push_back(static_cast<std::byte>(row));
}

/// "'x'", or the number of a character that cannot be shown.
std::string shown(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20 && byte < 0x7F) return fmt::format("'{}'", c);
  return fmt::format("0x{:02X}", static_cast<unsigned>(byte));
}

}  // namespace

Result<void> CharacterEncoder::encode(std::string_view text, std::vector<std::byte>& line) {
  const std::size_t before = line.size();
  for (const char c : text) {
    if (auto done = encode_character(c, line); !done) {
      line.resize(before);
      return done;
    }
  }
  return {};
}

Result<void> CharacterEncoder::encode_character(char c, std::vector<std::byte>& line) {
  const bool had_carriage_return = std::exchange(has_carriage_return_, c == '\r');
  if (c == '\n') {
    append(end_of_block_rows(code_, end_of_block_), line);
    ++blocks_;
    column_ = 0;
    return {};
  }
  ++column_;
  if (c == '\r' && !had_carriage_return) return {};
  const auto row = had_carriage_return ? std::nullopt : encode_row(code_, c, has_parentheses_);
  if (!row) {
    return fail(Errc::Syntax, "line {}, column {}: {} is not a character of the {} code",
                blocks_ + 1, had_carriage_return ? column_ - 1 : column_,
                shown(had_carriage_return ? '\r' : c), code_name(code_));
  }
  line.push_back(static_cast<std::byte>(*row));
  return {};
}

DecodedCharacter CharacterDecoder::decode(std::byte character) {
  const TapeRow row = decode_row(code_, static_cast<std::uint8_t>(character));
  switch (row.kind) {
    case RowKind::Text:
    case RowKind::RewindStop:
      return add(row.character);
    case RowKind::BlockEnd:
      return end_block(true);
    case RowKind::CarriageReturn:
      return end_block(false);
    case RowKind::Unassigned:
      return decode_fault(fmt::format("0x{:02X} is not a character of the {} code",
                                      static_cast<unsigned>(character), code_name(code_)));
    case RowKind::WrongParity:
      return decode_fault(fmt::format("0x{:02X} has not the parity of the {} code",
                                      static_cast<unsigned>(character), code_name(code_)));
    case RowKind::Blank:
    case RowKind::Delete:
    case RowKind::Ignored:
      break;
  }
  return {};
}

DecodedCharacter CharacterDecoder::decode_fault(std::string_view what) {
  DecodedCharacter decoded = add('?');
  decoded.error =
      Error{Errc::Corrupt, fmt::format("line {}, column {}: {}", blocks_ + 1, column_, what)};
  return decoded;
}

DecodedCharacter CharacterDecoder::add(char c) {
  line_feeds_left_ = carriage_returns_left_ = 0;
  ++column_;
  return {c, std::nullopt};
}

DecodedCharacter CharacterDecoder::end_block(bool is_line_feed) {
  unsigned& left = is_line_feed ? line_feeds_left_ : carriage_returns_left_;
  if (left > 0) {
    --left;
    return {};
  }
  line_feeds_left_ = is_line_feed || code_ == CharacterCode::Eia ? 0 : 1;
  carriage_returns_left_ = is_line_feed && code_ != CharacterCode::Eia ? 2 : 0;
  ++blocks_;
  column_ = 0;
  return {'\n', std::nullopt};
}

}  // namespace dripline::wire
