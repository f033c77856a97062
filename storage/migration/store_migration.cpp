#include "storage/migration/store_migration.hpp"

#include <algorithm>

#include "storage/migration/ends.hpp"
#include "storage/migration/numbers.hpp"
#include "storage/migration/table_copy.hpp"

namespace dripline::migration {
namespace {

Error migrated_elsewhere(const std::string& source, const std::string& target) {
  return {Errc::Conflict,
          fmt::format("{} was migrated before, and not to here ({}): it is not copied again, for a "
                      "server may have stored more since where it was migrated to",
                      source, target)};
}

/// One call: both ends, and how far it is.
class Migration {
 public:
  Migration(const Request& request, Layout layout, Source& source, Target& target)
      : request_(request), layout_(std::move(layout)), source_(source), target_(target) {}

  Result<Report> run(const std::string& identity) {
    report_.from = source_.label();
    report_.to = target_.label();
    report_.identity = identity;
    report_.term = source_.term();
    auto done = target_.is_complete() ? finish_complete() : source_.is_left() ? finish() : move();
    if (!done) return fail(done.error());
    return report_;
  }

 private:
  bool proceed(Step step, const std::string& table = "") {
    return !request_.proceed || request_.proceed({step, table, done_, total_});
  }
  Tick ticking(Step step, const Table& table) {
    return [this, step, &table](std::uint64_t rows) {
      done_ += rows;
      return proceed(step, table.name);
    };
  }

  /// The last call had been killed at its very end.
  Result<void> finish_complete() {
    if (!source_.is_left()) {
      return fail(Errc::Conflict, "{} holds a copy of {} already, which a server may have used",
                  target_.label(), source_.label());
    }
    report_.was_complete = true;
    return target_.activate(layout_);
  }

  Result<void> move() {
    if (auto sized = count_rows(); !sized) return sized;
    auto done = copy_and_verify();
    // What was there from an earlier call is of a source that a server has used since.
    const bool is_stale =
        !done && (done.error().code == Errc::Corrupt || done.error().code == Errc::Conflict);
    if (is_stale && report_.was_resumed) {
      report_.was_begun_again = true;
      done = begin_again();
      if (done) done = copy_and_verify();
    }
    if (!done) return done;
    if (!proceed(Step::Leave)) return fail(stopped());
    if (auto left = source_.leave(target_.label()); !left) return left;
    return finish();
  }

  /// Both are not used by any server now.
  Result<void> finish() {
    const auto state = read_state(target_.connections());
    if (!state) return fail(state.error());
    if (!state->is_verified) {
      return fail(
          migrated_elsewhere(source_.label(), fmt::format("{} is not complete", target_.label())));
    }
    auto tables = read_verified(target_.connections());
    if (!tables) return fail(tables.error());
    report_.tables = *std::move(tables);
    if (!proceed(Step::Activate)) return fail(stopped());
    return target_.activate(layout_);
  }

  Result<void> count_rows() {
    for (const Table& table : layout_.tables) {
      const auto rows = source_.connections().read([&](sql::Database& database) {
        return database.integer("SELECT count(*) FROM " + quoted(table.name));
      });
      if (!rows) return fail(rows.error());
      total_ += static_cast<std::uint64_t>(*rows);
      const auto state = table_state(target_.connections(), table);
      if (!state) return fail(state.error());
      done_ += state->rows;
      report_.was_resumed = report_.was_resumed || state->rows > 0 || state->is_whole;
    }
    return {};
  }

  Result<void> begin_again() {
    done_ = 0;
    return target_.connections().write([&](sql::Database& database) {
      return database.execute(restart_sql(target_.engine(), layout_));
    });
  }

  Result<void> copy_and_verify() {
    for (const Table& table : layout_.tables) {
      if (!proceed(Step::Copy, table.name)) return fail(stopped());
      auto copied = copy_table(source_.connections(), target_.connections(), table,
                               ticking(Step::Copy, table));
      if (!copied)
        return fail(copied.error().code, "table {}: {}", table.name, copied.error().what);
    }
    auto carried = carry_numbers(source_.connections(), target_.connections(), layout_);
    if (!carried) return carried;
    return verify();
  }

  Result<void> verify() {
    done_ = 0;
    std::vector<VerifiedTable> tables;
    for (const Table& table : layout_.tables) {
      if (!proceed(Step::Verify, table.name)) return fail(stopped());
      const auto kept = digest_of(source_.connections(), table, [](std::uint64_t) { return true; });
      if (!kept) return fail(kept.error());
      const auto moved = digest_of(target_.connections(), table, ticking(Step::Verify, table));
      if (!moved) return fail(moved.error());
      if (*kept != *moved) {
        return fail(Errc::Corrupt,
                    "table {}: {} has {} rows with digest {}, {} has {} with {}: nothing was "
                    "changed at the source",
                    table.name, source_.label(), kept->rows, kept->sha256.hex(), target_.label(),
                    moved->rows, moved->sha256.hex());
      }
      tables.push_back({table.name, *kept});
    }
    return save_verified(target_.connections(), tables);
  }

  const Request& request_;
  const Layout layout_;
  Source& source_;
  Target& target_;
  Report report_;
  std::uint64_t done_ = 0, total_ = 0;
};

}  // namespace

Result<Report> migrate(const Request& request) {
  auto layout = read_layout();
  if (!layout) return fail(layout.error());
  const bool to_postgresql = request.direction == Request::Direction::ToPostgresql;
  const auto source =
      to_postgresql ? leave_sqlite(request.file) : leave_postgresql(request.postgresql);
  if (!source) return fail(source.error());
  const auto identity = (*source)->connections().read(
      [](sql::Database& database) { return database.text("SELECT id FROM identity"); });
  if (!identity) return fail(identity.error());
  if (request.is_expected) {
    if (auto known = request.is_expected(*identity, (*source)->label()); !known)
      return fail(known.error());
  }
  const bool may_begin = !(*source)->is_left();
  const auto target = to_postgresql
                          ? enter_postgresql(request.postgresql, *layout, *identity, may_begin)
                          : enter_sqlite(request.file, *layout, *identity, may_begin);
  if (!target) {
    if (may_begin || target.error().code != Errc::NotFound) return fail(target.error());
    return fail(migrated_elsewhere((*source)->label(), target.error().what));
  }
  return Migration(request, *std::move(layout), **source, **target).run(*identity);
}

}  // namespace dripline::migration
