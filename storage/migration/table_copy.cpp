#include "storage/migration/table_copy.hpp"

#include "storage/migration/rows.hpp"
#include "storage/migration/target_state.hpp"

namespace dripline::migration {
namespace {

constexpr std::size_t kRowsTogether = 5000;
constexpr std::uint64_t kBytesTogether = 8 << 20;
constexpr std::uint64_t kTickRows = 5000;

struct Batch {
  std::vector<Row> rows;
  bool is_last = false;
};

Result<Batch> read_batch(RowReader& reader) {
  Batch batch;
  std::uint64_t bytes = 0;
  while (batch.rows.size() < kRowsTogether && bytes < kBytesTogether) {
    auto row = reader.next();
    if (!row) return fail(row.error());
    if (!*row) {
      batch.is_last = true;
      return batch;
    }
    bytes += weight_of(**row);
    batch.rows.push_back(**std::move(row));
  }
  return batch;
}

Result<void> write_batch(Connections& target, const Table& table, const Batch& batch,
                         const TableState& then) {
  return target.write([&](sql::Database& database) -> Result<void> {
    {
      auto writer = RowWriter::begin(database, table);
      if (!writer) return fail(writer.error());
      for (const Row& row : batch.rows) {
        if (auto written = writer->write(row); !written) return written;
      }
    }
    return save_table_state(database, table, then);
  });
}

}  // namespace

Error stopped() {
  return {Errc::Timeout, "the migration was ended; the next call continues it"};
}

Result<void> copy_table(Connections& source, Connections& target, const Table& table,
                        const Tick& tick) {
  // Again from the target's state, when the picture of the source was lost.
  return source.read([&](sql::Database& database) -> Result<void> {
    auto state = table_state(target, table);
    if (!state) return fail(state.error());
    if (state->is_whole) return {};
    auto reader = RowReader::begin(database, table, state->rows);
    if (!reader) return fail(reader.error());
    while (!state->is_whole) {
      const auto batch = read_batch(*reader);
      if (!batch) return fail(batch.error());
      state->rows += batch->rows.size();
      state->is_whole = batch->is_last;
      if (auto written = write_batch(target, table, *batch, *state); !written) return written;
      if (!tick(batch->rows.size())) return fail(stopped());
    }
    return {};
  });
}

Result<TableDigest> digest_of(Connections& connections, const Table& table, const Tick& tick) {
  return connections.read([&](sql::Database& database) -> Result<TableDigest> {
    auto reader = RowReader::begin(database, table);
    if (!reader) return fail(reader.error());
    TableDigest digest;
    Sha256 sha256;
    std::string bytes;
    for (;;) {
      const auto row = reader->next();
      if (!row) return fail(row.error());
      if (!*row) break;
      bytes.clear();
      append_canonical(bytes, **row);
      sha256.update(bytes);
      if (++digest.rows % kTickRows == 0 && !tick(kTickRows)) return fail(stopped());
    }
    digest.sha256 = sha256.digest();
    if (!tick(digest.rows % kTickRows)) return fail(stopped());
    return digest;
  });
}

}  // namespace dripline::migration
