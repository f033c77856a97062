#include "protocol/wire/impl/line_character.hpp"

#include <bit>

#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {

std::optional<std::byte> to_line(CharacterCode code, char character) {
  const auto bits = static_cast<std::uint8_t>(character);
  if (bits > 0x7f) return std::nullopt;
  switch (code) {
    case CharacterCode::Ascii:
      return std::byte{bits};
    case CharacterCode::Iso:
      return static_cast<std::byte>(bits | (std::popcount(bits) % 2 == 1 ? 0x80 : 0));
    case CharacterCode::Eia:
      if (const auto row = encode_row(code, character)) return std::byte{*row};
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<char> from_line(CharacterCode code, std::byte character) {
  const auto bits = static_cast<std::uint8_t>(character);
  if (code == CharacterCode::Eia) {
    const TapeRow row = decode_row(code, bits);
    if (row.kind == RowKind::Text || row.kind == RowKind::RewindStop) return row.character;
    return std::nullopt;
  }
  if (code == CharacterCode::Iso && std::popcount(bits) % 2 == 1) return std::nullopt;
  return static_cast<char>(bits & 0x7f);
}

}  // namespace dripline::wire
