#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "gateway/interpreter/dialects/rs274ngc/state.hpp"

/// Named parameters (LinuxCNC): `#<_name>` is global, `#<name>` belongs to the call it was made in.
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
  std::size_t count() const { return names_.size(); }
  /// Another number each time that a value, or which ones are in force, may have changed.
  std::uint64_t changes() const { return changes_; }

  /// nullptr: not defined here and now.
  const double* value(NameId id, std::size_t level) const;
  void set(NameId id, std::size_t level, double value);
  /// A call of `level` begins: it has no parameters of its own yet.
  void enter(std::size_t level);

  template <class Archive>
  friend void visit(Archive& archive, NamedParameters& names);

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

  std::uint64_t changes_ = 0;
  std::vector<std::string> names_;
  std::unordered_map<std::string, NameId, Hash, std::equal_to<>> ids_;
  Values globals_;
  std::array<Values, kMaxCalls + 1> locals_;
};

template <class Archive>
void visit(Archive& archive, NamedParameters& names) {
  archive(names.names_, names.globals_, names.locals_);
  if constexpr (Archive::kReads) {
    const std::size_t count = names.names_.size();
    bool is_plausible = count <= kMaxNames && names.globals_.size() <= count;
    for (const auto& values : names.locals_) is_plausible &= values.size() <= count;
    names.ids_.clear();
    for (const std::string& name : names.names_) {
      is_plausible &= !name.empty() && name.size() <= kMaxNameLength;
      names.ids_.emplace(name, static_cast<NameId>(names.ids_.size()));
    }
    if (!is_plausible) archive.damage();
  }
}

}  // namespace dripline::interpreter::rs274ngc
