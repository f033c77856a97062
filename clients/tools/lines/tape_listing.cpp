#include "clients/tools/lines/tape_listing.hpp"

#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace dripline::wire {
namespace {

/// Tracks 8 to 4, the sprocket hole, tracks 3 to 1.
std::string holes(std::uint8_t row) {
  std::string picture;
  for (unsigned track = 8; track > 0; --track) {
    picture += (row >> (track - 1) & 1U) != 0 ? 'o' : '.';
    if (track == 4) picture += ':';
  }
  return picture;
}

std::string_view meaning(RowKind kind) {
  constexpr std::string_view kMeanings[] = {
      "",       "end of block", "carriage return",           "rewind stop", "blank",
      "delete", "ignored",      "no character of this code", "wrong parity"};
  return kMeanings[static_cast<std::size_t>(kind)];
}

std::string shown(TapeRow row) {
  if (row.kind != RowKind::Text && row.kind != RowKind::RewindStop) return "";
  if (row.character == '\t') return "TAB";
  return row.character == ' ' ? "SP" : std::string(1, row.character);
}

}  // namespace

void TapeListing::list(std::span<const std::byte> rows, std::string& text) {
  for (const auto byte : rows) {
    ++row_;
    const auto row = static_cast<std::uint8_t>(byte);
    if (row == 0) {
      if (blanks_++ == 0) first_blank_ = row_;
      continue;
    }
    end_blanks(text);
    const TapeRow read = decode_row(code_, row);
    const std::size_t begun = text.size();
    text += fmt::format("{:>10}  {}  {:02X}  {:<3}  {}", row_, holes(row),
                        static_cast<unsigned>(row), shown(read), meaning(read.kind));
    while (text.size() > begun && text.back() == ' ') text.pop_back();
    text += '\n';
  }
}

void TapeListing::end_blanks(std::string& text) {
  const std::uint64_t count = std::exchange(blanks_, 0);
  if (count == 0) return;
  text += fmt::format("{:>10}  {}  00       blank, {} rows\n", first_blank_, holes(0), count);
}

}  // namespace dripline::wire
