#include "protocol/base/names.hpp"
#include "storage/impl/audit_repository.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/impl/setup_rows.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {

namespace {

/// Everything but the text.
constexpr const char* kSetupColumns =
    "machine, number, sha256, length(hex(text)) / 2, comment, author, created_us";

SetupRevision read_setup(const sql::Statement& row) {
  SetupRevision setup;
  setup.machine = row.text(0);
  setup.number = row.number(1);
  setup.sha256 = read_digest(row, 2);
  setup.size = row.number(3);
  setup.comment = row.text(4);
  setup.author = row.text(5);
  setup.created = row.time(6);
  return setup;
}
SetupRevision read_with_text(const sql::Statement& row) {
  SetupRevision setup = read_setup(row);
  setup.text = row.text(7);
  return setup;
}

Result<std::optional<SetupRevision>> newest(sql::Database& database, const std::string& machine) {
  static const std::string kSql = fmt::format(
      "SELECT {}, text FROM setup WHERE machine = ?1 ORDER BY number DESC LIMIT 1", kSetupColumns);
  return sql::first_row(database, kSql, read_with_text, machine);
}

Result<void> check_setup(const SetupRevision& setup) {
  if (auto named = check_machine_name(setup.machine); !named) return named;
  if (setup.text.size() <= kMaxSetup) return {};
  return fail(Errc::LimitExceeded, "machine {}: a setup of {} bytes, at most {}", setup.machine,
              setup.text.size(), kMaxSetup);
}

/// A text that was made from `base` never replaces one that was stored since.
Result<void> check_base(const SetupRevision& setup, std::optional<std::uint64_t> base,
                        std::uint64_t newest) {
  if (!base || *base == newest) return {};
  const std::string made_from = *base == 0 ? "before there was one" : fmt::format("from {}", *base);
  if (newest == 0) {
    return fail(Errc::Conflict, "machine {}: this setup was made {}, and there is none",
                setup.machine, made_from);
  }
  return fail(Errc::Conflict,
              "machine {}: this setup was made {}, and {} is the newest by now; nothing was stored",
              setup.machine, made_from, newest);
}

Result<void> insert(sql::Database& database, const SetupRevision& setup) {
  return sql::run(database,
                  "INSERT INTO setup (machine, number, text, sha256, comment, author, "
                  "created_us) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
                  setup.machine, setup.number, setup.text,
                  std::span<const std::byte>(setup.sha256.bytes), setup.comment, setup.author,
                  setup.created);
}

/// Absent: any.
Result<void> check_exists(sql::Database& database, const std::string& machine,
                          std::optional<std::uint64_t> number) {
  const auto found = sql::first_row(
      database, "SELECT number FROM setup WHERE machine = ?1 AND number = coalesce(?2, number)",
      [](const sql::Statement& row) { return row.number(0); }, machine, number);
  if (!found) return fail(found.error());
  if (*found) return {};
  if (!number) return fail(Errc::NotFound, "machine {} has no setup on the server", machine);
  return fail(Errc::NotFound, "machine {} has no setup {}", machine, *number);
}

LoadedSetup read_loaded(const sql::Statement& row) {
  LoadedSetup loaded{.machine = row.text(0), .number = {}, .who = row.text(2), .time = row.time(3)};
  if (const auto number = row.optional_integer(1))
    loaded.number = static_cast<std::uint64_t>(*number);
  return loaded;
}

}  // namespace

Result<SetupRevision> save_setup(sql::Database& database, const SetupRevision& given,
                                 std::optional<std::uint64_t> base, UtcTime now) {
  if (auto checked = check_setup(given); !checked) return fail(checked.error());
  SetupRevision setup = given;
  setup.sha256 = sha256(setup.text);
  setup.size = setup.text.size();
  setup.created = now;
  auto known = newest(database, setup.machine);
  if (!known) return fail(known.error());
  if (*known && (*known)->sha256 == setup.sha256) return std::move(**known);
  const std::uint64_t before = *known ? (*known)->number : 0;
  if (auto fresh = check_base(setup, base, before); !fresh) return fail(fresh.error());
  setup.number = before + 1;
  if (auto kept = insert(database, setup); !kept) return fail(kept.error());
  return setup;
}

Result<SetupRevision> SetupRepository::save(const SetupRevision& setup,
                                            std::optional<std::uint64_t> base) {
  const UtcTime now = clock_.now();
  return connections_.write(
      [&](sql::Database& database) { return save_setup(database, setup, base, now); });
}

Result<std::vector<SetupRevision>> SetupRepository::list(const std::string& machine, Page page) {
  static const std::string kSql =
      fmt::format("SELECT {} FROM setup WHERE machine = ?1 ORDER BY number DESC LIMIT ?2 OFFSET ?3",
                  kSetupColumns);
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_setup, machine, page.limit, page.offset);
  });
}

Result<SetupRevision> SetupRepository::find(const std::string& machine,
                                            std::optional<std::uint64_t> number) {
  static const std::string kSql =
      fmt::format("SELECT {}, text FROM setup WHERE machine = ?1 AND number = ?2", kSetupColumns);
  return connections_.read([&](sql::Database& database) -> Result<SetupRevision> {
    auto found = number ? sql::first_row(database, kSql, read_with_text, machine, *number)
                        : newest(database, machine);
    if (!found) return fail(found.error());
    if (*found) return std::move(**found);
    if (!number) return fail(Errc::NotFound, "machine {} has no setup on the server", machine);
    return fail(Errc::NotFound, "machine {} has no setup {}", machine, *number);
  });
}

Result<LoadedSetup> SetupRepository::note_loaded(const std::string& machine,
                                                 std::optional<std::uint64_t> number,
                                                 const Actor& who) {
  if (auto named = check_machine_name(machine); !named) return fail(named.error());
  const LoadedSetup loaded{
      .machine = machine, .number = number, .who = who.name, .time = clock_.now()};
  return connections_.write([&](sql::Database& database) -> Result<LoadedSetup> {
    if (auto there = check_exists(database, machine, number); !there) return fail(there.error());
    const auto kept =
        sql::run(database,
                 "INSERT INTO loaded_setup (machine, number, who, loaded_us) VALUES (?1, ?2, "
                 "?3, ?4) ON CONFLICT (machine) DO UPDATE SET number = excluded.number, who = "
                 "excluded.who, loaded_us = excluded.loaded_us",
                 machine, number, who.name, loaded.time);
    if (!kept) return fail(kept.error());
    const auto noted = add_audit(
        database, {.time = loaded.time,
                   .who = who,
                   .action = "setup.loaded",
                   .subject = machine,
                   .detail = number ? fmt::format("setup {} is in the control", *number)
                                    : std::string("which setup is in the control is not known")});
    if (!noted) return fail(noted.error());
    return loaded;
  });
}

Result<std::optional<LoadedSetup>> SetupRepository::loaded(const std::string& machine) {
  return connections_.read([&](sql::Database& database) {
    return sql::first_row(
        database, "SELECT machine, number, who, loaded_us FROM loaded_setup WHERE machine = ?1",
        read_loaded, machine);
  });
}

}  // namespace dripline::storage
