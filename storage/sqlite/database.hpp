#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "storage/sql/database.hpp"
#include "storage/sqlite/statement.hpp"

namespace dripline::storage::sqlite {

enum class Access { ReadWrite, ReadOnly };

/// When a commit has returned: Full = it survives a power cut; Normal = it survives a kill of the
/// process, but a power cut may take the last commits (never tear one).
enum class Synchronous { Normal, Full };

struct OpenOptions {
  Access access = Access::ReadWrite;  ///< ReadWrite creates the file
  Synchronous synchronous = Synchronous::Full;
  std::chrono::milliseconds busy_timeout{5000};  ///< then Errc::Busy
  std::uint64_t page_bytes = 4096;               ///< of a new file; a power of two, 512 to 65536
  std::uint64_t max_bytes = 0;  ///< the file never grows beyond; 0 = as the disk allows
  std::uint64_t cache_bytes = 2 << 20;
  std::uint64_t checkpoint_bytes = 4 << 20;  ///< of log after which it is written into the file
};

/// One connection to one file: WAL, foreign keys on, no secure delete. The text of an error holds
/// SQLite's extended code.
class Database final : public sql::Database {
 public:
  static Result<Database> open(const std::filesystem::path& file, const OpenOptions& options = {});
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;
  ~Database() override;

  sql::Engine engine() const override { return sql::Engine::Sqlite; }
  Result<void> execute(const std::string& sql) override;
  Result<Statement> prepare(const std::string& sql) override;
  std::uint64_t changes() const override;
  /// Row id of the last INSERT.
  std::int64_t last_insert_id() const;
  bool in_transaction() const;
  /// Outside a transaction only: what the next commits promise.
  Result<void> set_synchronous(Synchronous synchronous);

  /// From any thread: what the connection executes now soon ends with an error.
  void interrupt();

  /// Copies the file, page by page, as it is now (inside a Snapshot: as it was at its begin), while
  /// other connections read and write. `proceed(done, total)`, in bytes, is asked every few MiB;
  /// false ends the copying. An existing file is overwritten; the copy is on disk when this
  /// returns. False: it was ended, and the copy is worth nothing.
  Result<bool> copy_to(const std::filesystem::path& file,
                       const std::function<bool(std::uint64_t, std::uint64_t)>& proceed);

  const std::string& file() const;

 private:
  struct Connection;
  explicit Database(std::unique_ptr<Connection> connection);
  Result<void> configure(const OpenOptions& options);

  std::unique_ptr<Connection> connection_;
};

}  // namespace dripline::storage::sqlite
