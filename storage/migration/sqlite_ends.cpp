#include "protocol/base/durable_file.hpp"
#include "storage/impl/sqlite_connections.hpp"
#include "storage/migration/ends.hpp"
#include "storage/migration/files.hpp"

namespace dripline::migration {
namespace {

namespace fs = std::filesystem;
using storage::SqliteConnections;

fs::path beside(const fs::path& file, const char* suffix) {
  return file.string() + suffix;
}

/// Names in a folder are on disk only when the folder is.
Result<void> rename_file(const fs::path& from, const fs::path& to) {
  std::error_code ec;
  fs::rename(from, to, ec);
  if (ec) return fail(Errc::Io, "{} to {}: {}", from.string(), to.string(), ec.message());
  sync_folder(to.parent_path());  // some file systems refuse it
  return {};
}

Result<std::string> identity_of(Connections& connections) {
  return connections.read(
      [](sql::Database& database) { return database.text("SELECT id FROM identity"); });
}

class SqliteSource final : public Source {
 public:
  SqliteSource(fs::path file, std::unique_ptr<SqliteConnections> connections, bool is_left)
      : file_(std::move(file)),
        label_(is_left ? left_file(file_).string() : file_.string()),
        connections_(std::move(connections)),
        is_left_(is_left) {}
  Connections& connections() override { return *connections_; }
  const std::string& label() const override { return label_; }
  bool is_left() const override { return is_left_; }

  Result<void> leave(const std::string&) override {
    // Closed, so that nothing of it is in a log beside it, but locked until it has another name.
    const FileLock lock = connections_->keep_lock();
    connections_.reset();
    for (const char* suffix : {"-wal", "-shm"}) {
      if (fs::exists(beside(file_, suffix)))
        return fail(Errc::Busy, "{} is open in another process", file_.string());
    }
    return rename_file(file_, left_file(file_));
  }

 private:
  const fs::path file_;
  const std::string label_;
  std::unique_ptr<SqliteConnections> connections_;
  const bool is_left_;
};

class SqliteTarget final : public Target {
 public:
  SqliteTarget(fs::path file, std::unique_ptr<SqliteConnections> connections, bool is_complete)
      : file_(std::move(file)),
        label_(file_.string()),
        connections_(std::move(connections)),
        is_complete_(is_complete) {}
  Connections& connections() override { return *connections_; }
  const std::string& label() const override { return label_; }
  sql::Engine engine() const override { return sql::Engine::Sqlite; }
  bool is_complete() const override { return is_complete_; }

  Result<void> activate(const Layout& layout) override {
    if (!is_complete_) {
      auto ended = connections_->write([&](sql::Database& database) {
        return database.execute(end_sql(sql::Engine::Sqlite, layout));
      });
      if (!ended) return ended;
    }
    const FileLock lock = connections_->keep_lock();
    connections_.reset();
    std::error_code ec;
    fs::remove(beside(entered_file(file_), ".lock"), ec);
    return rename_file(entered_file(file_), file_);
  }

 private:
  const fs::path file_;
  const std::string label_;
  std::unique_ptr<SqliteConnections> connections_;
  const bool is_complete_;
};

Result<bool> is_begun(Connections& connections) {
  return connections.read([](sql::Database& database) -> Result<bool> {
    const auto tables =
        database.integer("SELECT count(*) FROM sqlite_schema WHERE name = 'store_migration'");
    if (!tables) return fail(tables.error());
    return *tables > 0;
  });
}

}  // namespace

fs::path entered_file(const fs::path& file) {
  return beside(file, ".migrating");
}
fs::path left_file(const fs::path& file) {
  return beside(file, ".migrated");
}

Result<std::unique_ptr<Source>> leave_sqlite(const fs::path& file) {
  const bool is_there = fs::exists(file), was_left = fs::exists(left_file(file));
  if (!is_there && !was_left)
    return fail(Errc::NotFound, "there is no database to migrate: {} is missing", file.string());
  if (is_there && was_left) {
    return fail(Errc::Conflict,
                "{} is there already, from an earlier migration: move it away, {} would get its "
                "name",
                left_file(file).string(), file.string());
  }
  auto opened = SqliteConnections::open({.file = is_there ? file : left_file(file)});
  if (!opened) return fail(opened.error());
  return std::make_unique<SqliteSource>(file, *std::move(opened), !is_there);
}

Result<std::unique_ptr<Target>> enter_sqlite(const fs::path& file, const Layout& layout,
                                             const std::string& source, bool may_begin) {
  if (fs::exists(file)) {
    return fail(Errc::Conflict,
                "{} is there already: a migration makes it, and takes none that holds something",
                file.string());
  }
  if (!may_begin && !fs::exists(entered_file(file)))
    return fail(Errc::NotFound, "{} is missing", entered_file(file).string());
  auto opened = SqliteConnections::open({.file = entered_file(file)});
  if (!opened) return fail(opened.error());
  const auto begun = is_begun(**opened);
  if (!begun) return fail(begun.error());
  if (!*begun) {
    // Just made, also by one that was killed at once; or complete but for its name.
    const auto identity = identity_of(**opened);
    if (identity && *identity == source)
      return std::make_unique<SqliteTarget>(file, *std::move(opened), true);
    auto made = (*opened)->write([&](sql::Database& database) {
      return database.execute(begin_sql(sql::Engine::Sqlite, layout, source));
    });
    if (!made) return fail(made.error());
  }
  const auto state = read_state(**opened);
  if (!state) return fail(state.error());
  if (state->source != source) {
    return fail(Errc::Conflict,
                "{} is a migration of another database that was begun: remove it to begin this one",
                entered_file(file).string());
  }
  return std::make_unique<SqliteTarget>(file, *std::move(opened), false);
}

}  // namespace dripline::migration
