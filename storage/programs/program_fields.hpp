#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "storage/actor.hpp"

namespace dripline::storage {

/// What a program is for, whatever its revision. Empty: not stated.
struct ProgramFields {
  std::string part, operation, material;
  std::string machine_group;  ///< whose machines it is for
  friend bool operator==(const ProgramFields&, const ProgramFields&) = default;
};

/// New values; what is absent stays, an empty text takes the value away.
struct FieldChange {
  std::optional<std::string> part = {}, operation = {}, material = {}, machine_group = {};
  std::optional<std::string> cam_file = {};  ///< of a revision: where its bytes come from

  bool is_of_program() const { return part || operation || material || machine_group; }
  bool is_empty() const { return !is_of_program() && !cam_file; }
};

struct Description {
  std::string program;
  std::optional<std::uint64_t> revision;  ///< for `cam_file`; absent: the latest
  FieldChange change;
  Actor who;
};

/// Of each field.
inline constexpr std::size_t kMaxField = 200;  // bytes

}  // namespace dripline::storage
