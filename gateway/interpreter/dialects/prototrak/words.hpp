#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

/// The words of a block (manual: blocks and words): one- and two-letter addresses, numbers with
/// implied decimals, tags that override absolute or incremental for one word.
namespace dripline::interpreter::prototrak {

// clang-format off
enum class Address : std::uint8_t {
  XB, YB, XE, YE, XC, YC, XD, YD, XO, YO, HL, PN, CR, TC, FE, FC, DR, LE, RE,
  X, Y, Z, I, J, K, A, R, F, T, D, N, G, H, M, S
};
// clang-format on
inline constexpr std::size_t kAddressCount = 35;
/// In the order of the enum; two-letter ones first, so that the longest match is found first.
inline constexpr std::array<std::string_view, kAddressCount> kAddressNames{
    "XB", "YB", "XE", "YE", "XC", "YC", "XD", "YD", "XO", "YO", "HL", "PN",
    "CR", "TC", "FE", "FC", "DR", "LE", "RE", "X",  "Y",  "Z",  "I",  "J",
    "K",  "A",  "R",  "F",  "T",  "D",  "N",  "G",  "H",  "M",  "S"};
constexpr std::string_view name_of(Address address) {
  return kAddressNames[static_cast<std::size_t>(address)];
}

enum class Tag : std::uint8_t { None, Absolute, Incremental };

/// A number as it was written.
struct WrittenNumber {
  double digits = 0;  ///< all of them as one whole number
  std::uint8_t decimals = 0;
  bool has_point = false, has_digits = false, is_negative = false;
  /// With a point as written; without, the last `implied` digits are decimals.
  double value(int implied) const;
};

struct Word {
  Address address{};
  WrittenNumber number;
  Tag tag = Tag::None;
  std::uint32_t column = 0;  ///< of the block, from 0
};

enum class WordFault : std::uint8_t { None, Character, NoNumber, NotAWord };

struct ReadWords {
  std::vector<Word> words;
  WordFault fault = WordFault::None;
  std::uint32_t column = 0;  ///< of the fault
};

/// The words of a block without its comments. `skips_unknown`: tokens that are no words are left
/// out and counted in `skipped` (before the first event).
ReadWords read_words(std::string_view block, bool skips_unknown, int& skipped);

}  // namespace dripline::interpreter::prototrak
