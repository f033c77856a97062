#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>

#include "protocol/base/clock.hpp"
#include "storage/opened_store.hpp"

namespace dripline::storage {

struct SqliteStoreOptions {
  std::filesystem::path file;           ///< created when missing; its folder must exist
  std::uint64_t max_bytes = 0;          ///< the database never grows beyond; 0 = as the disk allows
  std::size_t readers = 4;              ///< connections that read at the same time
  std::uint64_t cache_bytes = 8 << 20;  ///< of program chunks kept checked and decompressed
  std::chrono::milliseconds wait{10000};  ///< at most for a connection, then Errc::Busy
};

/// The first Store: one SQLite file. Writes run one at a time on one connection, each on disk when
/// it returns (except RunStore::update_counters); reads run beside them, each on one consistent
/// snapshot. One process uses a file at a time.
class SqliteStore final : public OpenedStore {
 public:
  /// Creates or migrates the file. `clock` must outlive the store. Errors: Busy (another process
  /// uses the file), Unsupported (a newer version's file), Corrupt, Io.
  static Result<std::unique_ptr<SqliteStore>> open(const SqliteStoreOptions& options,
                                                   const Clock& clock);
  ~SqliteStore() override;

  using OpenedStore::check;
  Result<bool> check(std::chrono::milliseconds limit, const std::stop_token& stop) override;
  Result<void> probe() override;
  /// See sqlite::Database::copy_to. Until it is complete the log of changes (the file beside,
  /// "-wal") grows with what is written.
  Result<bool> copy_to(const std::filesystem::path& file,
                       const std::function<bool(std::uint64_t, std::uint64_t)>& proceed) override;
  Result<std::string> identity() override;

 private:
  struct Parts;
  explicit SqliteStore(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// A file that no process uses, as a backup's copy is: searches the whole of it for damage.
/// Returns its identity. Errors: Corrupt, Io.
Result<std::string> check_copy(const std::filesystem::path& file);

}  // namespace dripline::storage
