#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "gateway/interpreter/core/event.hpp"

/// The addresses of this control and the words of one block.
namespace dripline::interpreter::fanuc {

// clang-format off
enum class Address : std::uint8_t {
  A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z
};
// clang-format on
inline constexpr std::size_t kAddressCount = 26;
constexpr char letter(Address address) {
  return static_cast<char>('A' + static_cast<int>(address));
}
constexpr Address address_of(char capital) {
  return static_cast<Address>(capital - 'A');
}

using AddressSet = std::uint32_t;
constexpr AddressSet set_of(Address address) {
  return AddressSet{1} << static_cast<unsigned>(address);
}
template <class... Addresses>
constexpr AddressSet set_of(Address first, Addresses... rest) {
  return set_of(first) | set_of(rest...);
}

using enum Address;
inline constexpr AddressSet kLinearWords = set_of(X, Y, Z, U, V, W);
inline constexpr AddressSet kRotaryWords = set_of(A, B, C);
inline constexpr AddressSet kAxisWords = kLinearWords | kRotaryWords;
inline constexpr AddressSet kCenterWords = set_of(I, J, K);
constexpr AddressSet set_of_axis(Axis axis) {
  constexpr std::array<Address, kAxisCount> kLetters{X, Y, Z, A, B, C, U, V, W};
  return set_of(kLetters[static_cast<std::size_t>(axis)]);
}

/// How a word's number was written: what it means depends on it.
enum class WordForm : std::uint8_t {
  Whole,     ///< no decimal point
  Point,     ///< with a decimal point
  Computed,  ///< from variables
};

struct Word {
  double value = 0;
  std::uint16_t column = 0;   ///< 1-based byte of the block
  std::uint8_t decimals = 0;  ///< digits written after the point
  WordForm form = WordForm::Whole;
  bool is_negative = false;  ///< a minus was written, even before zero
};

/// Values as written. The last word of an address counts.
class Words {
 public:
  void clear() { present_ = 0; }
  AddressSet present() const { return present_; }
  bool has(Address address) const { return (present_ & set_of(address)) != 0; }
  bool has_any(AddressSet set) const { return (present_ & set) != 0; }
  const Word& operator[](Address address) const { return word_[static_cast<std::size_t>(address)]; }
  void set(Address address, const Word& word) {
    present_ |= set_of(address);
    word_[static_cast<std::size_t>(address)] = word;
  }
  /// 0 when there is no such word.
  std::uint32_t column(Address address) const { return has(address) ? (*this)[address].column : 0; }
  /// Of the first word written that is in `set`; 0 when there is none.
  std::uint32_t first_column(AddressSet set) const {
    std::uint32_t first = 0;
    for (AddressSet left = present_ & set; left != 0; left &= left - 1) {
      const std::uint32_t at = word_[static_cast<std::size_t>(std::countr_zero(left))].column;
      if (first == 0 || at < first) first = at;
    }
    return first;
  }

 private:
  AddressSet present_ = 0;
  std::array<Word, kAddressCount> word_{};
};

}  // namespace dripline::interpreter::fanuc
