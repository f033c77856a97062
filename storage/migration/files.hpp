#pragma once

#include <filesystem>

namespace dripline::migration {

/// Where a server's SQLite file is while a migration into it is in progress, and when it was left.
std::filesystem::path entered_file(const std::filesystem::path& file);
std::filesystem::path left_file(const std::filesystem::path& file);

}  // namespace dripline::migration
