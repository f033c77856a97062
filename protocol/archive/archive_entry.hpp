#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "protocol/base/digest.hpp"

/// What the audit trail has of an archive: an entry of its making, whose subject is the file's name
/// and whose detail ends with its SHA-256.
namespace dripline::archive {

inline constexpr std::string_view kMadeAction = "archive.create";

/// nullopt: the detail has none.
std::optional<Digest> digest_in(std::string_view detail);
/// Of the whole file. Errors: Io.
Result<Digest> digest_of(const std::filesystem::path& file);

}  // namespace dripline::archive
