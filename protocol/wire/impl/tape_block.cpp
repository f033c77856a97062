#include "protocol/wire/impl/tape_block.hpp"

#include <charconv>

namespace dripline::wire {
namespace {

/// Calls `take(number)` for each word with this address until it returns true.
template <class Take>
void for_each_word(std::string_view block, char address, Take take) {
  bool is_comment = false;
  for (std::size_t at = 0; at < block.size(); ++at) {
    if (block[at] == '(') is_comment = true;
    if (block[at] == ')') is_comment = false;
    if (is_comment || block[at] != address) continue;
    std::uint64_t number = 0;
    const char* first = block.data() + at + 1;
    const auto [end, error] = std::from_chars(first, block.data() + block.size(), number);
    if (error == std::errc{} && end != first && take(number)) return;
  }
}

}  // namespace

std::optional<std::uint64_t> word_value(std::string_view block, char address) {
  std::optional<std::uint64_t> value;
  for_each_word(block, address, [&](std::uint64_t number) {
    value = number;
    return true;
  });
  return value;
}

TapeEnd tape_end(std::string_view block) {
  TapeEnd end = TapeEnd::None;
  for_each_word(block, 'M', [&](std::uint64_t number) {
    if (number == 2) end = TapeEnd::Stop;
    if (number == 30) end = TapeEnd::Rewind;
    return number == 30;
  });
  return end;
}

}  // namespace dripline::wire
