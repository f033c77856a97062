#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "protocol/archive/archive_writer.hpp"
#include "protocol/base/clock.hpp"
#include "server/library/history/archive_check.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// How long rows of a kind stay in the tables. Absent: for ever, without a limit.
struct RetentionRule {
  std::optional<std::chrono::hours> age;
  std::optional<std::uint64_t> rows;
  bool is_there() const { return age || rows; }
};

/// Moves old records and measurements into archives (protocol/archive): first the file, then its
/// row with an audit entry, then the rows out of the tables, some at a time so that records are
/// stored meanwhile. A kill at any point loses nothing and leaves nothing half: what is in a listed
/// archive is removed by the next server. Any thread; all of it must outlive the object.
class Retention {
 public:
  struct Parts {
    const storage::Store& store;
    const Clock& clock;
    std::filesystem::path folder;  ///< of archives
    std::string database;          ///< identity
    std::string made_by;
    /// Of the records (storage::RecordReaderStore): what it has not got stays. Empty: there is
    /// none.
    std::string reader = {};
  };
  struct Options {
    RetentionRule records, measurements;
    std::uint64_t file_rows = 50'000;  ///< of an archive, about
    std::uint64_t piece = 2000;        ///< rows read, or removed, at a time
    std::chrono::milliseconds every = std::chrono::hours(1);
  };
  Retention(Parts parts, Options options)
      : parts_(std::move(parts)),
        options_(options),
        check_({.store = parts_.store, .clock = parts_.clock, .folder = parts_.folder}) {}
  ~Retention();
  Retention(const Retention&) = delete;
  Retention& operator=(const Retention&) = delete;

  /// From now on, in the background; the archives are checked at once, and each day.
  void begin();
  void end();
  /// One pass now. Returns how many archives were made. Errors: Io, those of the store.
  Result<std::uint64_t> apply(const std::stop_token& stop = {});
  Result<std::vector<storage::Archive>> list(storage::Page page) {
    return parts_.store.archives.list(page);
  }
  /// Errors: NotFound.
  Result<storage::Archive> find(std::uint64_t id);
  /// Every row of an archive, in order. Errors: those of `take` and ArchiveReader, Corrupt (it is
  /// not the file that was listed).
  Result<void> read(const storage::Archive& archive,
                    const std::function<Result<void>(const std::string& row)>& take);
  ArchiveCheck& archive_check() { return check_; }
  const Options& options() const { return options_; }
  const std::filesystem::path& folder() const { return parts_.folder; }

 private:
  void work(const std::stop_token& stop);
  void check_archives(const std::stop_token& stop);
  Result<void> finish(const std::stop_token& stop);
  Result<void> remove_rows(const storage::Archive& archive, const std::stop_token& stop);
  Result<std::vector<storage::ArchivableRecords>> archivable_records();
  Result<std::uint64_t> archive_records(const std::stop_token& stop);
  Result<std::uint64_t> archive_measurements(const std::stop_token& stop);
  /// One file of a journal, of rows before `cutoff`, at most `rows`. False: there are none.
  Result<bool> archive_journal(storage::ArchivableRecords range, UtcTime cutoff, std::uint64_t rows,
                               const std::stop_token& stop);
  Result<bool> archive_parts(UtcTime cutoff, std::uint64_t values, const std::stop_token& stop);
  /// Ends the file, lists it, and takes its rows out of the tables.
  Result<void> keep(archive::ArchiveWriter& writer, storage::Archive archive,
                    const std::stop_token& stop);

  const Parts parts_;
  const Options options_;
  ArchiveCheck check_;
  std::mutex apply_mutex_;  ///< one pass at a time
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::jthread worker_;  // last: it uses the others
};

}  // namespace dripline::library
