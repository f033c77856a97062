#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.hpp"

/// A file of events before anything in it means something: the same for TOML and JSON.
namespace dripline::conversational {

using FileValue = std::variant<double, bool, std::string>;

struct FileField {
  std::string name;
  FileValue value;
};

struct FileEvent {
  int line = 0;  ///< 0: not known
  std::vector<FileField> fields;
};

/// Errors: Syntax, with the line; LimitExceeded.
Result<std::vector<FileEvent>> read_toml(std::string_view text);
Result<std::vector<FileEvent>> read_json(std::string_view text);

inline constexpr std::size_t kMaxEvents = 5000;
inline constexpr std::string_view kShape =
    "expected a list of events: [[event]] with type = \"...\" and fields that are texts, numbers, "
    "true or false";

}  // namespace dripline::conversational
