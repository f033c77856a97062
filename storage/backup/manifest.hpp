#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"

namespace dripline::backup {

/// One file of a state folder: its bytes are the chunks (storage/programs/chunk_codec.hpp), one
/// after the other; every chunk but the last has kChunkBytes.
struct KeptFile {
  std::string name;  ///< within the folder: no slash
  std::uint64_t size = 0;
  std::vector<Digest> chunks;
};

/// What a backup consists of. Its bytes are files of their own, shared with other backups.
struct Manifest {
  UtcTime made;
  std::string made_by;      ///< program and version
  std::string database;     ///< identity of the database
  std::uint64_t added = 0;  ///< bytes on disk that this backup needed beyond those there
  std::vector<KeptFile> files;

  std::uint64_t size() const;  ///< bytes of its files together
};

/// JSON with a digest over all of it.
std::string to_text(const Manifest& manifest);

/// Errors: Corrupt (cut off, changed, or nothing that to_text has made), Unsupported (a newer
/// format).
Result<Manifest> parse_manifest(std::string_view text);

}  // namespace dripline::backup
