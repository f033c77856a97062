#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// The words of a block: letters, formats, and what one block has (manual: blocks and words).
namespace dripline::interpreter::tektronix1704 {

enum class Address : std::uint8_t { N, G, X, Y, Z, I, J, K, R, F, S, T, M };
inline constexpr std::size_t kAddressCount = 13;
inline constexpr std::string_view kLetters = "NGXYZIJKRFSTM";

struct WordFormat {
  std::uint8_t digits;  ///< significant ones
  bool is_signed;
};
inline constexpr WordFormat kSequence{3, false}, kCode{2, false}, kCoordinate{6, true},
    kFeed{4, false};
inline constexpr std::array<WordFormat, kAddressCount> kFormats{
    kSequence,   kCode,       kCoordinate, kCoordinate, kCoordinate, kCoordinate, kCoordinate,
    kCoordinate, kCoordinate, kFeed,       kCode,       kCode,       kCode};

constexpr std::uint16_t bit(Address address) {
  return static_cast<std::uint16_t>(1u << static_cast<unsigned>(address));
}
inline constexpr std::uint16_t kEndWords = bit(Address::X) | bit(Address::Y) | bit(Address::Z);
inline constexpr std::uint16_t kCenterWords = bit(Address::I) | bit(Address::J) | bit(Address::K);

/// Values are counts: the digits as an integer, with their sign.
class Words {
 public:
  void clear() { present_ = 0; }
  void set(Address address, std::int32_t value) {
    value_[static_cast<std::size_t>(address)] = value;
    present_ = static_cast<std::uint16_t>(present_ | bit(address));
  }
  bool has(Address address) const { return (present_ & bit(address)) != 0; }
  bool has_any(std::uint16_t set) const { return (present_ & set) != 0; }
  std::int32_t operator[](Address address) const {
    return value_[static_cast<std::size_t>(address)];
  }
  std::uint16_t present() const { return present_; }
  bool empty() const { return present_ == 0; }

  template <class Archive>
  friend void visit(Archive& archive, Words& words) {
    archive(words.value_, words.present_);
  }

 private:
  std::array<std::int32_t, kAddressCount> value_{};
  std::uint16_t present_ = 0;
};

}  // namespace dripline::interpreter::tektronix1704
