#include "storage/sqlite/database.hpp"

#include <sqlite3.h>
#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <unordered_map>

#include "storage/sqlite/statement.hpp"

namespace dripline::storage::sqlite {
namespace {

struct Prepared {
  std::shared_ptr<SQLite::Statement> statement;
  bool is_busy = false;  ///< a Statement object uses it now
};

constexpr std::string_view word(Synchronous synchronous) {
  return synchronous == Synchronous::Full ? "FULL" : "NORMAL";
}

}  // namespace

struct Database::Connection {
  Connection(const std::string& path, int flags, int busy_timeout_ms)
      : file(path), sqlite(path, flags, busy_timeout_ms) {}

  std::string file;
  SQLite::Database sqlite;
  std::unordered_map<std::string, Prepared> prepared;  // after sqlite: statements go first
  Synchronous synchronous = Synchronous::Full;
};

Database::Database(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;
Database::~Database() = default;

Result<Database> Database::open(const std::filesystem::path& file, const OpenOptions& options) {
  // One thread at a time uses a connection (see the header): no mutex inside SQLite.
  const int access = options.access == Access::ReadOnly
                         ? SQLite::OPEN_READONLY
                         : SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE;
  try {
    Database database(std::make_unique<Connection>(file.string(), access | SQLite::OPEN_NOMUTEX,
                                                   static_cast<int>(options.busy_timeout.count())));
    if (auto configured = database.configure(options); !configured) {
      return fail(configured.error().code, "database {}: {}", file.string(),
                  configured.error().what);
    }
    return database;
  } catch (const SQLite::Exception& exception) {
    return fail(error_of(exception, fmt::format("opening {}", file.string())));
  }
}

Result<void> Database::configure(const OpenOptions& options) {
  sqlite3_extended_result_codes(connection_->sqlite.getHandle(), 1);
  std::string pragmas;
  if (options.access == Access::ReadWrite) {
    pragmas = fmt::format("PRAGMA page_size = {}; PRAGMA journal_mode = WAL;", options.page_bytes);
  }
  // Debian's SQLite overwrites what is deleted with zeros; nothing here is secret enough for that.
  pragmas += fmt::format(
      "PRAGMA synchronous = {}; PRAGMA foreign_keys = ON; PRAGMA secure_delete = OFF;"
      "PRAGMA cache_size = -{}; PRAGMA temp_store = MEMORY;",
      word(options.synchronous), options.cache_bytes / 1024);
  if (auto done = execute(pragmas); !done) return done;
  connection_->synchronous = options.synchronous;

  const auto page_bytes = integer("PRAGMA page_size");  // of an existing file: its own
  if (!page_bytes) return fail(page_bytes.error());
  const auto pages = [&](std::uint64_t bytes) {
    return std::max<std::uint64_t>(1, bytes / static_cast<std::uint64_t>(*page_bytes));
  };
  std::string limits =
      fmt::format("PRAGMA wal_autocheckpoint = {}; PRAGMA journal_size_limit = {};",
                  pages(options.checkpoint_bytes), 4 * options.checkpoint_bytes);
  if (options.max_bytes > 0) {
    limits += fmt::format("PRAGMA max_page_count = {};", pages(options.max_bytes));
  }
  return execute(limits);
}

Result<void> Database::execute(const std::string& sql) {
  try {
    connection_->sqlite.exec(sql);
    return {};
  } catch (const SQLite::Exception& exception) {
    return fail(error_of(exception, sql));
  }
}

Result<Statement> Database::prepare(const std::string& sql) {
  try {
    Prepared& prepared = connection_->prepared[sql];
    if (prepared.is_busy) {  // a second use of the same text at the same time gets its own
      return Statement(std::make_unique<PreparedCursor>(
          std::make_shared<SQLite::Statement>(connection_->sqlite, sql), nullptr));
    }
    if (!prepared.statement) {
      prepared.statement = std::make_shared<SQLite::Statement>(connection_->sqlite, sql);
    }
    return Statement(std::make_unique<PreparedCursor>(prepared.statement, &prepared.is_busy));
  } catch (const SQLite::Exception& exception) {
    return fail(error_of(exception, sql));
  }
}

std::uint64_t Database::changes() const {
  return static_cast<std::uint64_t>(sqlite3_changes64(connection_->sqlite.getHandle()));
}

std::int64_t Database::last_insert_id() const {
  return connection_->sqlite.getLastInsertRowid();
}

bool Database::in_transaction() const {
  return sqlite3_get_autocommit(connection_->sqlite.getHandle()) == 0;
}

Result<bool> Database::copy_to(const std::filesystem::path& file,
                               const std::function<bool(std::uint64_t, std::uint64_t)>& proceed) {
  constexpr int kPagesPerStep = 1024;
  const std::string what = fmt::format("copying {} to {}", connection_->file, file.string());
  try {
    const auto page_bytes = integer("PRAGMA page_size");
    if (!page_bytes) return fail(page_bytes.error());
    SQLite::Database copy(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    copy.exec("PRAGMA journal_mode = OFF; PRAGMA synchronous = FULL");
    SQLite::Backup backup(copy, connection_->sqlite);
    const auto bytes = [&](int pages) {
      return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(*page_bytes);
    };
    int status = SQLITE_OK;
    while (status != SQLITE_DONE) {
      status = backup.executeStep(kPagesPerStep);
      if (status == SQLITE_BUSY || status == SQLITE_LOCKED)
        return fail(Errc::Busy, "{}: the database is in use", what);
      const auto total = bytes(backup.getTotalPageCount());
      if (!proceed(total - bytes(backup.getRemainingPageCount()), total)) return false;
    }
    return true;
  } catch (const SQLite::Exception& exception) {
    return fail(error_of(exception, what));
  }
}

Result<void> Database::set_synchronous(Synchronous synchronous) {
  if (connection_->synchronous == synchronous) return {};
  auto done = execute(fmt::format("PRAGMA synchronous = {}", word(synchronous)));
  if (done) connection_->synchronous = synchronous;
  return done;
}

void Database::interrupt() {
  sqlite3_interrupt(connection_->sqlite.getHandle());
}

const std::string& Database::file() const {
  return connection_->file;
}

}  // namespace dripline::storage::sqlite
