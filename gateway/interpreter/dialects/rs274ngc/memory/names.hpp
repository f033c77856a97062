#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "gateway/interpreter/dialects/rs274ngc/state.hpp"

/// Named parameters (16.1): `#<_name>` is global, `#<name>` belongs to the call it was made in.
/// Names are met by their number, so a loop looks up a name only by one hash of its letters.
namespace dripline::interpreter::rs274ngc {

using NameId = std::uint16_t;
inline constexpr std::size_t kMaxNames = 1000;
inline constexpr std::size_t kMaxNameLength = 64;
inline constexpr NameId kNoName = std::numeric_limits<NameId>::max();

class NamedParameters {
 public:
  /// The number of a name, new ones get the next; kNoName when there is no room.
  NameId id_of(std::string_view name);
  /// Like id_of, but never makes one.
  NameId find(std::string_view name) const;
  const std::string& name(NameId id) const { return names_[id]; }

  /// nullptr: not defined here and now.
  const double* value(NameId id, std::size_t level) const;
  void set(NameId id, std::size_t level, double value);
  /// A call of `level` begins: it has no parameters of its own yet.
  void enter(std::size_t level);

  template <class Archive>
  void visit(Archive& archive);

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const {
      return std::hash<std::string_view>{}(text);
    }
  };
  struct Slot {
    double value = 0;
    bool is_defined = false;
  };
  using Values = std::vector<Slot>;
  bool is_global(NameId id) const { return names_[id].front() == '_'; }
  const Values& values(NameId id, std::size_t level) const {
    return is_global(id) ? globals_ : locals_[level];
  }

  std::vector<std::string> names_;
  std::unordered_map<std::string, NameId, Hash, std::equal_to<>> ids_;
  Values globals_;
  std::array<Values, kMaxCalls + 1> locals_;
};

template <class Archive>
void NamedParameters::visit(Archive& archive) {
  std::size_t count = names_.size();
  if (!archive.size(count, kMaxNames)) return;
  names_.resize(count);
  for (std::string& name : names_) {
    std::size_t length = name.size();
    if (!archive.size(length, kMaxNameLength)) return;
    name.resize(length);
    for (char& c : name) archive(c);
    if (name.empty()) return archive.damage();
  }
  const auto visit_values = [&](Values& values) {
    std::size_t used = values.size();
    if (!archive.size(used, count)) return;
    values.resize(used);
    for (Slot& slot : values) {
      archive(slot.value);
      archive(slot.is_defined);
    }
  };
  visit_values(globals_);
  for (Values& values : locals_) visit_values(values);
  if constexpr (Archive::kReads) {
    ids_.clear();
    for (std::size_t i = 0; i < names_.size(); ++i) {
      ids_.emplace(names_[i], static_cast<NameId>(i));
    }
  }
}

}  // namespace dripline::interpreter::rs274ngc
