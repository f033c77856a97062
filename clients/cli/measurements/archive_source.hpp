#pragma once

#include <memory>
#include <string>

#include "clients/tools/measurement_files/source.hpp"
#include "protocol/archive/verified_archive.hpp"

namespace dripline::cli {

/// Which file is meant.
struct ArchiveChoice {
  std::string file;
  std::string sha256;  ///< the beginning of it, as `dnc server archives` lists it; empty: any
};

/// Reads it to its end. Errors: those of VerifiedArchive, Unsupported (of another kind), Corrupt
/// (another SHA-256), Syntax (`sha256` is none).
Result<archive::VerifiedArchive> open_archive(const ArchiveChoice& choice, std::string_view kind);

/// The measurements of an archive in its order, part after part; those that were derived again
/// only if `with_superseded`.
Result<std::unique_ptr<measurement_files::MeasurementSource>> open_archived_measurements(
    const ArchiveChoice& choice, bool with_superseded);

/// `file` has the name of an archive.
bool is_archive_name(std::string_view file);

}  // namespace dripline::cli
