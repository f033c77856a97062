#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace dripline::cli {

struct NamedRevision {
  std::string program;
  std::optional<std::uint64_t> revision;
};

/// NAME or NAME@REVISION; an @ without a number after it is part of the name.
NamedRevision named_revision(const std::string& text);

}  // namespace dripline::cli
