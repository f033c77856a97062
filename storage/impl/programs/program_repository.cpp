#include "storage/impl/programs/program_repository.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "protocol/base/names.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/field_rows.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/programs/program_store.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

struct ProgramState {
  bool is_known = false;        ///< the name was used, maybe by a program that was removed since
  std::uint64_t revisions = 0;  ///< that can be seen
  std::uint64_t held = 0;       ///< the highest of those that wait for acceptance; 0: none
};

Result<ProgramState> state_of(sql::Database& database, const std::string& program) {
  static const std::string kSql =
      "SELECT count(DISTINCT program.id), count(revision.number), "
      "coalesce(max(CASE WHEN revision.standing = 'held' THEN revision.number ELSE 0 END), 0) "
      "FROM program LEFT JOIN revision ON revision.program = program.id AND " +
      kRevisionVisible + "WHERE program.name = ?1";
  const auto row = sql::first_row(
      database, kSql,
      [](const sql::Statement& s) {
        return ProgramState{s.integer(0) != 0, s.number(1), s.number(2)};
      },
      program);
  if (!row) return fail(row.error());
  return row->value_or(ProgramState{});
}

/// `to` must be free. A name that a removed program had is not free for a rename: runs have it.
Result<void> check_target(sql::Database& database, const ProgramMove& move, bool is_rename) {
  if (auto named = check_program_name(move.to); !named) return named;
  if (move.from == move.to) {
    return fail(Errc::Conflict, "program {} cannot be {} itself", move.from,
                is_rename ? "renamed to" : "copied to");
  }
  const auto target = state_of(database, move.to);
  if (!target) return fail(target.error());
  if (target->revisions > 0) {
    return fail(Errc::Conflict, "program {} exists already, with {} revision{}", move.to,
                target->revisions, target->revisions == 1 ? "" : "s");
  }
  if (!is_rename || !target->is_known) return {};
  return fail(Errc::Conflict,
              "program {} was removed, and its runs and reports keep the name: choose another one",
              move.to);
}

Result<void> write_down(sql::Database& database, const ProgramMove& move, const std::string& action,
                        const std::string& detail, UtcTime now) {
  return add_audit(database, {now, move.who, action, move.to, detail});
}

/// Errors: Busy (an unfinished run uses the program, named).
Result<void> check_unused(sql::Database& database, const std::string& program) {
  const auto run = sql::first_row(
      database,
      "SELECT run.id, machine.name FROM run JOIN machine ON machine.id = run.machine "
      "JOIN program ON program.id = run.program "
      "WHERE program.name = ?1 AND run.state IN ('ordered', 'active') LIMIT 1",
      [](const sql::Statement& row) {
        return fmt::format("run {} on {}", row.text(0), row.text(1));
      },
      program);
  if (!run) return fail(run.error());
  if (!*run) return {};
  return fail(Errc::Busy, "program {} is used by the unfinished {}", program, **run);
}

Result<ProgramFields> fields_of(sql::Database& database, const std::string& program) {
  static const std::string kSql =
      "SELECT " + kFieldColumns + "FROM program WHERE name = ?1 AND latest IS NOT NULL";
  auto found = sql::first_row(
      database, kSql, [](const sql::Statement& row) { return read_fields(row, 0); }, program);
  if (!found) return fail(found.error());
  if (*found) return std::move(**found);
  return fail(Errc::NotFound, "program {} is not in the library", program);
}

/// Promises of both: storage/programs/program_store.hpp.
Result<Revision> copy_program(sql::Database& database, const ProgramMove& move,
                              std::optional<std::uint64_t> number, UtcTime now) {
  const auto source = find_revision(database, move.from, number);
  if (!source) return source;
  if (source->is_held) {
    return fail(Errc::Conflict,
                "program {} revision {} waits for acceptance: accept it before it is copied",
                move.from, source->number);
  }
  if (auto free = check_target(database, move, false); !free) return fail(free.error());
  const auto content = find_content(database, source->content);
  if (!content) return fail(content.error());
  if (!*content) return fail(Errc::Corrupt, "content {} is not there", source->content.hex());
  Upload upload;
  upload.program = move.to;
  upload.control = source->control;
  upload.comment = fmt::format("copy of {} revision {}", source->program, source->number);
  upload.author = move.who.name;
  const auto fields = fields_of(database, move.from);
  if (!fields) return fail(fields.error());
  upload.change = {fields->part, fields->operation, fields->material, fields->machine_group,
                   source->cam_file};
  auto copy = publish_revision(database, upload, (*content)->id, now);
  if (!copy) return copy;
  const std::string detail =
      fmt::format("revision {}: {} sha256 {}", copy->number, upload.comment, source->content.hex());
  if (auto written = write_down(database, move, "program.copy", detail, now); !written) {
    return fail(written.error());
  }
  return copy;
}

Result<void> rename_program(sql::Database& database, const ProgramMove& move, UtcTime now) {
  const auto source = state_of(database, move.from);
  if (!source) return fail(source.error());
  if (source->revisions == 0) {
    return fail(Errc::NotFound, "program {} is not in the library", move.from);
  }
  if (auto free = check_target(database, move, true); !free) return free;
  if (source->held != 0) {
    return fail(Errc::Conflict,
                "program {} has a revision {} from a machine that waits for acceptance: accept or "
                "reject it before the rename",
                move.from, source->held);
  }
  if (auto unused = check_unused(database, move.from); !unused) return unused;
  if (auto renamed =
          sql::run(database, "UPDATE program SET name = ?2 WHERE name = ?1", move.from, move.to);
      !renamed) {
    return renamed;
  }
  return write_down(database, move, "program.rename",
                    fmt::format("was {}, with {} revision{}", move.from, source->revisions,
                                source->revisions == 1 ? "" : "s"),
                    now);
}

}  // namespace
namespace {

/// A condition of a filter and the column it is on, the most selective first: of those that are
/// given the first one is looked up by its index, the others are compared (what is joined to them
/// keeps SQLite from choosing theirs).
struct FilterColumn {
  std::string_view column;
  std::optional<std::string> value;
};

std::vector<FilterColumn> columns_of(const ProgramFilter& filter) {
  std::optional<std::string> state;
  if (filter.state) state = to_string(*filter.state);
  return {{"part", filter.part},         {"operation", filter.operation},
          {"author", filter.author},     {"machine_group", filter.machine_group},
          {"material", filter.material}, {"state", state},
          {"control", filter.control}};
}

/// The ids of the page's programs in the order of their names, out of an index alone where there is
/// no filter: what is passed over costs little.
std::string select_page(const std::vector<FilterColumn>& columns) {
  std::string sql = "SELECT id FROM program WHERE latest IS NOT NULL AND name > ?3 ";
  bool has_index = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    sql +=
        fmt::format("AND (?{0} IS NULL OR true) ", i + 4);  // every parameter is there to be bound
    if (!columns[i].value) continue;
    const bool is_latest = columns[i].column == "author" || columns[i].column == "state" ||
                           columns[i].column == "control";
    sql += fmt::format("AND {}{}{} = ?{} ", is_latest ? "latest_" : "", columns[i].column,
                       std::exchange(has_index, true) ? " || ''" : "", i + 4);
  }
  return sql + "ORDER BY name LIMIT ?1 OFFSET ?2";
}

}  // namespace

Result<std::vector<ProgramSummary>> ProgramRepository::list(const ProgramFilter& filter,
                                                            Page page) {
  const auto columns = columns_of(filter);
  const std::string sql =
      "SELECT " + kRevisionColumns + ", program.revisions, program.held, program.released, " +
      kFieldColumns + "FROM (" + select_page(columns) +
      ") AS page CROSS JOIN program ON program.id = page.id "
      "JOIN revision ON revision.program = program.id AND revision.number = program.latest "
      "LEFT JOIN content ON content.sha256 = revision.sha256 "
      "LEFT JOIN content AS named ON named.id = revision.content ORDER BY program.name";
  const auto read = [](const sql::Statement& row) {
    ProgramSummary program{.latest = read_revision(row),
                           .revisions = row.number(kAfterRevision),
                           .held = row.number(kAfterRevision + 1),
                           .fields = read_fields(row, kAfterRevision + 3)};
    if (const auto released = row.optional_integer(kAfterRevision + 2))
      program.released = static_cast<std::uint64_t>(*released);
    return program;
  };
  return connections_.read([&](sql::Database& database) -> Result<std::vector<ProgramSummary>> {
    return sql::all_rows(database, sql, read, page.limit, page.offset, filter.after,
                         columns[0].value, columns[1].value, columns[2].value, columns[3].value,
                         columns[4].value, columns[5].value, columns[6].value);
  });
}

namespace {

/// The latest also where all are held.
Result<Revision> any_revision(sql::Database& database, const std::string& program,
                              std::optional<std::uint64_t> number) {
  if (number) return find_revision(database, program, number);
  const auto latest = sql::first_row(
      database, "SELECT latest FROM program WHERE name = ?1 AND latest IS NOT NULL",
      [](const sql::Statement& row) { return row.number(0); }, program);
  if (!latest) return fail(latest.error());
  if (!*latest) return fail(Errc::NotFound, "program {} is not in the library", program);
  return find_revision(database, program, **latest);
}

}  // namespace

Result<std::uint64_t> ProgramRepository::count() {
  const auto found = connections_.read([&](sql::Database& database) {
    return sql::first_row(database, "SELECT count(*) FROM program WHERE latest IS NOT NULL",
                          [](const sql::Statement& row) { return row.number(0); });
  });
  if (!found) return fail(found.error());
  return found->value_or(0);
}

Result<ProgramFields> ProgramRepository::fields(const std::string& program) {
  return connections_.read([&](sql::Database& database) { return fields_of(database, program); });
}

Result<void> ProgramRepository::describe(const Description& description) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto revision = any_revision(database, description.program, description.revision);
    if (!revision) return fail(revision.error());
    return storage::describe(database, *revision, description.change, description.who,
                             clock_.now());
  });
}

Result<std::vector<Revision>> ProgramRepository::revisions(const std::string& program) {
  static const std::string kSql = "SELECT " + kRevisionColumns + kRevisionTables +
                                  "WHERE program.name = ?1 AND " + kRevisionVisible +
                                  "ORDER BY revision.number DESC";
  auto found = connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, kSql, read_revision, program);
  });
  if (found && found->empty()) {
    return fail(Errc::NotFound, "program {} is not in the library", program);
  }
  return found;
}

Result<Revision> ProgramRepository::revision(const std::string& program,
                                             std::optional<std::uint64_t> number) {
  return connections_.read(
      [&](sql::Database& database) { return find_revision(database, program, number); });
}

Result<Revision> ProgramRepository::accept(const std::string& program, std::uint64_t number,
                                           const Actor& who) {
  return connections_.write([&](sql::Database& database) {
    return accept_revision(database, {program, number, who, clock_.now()});
  });
}

Result<void> ProgramRepository::reject(const std::string& program, std::uint64_t number,
                                       const Actor& who) {
  return connections_.write([&](sql::Database& database) {
    return reject_revision(database, {program, number, who, clock_.now()});
  });
}

Result<void> ProgramRepository::remove(const std::string& program) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    if (const auto latest = find_revision(database, program, std::nullopt);
        !latest && latest.error().code != Errc::Conflict) {
      return fail(latest.error());
    }
    if (auto unused = check_unused(database, program); !unused) return unused;
    return sql::run(database,
                    "UPDATE program SET removed_through = "
                    "(SELECT max(number) FROM revision WHERE program = id) WHERE name = ?1",
                    program);
  });
}

Result<Revision> ProgramRepository::copy(const ProgramMove& move,
                                         std::optional<std::uint64_t> number) {
  return connections_.write(
      [&](sql::Database& database) { return copy_program(database, move, number, clock_.now()); });
}

Result<void> ProgramRepository::rename(const ProgramMove& move) {
  return connections_.write(
      [&](sql::Database& database) { return rename_program(database, move, clock_.now()); });
}

}  // namespace dripline::storage
