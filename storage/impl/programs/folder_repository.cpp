#include "storage/impl/programs/folder_repository.hpp"

#include "storage/impl/programs/content.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

const std::string kSelectFolder =
    "SELECT id, folder, name, sha256, size, changed_ns, state, program, coalesce(revision, 0), "
    "reason, target, taken_us, moved_us FROM folder_file ";

FolderFile read_file(const sql::Statement& row) {
  FolderFile file;
  file.id = row.number(0);
  file.folder = row.text(1);
  file.name = row.text(2);
  file.sha256 = read_digest(row, 3);
  file.size = row.number(4);
  file.changed_ns = row.integer(5);
  // The schema allows only these words; a row with another one is damaged, and stored nothing.
  file.state = parse_folder_file_state(row.text(6)).value_or(FolderFileState::Failed);
  file.program = row.text(7);
  file.revision = row.number(8);
  file.reason = row.text(9);
  file.target = row.text(10);
  file.taken = row.time(11);
  file.moved = row.optional_time(12);
  return file;
}

Result<std::optional<FolderFile>> find_unfinished(sql::Database& database,
                                                  const std::string& folder,
                                                  const std::string& name) {
  static const std::string kSql =
      kSelectFolder + "WHERE folder = ?1 AND name = ?2 AND moved_us IS NULL";
  return sql::first_row(database, kSql, read_file, folder, name);
}

Result<void> check_changed(const sql::Database& database, std::uint64_t id) {
  if (database.changes() > 0) return {};
  return fail(Errc::NotFound, "folder file {} is not known, or in another state", id);
}

}  // namespace

Result<void> store_folder_file(sql::Database& database, std::uint64_t id,
                               const Revision& revision) {
  const auto stored = sql::run(database,
                               "UPDATE folder_file SET state = 'stored', program = ?2, revision "
                               "= ?3 WHERE id = ?1 AND state = 'taken'",
                               id, revision.program, revision.number);
  return stored ? check_changed(database, id) : stored;
}

Result<std::vector<FolderFile>> FolderRepository::unfinished(const std::string& folder) {
  static const std::string kSql =
      kSelectFolder + "WHERE folder = ?1 AND moved_us IS NULL ORDER BY id LIMIT ?2";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_file, folder, kKept);
  });
}

Result<std::optional<FolderFile>> FolderRepository::unfinished(const std::string& folder,
                                                               const std::string& name) {
  return connections_.read(
      [&](sql::Database& database) { return find_unfinished(database, folder, name); });
}

Result<FolderFile> FolderRepository::begin(const FolderFile& file) {
  return connections_.write([&](sql::Database& database) -> Result<FolderFile> {
    const auto before = find_unfinished(database, file.folder, file.name);
    if (!before) return fail(before.error());
    if (*before && (*before)->state != FolderFileState::Taken) {
      return fail(Errc::Conflict, "file {} of folder {} is {} already, and not moved yet",
                  file.name, file.folder, to_string((*before)->state));
    }
    if (*before) {
      auto dropped = sql::run(database, "DELETE FROM folder_file WHERE id = ?1", (*before)->id);
      if (!dropped) return fail(dropped.error());
    }
    const auto inserted = sql::insert(
        database,
        "INSERT INTO folder_file (folder, name, sha256, size, changed_ns, state, reason, taken_us) "
        "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8) RETURNING id",
        file.folder, file.name, std::span<const std::byte>(file.sha256.bytes), file.size,
        file.changed_ns, to_string(file.state), file.reason, file.taken);
    if (!inserted) return fail(inserted.error());
    FolderFile begun = file;
    begun.id = static_cast<std::uint64_t>(*inserted);
    return begun;
  });
}

Result<void> FolderRepository::fail_file(std::uint64_t id, const std::string& reason) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto failed = sql::run(database,
                                 "UPDATE folder_file SET state = 'failed', reason = ?2 "
                                 "WHERE id = ?1 AND state = 'taken'",
                                 id, reason);
    return failed ? check_changed(database, id) : failed;
  });
}

Result<void> FolderRepository::set_target(std::uint64_t id, const std::string& target) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto set =
        sql::run(database, "UPDATE folder_file SET target = ?2 WHERE id = ?1", id, target);
    return set ? check_changed(database, id) : set;
  });
}

Result<void> FolderRepository::set_moved(std::uint64_t id, UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto moved =
        sql::run(database, "UPDATE folder_file SET moved_us = ?2 WHERE id = ?1", id, time);
    if (!moved) return moved;
    if (auto changed = check_changed(database, id); !changed) return changed;
    return sql::run(database,
                    "DELETE FROM folder_file WHERE moved_us IS NOT NULL AND id <= ?1 - ?2", id,
                    kKept);
  });
}

Result<std::vector<FolderFile>> FolderRepository::list(const std::optional<std::string>& folder,
                                                       Page page) {
  static const std::string kSql =
      kSelectFolder + "WHERE ?1 IS NULL OR folder = ?1 ORDER BY id DESC LIMIT ?2 OFFSET ?3";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_file, folder, page.limit, page.offset);
  });
}

Result<FolderCounts> FolderRepository::counts(const std::string& folder) {
  const auto found = connections_.read([&](sql::Database& database) {
    return sql::first_row(
        database,
        "SELECT count(*) FILTER (WHERE state = 'stored'), count(*) FILTER (WHERE state = "
        "'failed') FROM folder_file WHERE folder = ?1",
        [](const sql::Statement& row) {
          return FolderCounts{row.number(0), row.number(1)};
        },
        folder);
  });
  if (!found) return fail(found.error());
  return found->value_or(FolderCounts{});
}

}  // namespace dripline::storage
