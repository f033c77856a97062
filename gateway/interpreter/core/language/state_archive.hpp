#pragma once

#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

/// The bytes of a snapshot: a StateWriter stores values, a StateReader reads them back. Numbers,
/// enumerators, arrays, lists, optionals, variants and plain structs of these need nothing more: a
/// struct is stored member by member, so that a new member is part of the snapshot at once. A type
/// with private members, or with more than 14, has a function `visit(archive, value)` in its
/// namespace, which lists what is stored, for writing and for reading. Bytes are those of this
/// machine; no padding is ever stored, so equal states give equal bytes.
namespace dripline::interpreter::language {

/// An enumerator below 0 or after the last one is damage. Of enumerations that are not named here
/// or in the snapshots of their own folder, the dialect checks the values.
template <class Enum>
inline constexpr Enum kLast = static_cast<Enum>(0xFF);
template <>
inline constexpr Axis kLast<Axis> = Axis::W;
template <>
inline constexpr Units kLast<Units> = Units::Millimeter;
template <>
inline constexpr Plane kLast<Plane> = Plane::YZ;
template <>
inline constexpr Turn kLast<Turn> = Turn::Counterclockwise;
template <>
inline constexpr SpindleState kLast<SpindleState> = SpindleState::Oriented;
template <>
inline constexpr StopKind kLast<StopKind> = StopKind::Operator;
template <>
inline constexpr OutputDevice kLast<OutputDevice> = OutputDevice::Printer;
template <>
inline constexpr FeedHoldInhibit kLast<FeedHoldInhibit> = FeedHoldInhibit::LaterToo;
template <>
inline constexpr Feed::Per kLast<Feed::Per> = Feed::Per::Move;

template <class Archive, class Value>
void visit_value(Archive& archive, Value& value);

class StateWriter {
 public:
  static constexpr bool kReads = false;

  template <class... Values>
  void operator()(Values&... values) {
    (visit_value(*this, values), ...);
  }
  template <class Number>
  void number(Number& value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out_.insert(out_.end(), bytes, bytes + sizeof value);
  }
  /// The number of elements that follow; false when they cannot be read.
  bool size(std::size_t& count, std::size_t) {
    auto stored = static_cast<std::uint32_t>(count);
    number(stored);
    return true;
  }
  /// Written bytes are never damaged; for code that serves both directions.
  void damage() {}
  bool is_damaged() const { return false; }
  std::vector<std::byte> take() { return std::move(out_); }

 private:
  std::vector<std::byte> out_;
};

/// Whether a number that geometry cannot work with is damage.
enum class Numbers : bool { Any, Finite };

/// Never reads past the bytes and never gives a bool that is neither true nor false; the dialect
/// checks the other values when all are read.
class StateReader {
 public:
  static constexpr bool kReads = true;

  explicit StateReader(const std::vector<std::byte>& bytes, Numbers numbers = Numbers::Any)
      : in_(bytes), numbers_(numbers) {}

  template <class... Values>
  void operator()(Values&... values) {
    (visit_value(*this, values), ...);
  }
  template <class Number>
  void number(Number& value) {
    if (in_.size() - at_ < sizeof value) return damage();
    if constexpr (std::is_same_v<Number, bool>) {
      is_damaged_ |= static_cast<unsigned char>(in_[at_]) > 1;
      value = static_cast<unsigned char>(in_[at_]) != 0;
    } else {
      std::memcpy(&value, in_.data() + at_, sizeof value);
    }
    if constexpr (std::is_floating_point_v<Number>) {
      is_damaged_ |= numbers_ == Numbers::Finite && !std::isfinite(value);
    }
    at_ += sizeof value;
  }
  /// More than `most` elements are damage.
  bool size(std::size_t& count, std::size_t most) {
    std::uint32_t stored = 0;
    number(stored);
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
  Numbers numbers_;
  bool is_damaged_ = false;
};

namespace impl {

template <class Type>
inline constexpr bool kIsOptional = false;
template <class Type>
inline constexpr bool kIsOptional<std::optional<Type>> = true;

/// Stands for a member of any type while the members of a struct are counted. An optional makes
/// itself from what converts to its value.
struct AnyMember {
  template <class Member>
  requires(!kIsOptional<Member>) operator Member() const;
};

template <class Struct, class... Members>
constexpr std::size_t count_members() {
  if constexpr (requires { Struct{Members{}..., AnyMember{}}; }) {
    return count_members<Struct, Members..., AnyMember>();
  } else {
    return sizeof...(Members);
  }
}

template <class Archive, class Struct>
void visit_members(Archive& archive, Struct& value) {
  static_assert(std::is_aggregate_v<Struct>);
  constexpr std::size_t kCount = count_members<Struct>();
  if constexpr (kCount == 1) {
    auto& [a] = value;
    archive(a);
  } else if constexpr (kCount == 2) {
    auto& [a, b] = value;
    archive(a, b);
  } else if constexpr (kCount == 3) {
    auto& [a, b, c] = value;
    archive(a, b, c);
  } else if constexpr (kCount == 4) {
    auto& [a, b, c, d] = value;
    archive(a, b, c, d);
  } else if constexpr (kCount == 5) {
    auto& [a, b, c, d, e] = value;
    archive(a, b, c, d, e);
  } else if constexpr (kCount == 6) {
    auto& [a, b, c, d, e, f] = value;
    archive(a, b, c, d, e, f);
  } else if constexpr (kCount == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    archive(a, b, c, d, e, f, g);
  } else if constexpr (kCount == 8) {
    auto& [a, b, c, d, e, f, g, h] = value;
    archive(a, b, c, d, e, f, g, h);
  } else if constexpr (kCount == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    archive(a, b, c, d, e, f, g, h, i);
  } else if constexpr (kCount == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = value;
    archive(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (kCount == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    archive(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (kCount == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    archive(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (kCount == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = value;
    archive(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (kCount == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value;
    archive(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else {
    static_assert(std::is_empty_v<Struct>, "a struct of more than 14 members has its own `visit`");
  }
}

}  // namespace impl

// How a value of each kind is stored.

template <class Archive, class Value, std::size_t kCount>
void visit(Archive& archive, std::array<Value, kCount>& values) {
  for (Value& value : values) archive(value);
}
template <class Archive, std::size_t kCount>
void visit(Archive& archive, std::bitset<kCount>& bits) {
  for (std::size_t i = 0; i < kCount; ++i) {
    bool bit = bits.test(i);
    archive(bit);
    bits.set(i, bit);
  }
}
template <class Archive, class Value>
void visit(Archive& archive, std::optional<Value>& optional) {
  bool has = optional.has_value();
  archive(has);
  if (!has) return optional.reset();
  if (!optional) optional.emplace();
  archive(*optional);
}
/// Elements are made as their bytes are read, so that no count asks for more than there is.
template <class Archive, class Value>
void visit(Archive& archive, std::vector<Value>& list) {
  std::size_t count = list.size();
  if (!archive.size(count, UINT32_MAX)) return;
  if constexpr (Archive::kReads) list.clear();
  for (std::size_t i = 0; i < count && !archive.is_damaged(); ++i) {
    if constexpr (Archive::kReads) list.emplace_back();
    archive(list[i]);
  }
}
template <class Archive>
void visit(Archive& archive, std::string& text) {
  std::vector<char> characters(text.begin(), text.end());
  archive(characters);
  text.assign(characters.begin(), characters.end());
}
template <class Archive, class... Kinds>
void visit(Archive& archive, std::variant<Kinds...>& value) {
  auto kind = static_cast<std::uint8_t>(value.index());
  archive(kind);
  if constexpr (Archive::kReads) {
    std::uint8_t known = 0;
    const auto take = [&]<class Kind>(std::in_place_type_t<Kind>) {
      if (known++ == kind) value = Kind{};
    };
    (take(std::in_place_type<Kinds>), ...);
    if (kind >= known) return archive.damage();
  }
  std::visit([&](auto& each) { archive(each); }, value);
}

template <class Archive>
void visit(Archive& archive, Length& length) {
  double mm = length.mm();
  archive(mm);
  length = Length::mm(mm);
}
template <class Archive>
void visit(Archive& archive, Angle& angle) {
  double degrees = angle.degrees();
  archive(degrees);
  angle = Angle::degrees(degrees);
}
template <class Archive>
void visit(Archive& archive, Position& position) {
  for (const Axis axis : kAllAxes) {
    bool has = position.has(axis);
    double value = position.raw(axis);
    archive(has, value);
    position.set_raw(axis, value);
    if (!has) position.unmark(axis);
  }
}
template <class Archive>
void visit(Archive& archive, Feed& feed) {
  Feed::Per per = feed.per();
  const bool is_inverse = per == Feed::Per::Move;
  double number = is_inverse ? feed.moves_per_minute() : feed.length().mm();
  archive(per, number);
  if (per == Feed::Per::Minute) feed = Feed::per_minute(Length::mm(number));
  if (per == Feed::Per::Revolution) feed = Feed::per_revolution(Length::mm(number));
  if (per == Feed::Per::Move) feed = Feed::inverse_time(number);
}

template <class Archive, class Value>
void visit_value(Archive& archive, Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    Value read = value;
    archive.number(read);
    if (read < Value{} || read > kLast<Value>) return archive.damage();
    value = read;
  } else if constexpr (std::is_arithmetic_v<Value>) {
    archive.number(value);
  } else if constexpr (requires { visit(archive, value); }) {
    visit(archive, value);
  } else {
    impl::visit_members(archive, value);
  }
}

/// Of `count` values, those that are not 0, where most are. `value_at` gives one by its index.
template <class Archive, class ValueAt>
void visit_sparse(Archive& archive, std::size_t count, ValueAt value_at) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < count; ++i) used += value_at(i) != 0;
  if (!archive.size(used, count)) return;
  std::size_t at = 0;
  for (std::size_t n = 0; n < used; ++n, ++at) {
    if constexpr (!Archive::kReads) {
      while (value_at(at) == 0) ++at;
    }
    auto index = static_cast<std::uint32_t>(at);
    archive(index);
    if (index >= count) return archive.damage();
    archive(value_at(index));
  }
}

}  // namespace dripline::interpreter::language
