#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

/// What is to be on disk after a power cut. False: it is not, and errno has the reason. Any thread.
namespace dripline {

/// All of them, however many calls that takes; not yet synchronized.
bool write_all(int file, std::span<const std::byte> bytes);
bool write_all(int file, std::string_view text);
/// A whole file that only its owner can read, in place of the one there, if any: a reader and a
/// power cut find the old or the new one. Makes and removes `path`.new.
bool replace_private_file(const std::filesystem::path& path, std::string_view text);
/// After a file in it was created, renamed or removed.
bool sync_folder(const std::filesystem::path& folder);

}  // namespace dripline
