#include "storage/impl/repositories.hpp"

#include <limits>
#include <map>

#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

Record read_record(const sql::Statement& row) {
  Record record;
  record.machine = row.text(0);
  record.epoch = row.number(1);
  record.number = row.number(2);
  record.time = row.time(3);
  record.run = row.optional_text(4).value_or("");
  record.kind = row.text(5);
  record.block = row.number(6);
  record.line = row.number(7);
  record.sequence = row.integer(8);
  record.device = row.text(9);
  record.text = row.text(10);
  record.received = row.optional_time(11);
  return record;
}

/// The batch comes from outside: it must be of one machine and one epoch, and SQL must be able to
/// order the epoch.
Result<void> check(const RecordBatch& batch) {
  if (batch.epoch > std::numeric_limits<std::int64_t>::max()) {
    return fail(Errc::LimitExceeded, "records of {}: epoch {} is over 2^63", batch.machine,
                batch.epoch);
  }
  for (const Record& record : batch.records) {
    if (record.machine != batch.machine || record.epoch != batch.epoch) {
      return fail(Errc::Syntax, "record {} of {} epoch {} in a batch of {} epoch {}", record.number,
                  record.machine, record.epoch, batch.machine, batch.epoch);
    }
  }
  return {};
}

Result<std::uint64_t> last_number(sql::Database& database, std::int64_t machine,
                                  std::uint64_t epoch) {
  const auto last = sql::first_row(
      database, "SELECT last FROM record_epoch WHERE machine = ?1 AND epoch = ?2",
      [](const sql::Statement& row) { return row.number(0); }, machine, epoch);
  if (!last) return fail(last.error());
  return last->value_or(0);
}

Result<void> insert_record(sql::Statement& insert, std::int64_t machine, const Record& record,
                           UtcTime received) {
  std::optional<std::string> run;
  if (!record.run.empty()) run = record.run;
  return insert
      .bind(machine, record.epoch, record.number, record.time, run, record.kind, record.block,
            record.line, record.sequence, record.device, record.text,
            record.received.value_or(received))
      .post();
}

/// Inserts what follows `last` without a gap; returns the new last number.
struct Received {
  std::int64_t machine = 0;
  UtcTime time;
};
Result<std::uint64_t> insert_contiguous(sql::Database& database, const RecordBatch& batch,
                                        const Received& received, std::uint64_t last) {
  auto insert = database.prepare(
      "INSERT INTO record (machine, epoch, number, time_us, run, kind, block, line, sequence, "
      "device, text, received_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)");
  if (!insert) return fail(insert.error());
  std::map<std::string, std::uint64_t> outputs;
  for (const Record& record : batch.records) {
    if (record.number <= last) continue;
    if (record.number != last + 1) break;
    if (auto done = insert_record(*insert, received.machine, record, received.time); !done)
      return fail(done.error());
    if (record.kind == "output" && !record.run.empty()) ++outputs[record.run];
    last = record.number;
  }
  for (const auto& [run, count] : outputs) {
    if (auto done = add_outputs(database, received.machine, {run, count}); !done)
      return fail(done.error());
  }
  return last;
}

/// Whether what the batch reports of `run` applies now: the record that reports it is stored. When
/// the batch holds no such record, nothing of the batch may have been left out.
bool is_stored(const RecordBatch& batch, const std::string& run, std::string_view kind,
               std::uint64_t last) {
  bool is_complete = true;
  for (const Record& record : batch.records) {
    if (record.run == run && record.kind == kind) return record.number <= last;
    is_complete = is_complete && record.number <= last;
  }
  return is_complete;
}

Result<void> apply_to_runs(sql::Database& database, const RecordBatch& batch, std::int64_t machine,
                           std::uint64_t last) {
  for (const RunBeginning& beginning : batch.beginnings) {
    if (!is_stored(batch, beginning.run, "run_started", last)) continue;
    if (auto done = apply_beginning(database, machine, beginning); !done) return done;
  }
  for (const RunEnding& ending : batch.endings) {
    if (!is_stored(batch, ending.run, "run_ended", last)) continue;
    if (auto done = apply_ending(database, machine, ending); !done) return done;
  }
  return {};
}

/// Within a transaction.
Result<std::uint64_t> write_batch(sql::Database& database, const RecordBatch& batch, UtcTime now) {
  const auto machine = machine_id(database, batch.machine, batch.epoch, now);
  if (!machine) return fail(machine.error());
  const auto before = last_number(database, *machine, batch.epoch);
  if (!before) return before;
  const auto last = insert_contiguous(database, batch, {*machine, now}, *before);
  if (!last) return last;
  if (*last > *before) {
    const auto noted =
        sql::run(database,
                 "INSERT INTO record_epoch (machine, epoch, last) VALUES (?1, ?2, ?3) "
                 "ON CONFLICT (machine, epoch) DO UPDATE SET last = excluded.last",
                 *machine, batch.epoch, *last);
    if (!noted) return fail(noted.error());
  }
  if (auto done = apply_to_runs(database, batch, *machine, *last); !done) return fail(done.error());
  return last;
}

}  // namespace

Result<std::uint64_t> RecordRepository::store(const RecordBatch& batch) {
  if (auto checked = check(batch); !checked) return fail(checked.error());
  return connections_.write(
      [&](sql::Database& database) { return write_batch(database, batch, clock_.now()); });
}

/// What one of them cannot be stored for must not keep the others from the disk: then each has a
/// transaction of its own.
std::vector<Result<std::uint64_t>> RecordRepository::store_all(
    const std::vector<RecordBatch>& batches) {
  std::vector<Result<std::uint64_t>> stored;
  const auto written = connections_.write([&](sql::Database& database) -> Result<void> {
    stored.clear();
    for (const RecordBatch& batch : batches) {
      if (auto checked = check(batch); !checked) return checked;
      const auto last = write_batch(database, batch, clock_.now());
      if (!last) return fail(last.error());
      stored.emplace_back(*last);
    }
    return {};
  });
  return written ? stored : RecordStore::store_all(batches);
}

Result<std::vector<Record>> RecordRepository::of_run(const std::string& run,
                                                     const std::string& kind, Page page) {
  static const std::string kSelect =
      "SELECT machine.name, record.epoch, number, time_us, run, kind, block, line, sequence, "
      "device, text, received_us FROM record JOIN machine ON machine.id = record.machine "
      "WHERE run = ?1 AND NOT EXISTS "  // another machine's report on a run is not the run's
      "(SELECT 1 FROM run AS owned WHERE owned.id = ?1 AND owned.machine <> record.machine) ";
  static const std::string kOrder = "ORDER BY record.epoch, number LIMIT ?2 OFFSET ?3";
  static const std::string kOfKind = kSelect + "AND kind = ?4 " + kOrder;
  static const std::string kOfAny = kSelect + kOrder;
  return connections_.read([&](sql::Database& database) {
    return kind.empty()
               ? sql::all_rows(database, kOfAny, read_record, run, page.limit, page.offset)
               : sql::all_rows(database, kOfKind, read_record, run, page.limit, page.offset, kind);
  });
}

Result<std::vector<Record>> RecordRepository::of_run_after(const std::string& run,
                                                           const std::string& kind,
                                                           RecordPlace after, std::uint64_t limit) {
  static const std::string kSelect =
      "SELECT machine.name, record.epoch, number, time_us, run, kind, block, line, sequence, "
      "device, text, received_us FROM record JOIN machine ON machine.id = record.machine "
      "WHERE run = ?1 AND (record.epoch, number) > (?2, ?3) AND NOT EXISTS "
      "(SELECT 1 FROM run AS owned WHERE owned.id = ?1 AND owned.machine <> record.machine) "
      "AND (?4 = '' OR kind = ?4) ORDER BY record.epoch, number LIMIT ?5";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSelect, read_record, run, after.epoch, after.number, kind,
                         limit);
  });
}

Result<std::vector<Record>> RecordRepository::of_machine_after(const std::string& machine,
                                                               RecordPlace after,
                                                               std::uint64_t limit) {
  static const std::string kSelect =
      "SELECT ?1, epoch, number, time_us, run, kind, block, line, sequence, device, text, "
      "received_us FROM record WHERE machine = (SELECT id FROM machine WHERE name = ?1) "
      "AND epoch = ?2 AND number > ?3 ORDER BY number LIMIT ?4";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSelect, read_record, machine, after.epoch, after.number, limit);
  });
}

Result<std::vector<Record>> RecordRepository::machine_report(const std::string& machine,
                                                             RecordPlace after,
                                                             std::uint64_t limit) {
  static const std::string kSelect =
      "SELECT ?1, epoch, number, time_us, run, kind, block, line, sequence, device, text, "
      "received_us FROM record WHERE machine = (SELECT id FROM machine WHERE name = ?1) "
      "AND run IS NULL AND kind IN ('output', 'probe') AND (epoch, number) > (?2, ?3) "
      "ORDER BY epoch, number LIMIT ?4";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSelect, read_record, machine, after.epoch, after.number, limit);
  });
}

/// The condition is the index's own, word for word: only so is it used.
Result<std::vector<MachineReport>> RecordRepository::machine_reports() {
  static const std::string kSelect =
      "SELECT (SELECT name FROM machine WHERE id = record.machine) AS name, count(*), "
      "min(time_us), "
      "max(time_us) FROM record WHERE run IS NULL AND kind IN ('output', 'probe') "
      "GROUP BY record.machine ORDER BY name";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSelect, [](const sql::Statement& row) {
      return MachineReport{.machine = row.text(0),
                           .lines = row.number(1),
                           .first = row.time(2),
                           .last = row.time(3)};
    });
  });
}

namespace {

/// The records of one report: those of one run in one epoch.
struct MemoryPlace {
  std::string run;
  std::uint64_t epoch = 0;
  UtcTime time;
};

/// Without the named index SQLite reads all records of the machine. Epochs of a gateway that lost
/// its journal have no order, so the time of the server decides.
Result<std::vector<MemoryPlace>> memory_places(sql::Database& database, const std::string& machine,
                                               const std::optional<std::string>& run,
                                               const std::string& prefix, Page page) {
  static const std::string kSelect =
      "SELECT run, epoch, max(time_us) FROM record INDEXED BY record_of_memory "
      "WHERE machine = (SELECT id FROM machine WHERE name = ?1) "
      "AND kind = 'message' AND device = 'memory' AND run IS NOT NULL AND run = coalesce(?2, run) "
      "AND substr(run, 1, length(?5)) = ?5 "
      "GROUP BY run, epoch "
      "ORDER BY max(coalesce(received_us, time_us)) DESC, epoch DESC, max(number) DESC "
      "LIMIT ?3 OFFSET ?4";
  return sql::all_rows(
      database, kSelect,
      [](const sql::Statement& row) {
        return MemoryPlace{row.text(0), row.number(1), row.time(2)};
      },
      machine, run, page.limit, page.offset, prefix);
}

}  // namespace

Result<std::vector<MemoryReport>> RecordRepository::memory_reports(
    const std::string& machine, const std::optional<std::string>& run, Page page) {
  return memory_reports_of(machine, run, "", page);
}

Result<std::vector<MemoryReport>> RecordRepository::memory_changes(const std::string& machine,
                                                                   const std::string& prefix,
                                                                   Page page) {
  return memory_reports_of(machine, std::nullopt, prefix, page);
}

Result<std::vector<MemoryReport>> RecordRepository::memory_reports_of(
    const std::string& machine, const std::optional<std::string>& run, const std::string& prefix,
    Page page) {
  static const std::string kTexts =
      "SELECT text FROM record INDEXED BY record_of_memory "
      "WHERE machine = (SELECT id FROM machine WHERE name = ?1) "
      "AND kind = 'message' AND device = 'memory' AND epoch = ?2 AND run = ?3 ORDER BY number";
  return connections_.read([&](sql::Database& database) -> Result<std::vector<MemoryReport>> {
    const auto places = memory_places(database, machine, run, prefix, page);
    if (!places) return fail(places.error());
    std::vector<MemoryReport> reports;
    for (const MemoryPlace& place : *places) {
      auto texts = sql::all_rows(
          database, kTexts, [](const sql::Statement& row) { return row.text(0); }, machine,
          place.epoch, place.run);
      if (!texts) return fail(texts.error());
      reports.push_back({place.run, place.time, *std::move(texts)});
    }
    return reports;
  });
}

}  // namespace dripline::storage
