#include "gateway/interpreter/dialects/centurion/reading/words.hpp"

namespace dripline::interpreter::centurion {

std::string_view to_string(Address address) {
  static constexpr std::array<std::string_view, kAddressCount> kNames{
      "A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L",  "M",  "N",  "O",
      "P", "Q", "R", "S", "T", "U", "V", "W", "X", "Y", "Z", "AA", "AB", "XC", "ZC"};
  return kNames[static_cast<std::size_t>(address)];
}

}  // namespace dripline::interpreter::centurion
