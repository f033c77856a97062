#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// The addresses of this control and the words of one block (manual: table 1).
namespace dripline::interpreter::centurion {

/// A to Z keep their place in the alphabet; the two-letter addresses follow.
// clang-format off
enum class Address : std::uint8_t {
  A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z, AA, AB, XC, ZC
};
// clang-format on
inline constexpr std::size_t kAddressCount = 30;
std::string_view to_string(Address address);

using AddressSet = std::uint32_t;
constexpr AddressSet set_of(Address address) {
  return AddressSet{1} << static_cast<unsigned>(address);
}
template <class... Addresses>
constexpr AddressSet set_of(Address first, Addresses... rest) {
  return set_of(first) | set_of(rest...);
}

/// Values in program units, as written; X, U and XC are still diameters.
class Words {
 public:
  void clear() { present_ = 0; }
  AddressSet present() const { return present_; }
  bool has(Address address) const { return (present_ & set_of(address)) != 0; }
  bool has_any(AddressSet set) const { return (present_ & set) != 0; }
  double operator[](Address address) const { return value_[static_cast<std::size_t>(address)]; }
  /// 1-based byte of the block where the word begins.
  std::uint32_t column(Address address) const { return column_[static_cast<std::size_t>(address)]; }
  void drop(Address address) { present_ &= ~set_of(address); }
  void set(Address address, double value, std::uint32_t column) {
    present_ |= set_of(address);
    value_[static_cast<std::size_t>(address)] = value;
    column_[static_cast<std::size_t>(address)] = column;
  }

 private:
  AddressSet present_ = 0;
  std::array<double, kAddressCount> value_{};
  std::array<std::uint32_t, kAddressCount> column_{};
};

}  // namespace dripline::interpreter::centurion
