#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/measurement_store.hpp"
#include "storage/page.hpp"
#include "storage/record_store.hpp"

namespace dripline::storage {

enum class ArchiveKind : std::uint8_t { Records, Measurements };
std::string_view to_string(ArchiveKind kind);  ///< records, measurements

/// A file (protocol/archive) with rows that are, or will be, no longer in the tables.
struct Archive {
  std::uint64_t id = 0;
  ArchiveKind kind = ArchiveKind::Records;
  std::string machine = {};           ///< of records; empty: of all
  std::uint64_t epoch = 0;            ///< of records
  std::uint64_t first = 0, last = 0;  ///< numbers of records, ids of parts
  std::string file = {};              ///< its name in the folder of archives
  Digest sha256 = {};
  std::uint64_t rows = 0, bytes = 0;
  UtcTime first_time{}, last_time{}, created{};
  bool is_removed = false;
  /// Its parts are counted for their runs (MeasurementStore::parts_of_run); false: it took some
  /// before there were such counts. The store's own.
  bool is_counted = true;
};

/// What a journal of a machine has in the table that may be taken out: it is derived, and belongs
/// to no unfinished run.
struct ArchivableRecords {
  std::string machine;
  std::uint64_t epoch = 0;
  std::uint64_t first = 0, last = 0;  ///< numbers; none are missing but those taken out before
};

/// Retention. Promises of every store: storage/store.hpp.
class ArchiveStore {
 public:
  virtual ~ArchiveStore() = default;

  virtual Result<std::vector<ArchivableRecords>> archivable_records() = 0;
  /// Of a journal, numbers `first` to `last` in their order, but what a control keeps (device
  /// memory), which stays.
  virtual Result<std::vector<Record>> records(const ArchivableRecords& range,
                                              std::uint64_t limit) = 0;
  /// The oldest parts in the order of their ids, up to the first that has not ended.
  virtual Result<std::vector<MeasuredPart>> ended_parts(std::uint64_t after,
                                                        std::uint64_t limit) = 0;
  virtual Result<std::vector<measurement::Measurement>> measurements_of(
      std::uint64_t part, const std::optional<MeasurementPlace>& after, std::uint64_t limit) = 0;
  virtual Result<std::vector<ReportFinding>> findings_of(std::uint64_t part) = 0;
  /// How many rows there are, about: what numbers and ids say.
  virtual Result<std::uint64_t> size(ArchiveKind kind) = 0;

  /// The file is on disk. The audit entry (archive.create), with the file's digest, is part of the
  /// transaction. Returns its id. Errors: Conflict (a file of that name is listed).
  virtual Result<std::uint64_t> add(const Archive& archive, const Actor& who) = 0;
  /// Takes some of its rows out of the tables; 0: none is left, and the archive says so. A part is
  /// counted for its run in the transaction that takes it out.
  virtual Result<std::uint64_t> remove_rows(std::uint64_t id, std::uint64_t limit) = 0;
  /// Newest first.
  virtual Result<std::vector<Archive>> list(Page page) = 0;
  /// Those whose rows are still to be taken out.
  virtual Result<std::vector<Archive>> unremoved() = 0;
  /// Those whose parts are not counted for their runs.
  virtual Result<std::vector<Archive>> uncounted() = 0;
};

}  // namespace dripline::storage
