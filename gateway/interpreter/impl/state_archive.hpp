#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

/// How a dialect's state becomes the bytes of a snapshot and back: one list of members serves both
/// ways, `visit(archive, state)`. Bytes that do not read back leave the reader damaged, never a
/// state out of bounds; values that index tables are still the dialect's to check.
namespace dripline::interpreter {

class StateWriter {
 public:
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), bytes, bytes + sizeof value);
  }
  /// The length of a list that never has more than `most` elements.
  bool size(std::size_t& count, std::size_t) {
    auto stored = static_cast<std::uint32_t>(count);
    (*this)(stored);
    return true;
  }
  std::vector<std::byte> out;
};

class StateReader {
 public:
  explicit StateReader(const std::vector<std::byte>& bytes) : in(bytes) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    if (in.size() - at < sizeof value) {
      is_damaged = true;
      return;
    }
    if constexpr (std::is_same_v<T, bool>) {
      is_damaged |= static_cast<unsigned char>(in[at]) > 1;
      value = static_cast<unsigned char>(in[at]) != 0;
    } else {
      std::memcpy(&value, in.data() + at, sizeof value);
    }
    at += sizeof value;
  }
  /// False, and `count` 0, when the bytes say more than `most`.
  bool size(std::size_t& count, std::size_t most) {
    std::uint32_t stored = 0;
    (*this)(stored);
    is_damaged |= stored > most;
    count = is_damaged ? 0 : stored;
    return !is_damaged;
  }
  const std::vector<std::byte>& in;
  std::size_t at = 0;
  bool is_damaged = false;
};

/// Every value in turn, for members that are plain values.
template <class Archive, class... Values>
void visit_values(Archive& archive, Values&... values) {
  (archive(values), ...);
}

}  // namespace dripline::interpreter
