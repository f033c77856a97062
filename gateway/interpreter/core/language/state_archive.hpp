#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

/// The bytes of a snapshot. A dialect lists the members of its state once, in a template function
/// `visit(archive, value)`; run with a StateWriter it stores them, with a StateReader it reads them
/// back. Bytes are those of this machine; no padding is ever stored, so equal states give equal
/// bytes.
namespace dripline::interpreter::language {

class StateWriter {
 public:
  static constexpr bool kReads = false;
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out_.insert(out_.end(), bytes, bytes + sizeof value);
  }
  /// The number of elements that follow; false when they cannot be read.
  bool size(std::size_t& count, std::size_t) {
    auto stored = static_cast<std::uint32_t>(count);
    (*this)(stored);
    return true;
  }
  /// Written bytes are never damaged; for code that serves both directions.
  void damage() {}
  bool is_damaged() const { return false; }
  std::vector<std::byte> take() { return std::move(out_); }

 private:
  std::vector<std::byte> out_;
};

/// Never reads past the bytes and never gives a bool that is neither true nor false; the dialect
/// checks the other values when all are read.
class StateReader {
 public:
  static constexpr bool kReads = true;
  explicit StateReader(const std::vector<std::byte>& bytes) : in_(bytes) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    if (in_.size() - at_ < sizeof value) {
      is_damaged_ = true;
      return;
    }
    if constexpr (std::is_same_v<T, bool>) {
      is_damaged_ |= static_cast<unsigned char>(in_[at_]) > 1;
      value = static_cast<unsigned char>(in_[at_]) != 0;
    } else {
      std::memcpy(&value, in_.data() + at_, sizeof value);
    }
    at_ += sizeof value;
  }
  /// More than `most` elements are damage.
  bool size(std::size_t& count, std::size_t most) {
    std::uint32_t stored = 0;
    (*this)(stored);
    is_damaged_ |= stored > most;
    count = is_damaged_ ? 0 : stored;
    return !is_damaged_;
  }
  void damage() { is_damaged_ = true; }
  bool is_damaged() const { return is_damaged_; }
  /// Everything was read, and it was in order.
  bool is_complete() const { return !is_damaged_ && at_ == in_.size(); }

 private:
  const std::vector<std::byte>& in_;
  std::size_t at_ = 0;
  bool is_damaged_ = false;
};

template <class Archive, class... Values>
void visit_all(Archive& archive, Values&... values) {
  (archive(values), ...);
}

template <class Archive>
void visit_text(Archive& archive, std::string& text, std::size_t most) {
  std::size_t length = text.size();
  if (!archive.size(length, most)) return;
  text.resize(length);
  for (char& c : text) archive(c);
}

}  // namespace dripline::interpreter::language
