#include "storage/impl/record_reader_repository.hpp"

#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

Result<bool> is_reader_known(sql::Database& database, const std::string& reader) {
  const auto known = sql::first_row(
      database, "SELECT 1 FROM record_reader WHERE name = ?1",
      [](const sql::Statement& row) { return row.integer(0); }, reader);
  if (!known) return fail(known.error());
  return known->has_value();
}

Result<void> move_reader(sql::Database& database, const std::string& reader,
                         const RecordCursor& cursor) {
  auto moved = sql::run(database,
                        "INSERT INTO record_cursor (reader, machine, epoch, number) SELECT ?1, "
                        "id, ?3, ?4 FROM machine WHERE name = ?2 ON CONFLICT (reader, machine, "
                        "epoch) DO UPDATE SET number = max(record_cursor.number, excluded.number)",
                        reader, cursor.machine, cursor.epoch, cursor.number);
  if (!moved) return moved;
  if (database.changes() > 0) return {};
  return fail(Errc::NotFound, "machine '{}' is not known", cursor.machine);
}

}  // namespace

Result<void> RecordReaderRepository::begin(const std::string& reader, UtcTime now) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto known = is_reader_known(database, reader);
    if (!known) return fail(known.error());
    if (*known) return {};
    auto added = sql::run(database, "INSERT INTO record_reader (name, since_us) VALUES (?1, ?2)",
                          reader, now);
    if (!added) return added;
    return sql::run(database,
                    "INSERT INTO record_cursor (reader, machine, epoch, number) SELECT ?1, "
                    "machine, epoch, last FROM record_epoch",
                    reader);
  });
}

Result<std::vector<UnreadRecords>> RecordReaderRepository::unread(const std::string& reader) {
  static const std::string kSql =
      "SELECT machine.name, e.epoch, coalesce(c.number, 0), e.last FROM record_epoch AS e "
      "JOIN machine ON machine.id = e.machine LEFT JOIN record_cursor AS c "
      "ON c.reader = ?1 AND c.machine = e.machine AND c.epoch = e.epoch "
      "WHERE e.last > coalesce(c.number, 0) "
      "AND EXISTS (SELECT 1 FROM record_reader WHERE name = ?1) "
      "ORDER BY machine.name, e.epoch = machine.epoch, e.epoch";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(
        database, kSql,
        [](const sql::Statement& row) {
          return UnreadRecords{
              .cursor = {.machine = row.text(0), .epoch = row.number(1), .number = row.number(2)},
              .last = row.number(3)};
        },
        reader);
  });
}

Result<void> RecordReaderRepository::advance(const std::string& reader,
                                             const std::vector<RecordCursor>& cursors) {
  return connections_.write(
      [&](sql::Database& database) -> Result<void> {
        const auto known = is_reader_known(database, reader);
        if (!known) return fail(known.error());
        if (!*known) return fail(Errc::NotFound, "reader '{}' is not known", reader);
        for (const auto& cursor : cursors) {
          if (auto moved = move_reader(database, reader, cursor); !moved) return moved;
        }
        return {};
      },
      Durability::Normal);
}

}  // namespace dripline::storage
