// Rows of any tape. Properties: the code's verdict is one of its rows' ends of block; text that a
// decoder gives encodes, and decodes the same again, in every code that has its characters.
#include <cstdlib>

#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/tape_code.hpp"

namespace {

using namespace dripline::wire;

std::string decode(CharacterCode code, std::span<const std::byte> rows) {
  CharacterDecoder decoder(code);
  std::string text;
  for (const auto row : rows) {
    if (const auto got = decoder.decode(row); got.text) text += *got.text;
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto rows = std::as_bytes(std::span(data + 1, size - 1));
  if (const auto verdict = detect_code(rows)) {
    const auto row = static_cast<std::uint8_t>(rows[verdict->first_block]);
    const auto kind = decode_row(verdict->code, row).kind;
    if (kind != RowKind::BlockEnd && kind != RowKind::CarriageReturn) std::abort();
    if (verdict->confidence < 0 || verdict->confidence > 1) std::abort();
  }
  const auto text = decode(static_cast<CharacterCode>(data[0] % 3), rows);
  for (const auto code : {CharacterCode::Ascii, CharacterCode::Iso, CharacterCode::Eia}) {
    CharacterEncoder encoder(code, static_cast<EndOfBlock>(data[0] / 4 % 5), true);
    std::vector<std::byte> line;
    const auto encoded = encoder.encode(text, line);
    if (!encoded && code != CharacterCode::Eia) std::abort();
    if (encoded && decode(code, line) != text) std::abort();
  }
  return 0;
}
