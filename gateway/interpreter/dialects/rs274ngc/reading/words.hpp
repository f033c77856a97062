#pragma once

#include <array>
#include <cstdint>

/// The words of one line: letter and value, each letter once.

namespace dripline::interpreter::rs274ngc {

/// A to Z keep their place in the alphabet; `@` and `^`, the polar words, follow.
using Address = std::uint8_t;
constexpr Address address_of(char capital) {
  return capital == '@'   ? Address{26}
         : capital == '^' ? Address{27}
                          : static_cast<Address>(capital - 'A');
}
constexpr char letter_of(Address address) {
  return address == 26 ? '@' : address == 27 ? '^' : static_cast<char>('A' + address);
}
inline constexpr std::size_t kAddressCount = 28;

using AddressSet = std::uint32_t;
/// set_of("XYZ")
constexpr AddressSet set_of(const char* capitals) {
  AddressSet set = 0;
  for (; *capitals != '\0'; ++capitals) set |= AddressSet{1} << address_of(*capitals);
  return set;
}
constexpr AddressSet set_of(char capital) {
  return AddressSet{1} << address_of(capital);
}

inline constexpr AddressSet kAxisWords = set_of("XYZABCUVW");
inline constexpr AddressSet kPolarWords = set_of("@^");

class Words {
 public:
  void clear() { present_ = 0; }
  AddressSet present() const { return present_; }
  bool has(char capital) const { return (present_ & set_of(capital)) != 0; }
  bool has_any(AddressSet set) const { return (present_ & set) != 0; }
  double operator[](char capital) const { return value_[address_of(capital)]; }
  /// The word's value, or `fallback` where the line has none.
  double value_or(char capital, double fallback) const {
    return has(capital) ? (*this)[capital] : fallback;
  }
  /// 1-based byte of the line where the word begins.
  std::uint32_t column(char capital) const { return column_[address_of(capital)]; }
  void set(Address address, double value, std::uint32_t column) {
    present_ |= AddressSet{1} << address;
    value_[address] = value;
    column_[address] = column;
  }
  void set(char capital, double value) { set(address_of(capital), value, 0); }
  void remove(AddressSet set) { present_ &= ~set; }

 private:
  AddressSet present_ = 0;
  std::array<double, kAddressCount> value_{};
  std::array<std::uint32_t, kAddressCount> column_{};
};

// Blanks vanish everywhere outside comments, case does not matter (NIST 3.3). All texts here end
// in a byte that can be read and ends a line.

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
inline bool is_end_of_line(char c) {
  return c == '\n' || c == '\r';
}
inline bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') <= 9;
}
/// Capital letter of a letter; other characters stay or become something that is no letter.
inline char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - ('a' - 'A')) : c;
}
inline bool is_letter(char c) {
  return static_cast<unsigned char>(upper(c) - 'A') < 26;
}
inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) [[unlikely]]++ at;
  return at;
}

}  // namespace dripline::interpreter::rs274ngc
