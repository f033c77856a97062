#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace dripline::cli {

/// Takes NAME or NAME@REVISION apart; an @ without a number after it is part of the name. Pure.
std::pair<std::string, std::optional<std::uint64_t>> name_and_revision(const std::string& text);

}  // namespace dripline::cli
