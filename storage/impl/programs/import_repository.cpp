#include "storage/impl/programs/import_repository.hpp"

#include "protocol/base/names.hpp"
#include "storage/impl/audit_repository.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

/// Those of a revision, then the queue's; a WHERE follows. Made when it is first used:
/// the revision's part is of another file.
const std::string& import_select() {
  static const std::string kSelect =
      "SELECT " + kRevisionColumns +
      ", import.machine, import.state, import.base, import.class, import.fault, "
      "import.compared_us, import.decided_us, import.who, import.reason, import.is_at_once, "
      "import.target, coalesce(import.target_revision, 0) " +
      kRevisionTables +
      "JOIN import ON import.program = revision.program AND import.revision = revision.number ";
  return kSelect;
}

Import read_import(const sql::Statement& row) {
  Import import;
  import.revision = read_revision(row);
  import.machine = row.text(kAfterRevision);
  // The schema allows only these words; a row with another one is damaged, and is offered to
  // no one.
  import.state = parse_import_state(row.text(kAfterRevision + 1)).value_or(ImportState::Rejected);
  if (const auto time = row.optional_time(kAfterRevision + 5)) {
    ImportClass found{.base = {},
                      .edit = row.text(kAfterRevision + 3),
                      .fault = row.text(kAfterRevision + 4),
                      .time = *time};
    if (const auto base = row.optional_integer(kAfterRevision + 2))
      found.base = static_cast<std::uint64_t>(*base);
    import.compared = std::move(found);
  }
  import.decided = row.optional_time(kAfterRevision + 6);
  import.who = row.text(kAfterRevision + 7);
  import.reason = row.text(kAfterRevision + 8);
  import.is_at_once = row.integer(kAfterRevision + 9) != 0;
  import.target = row.text(kAfterRevision + 10);
  import.target_revision = row.number(kAfterRevision + 11);
  return import;
}

Result<Import> find_import(sql::Database& database, const std::string& program,
                           std::uint64_t revision) {
  static const std::string kSql =
      import_select() + "WHERE program.name = ?1 AND import.revision = ?2";
  auto found = sql::first_row(database, kSql, read_import, program, revision);
  if (!found) return fail(found.error());
  if (*found) return std::move(**found);
  return fail(Errc::NotFound, "program {} revision {} did not come from a machine", program,
              revision);
}

Result<void> check_newest(sql::Database& database, const ImportDecision& decision) {
  if (!decision.at_once) return {};
  const auto newest = find_revision(database, decision.program, std::nullopt);
  if (!newest) return fail(newest.error());
  if (newest->number == decision.at_once->base) return {};
  return fail(Errc::Conflict, "program {} has revision {} by now", decision.program,
              newest->number);
}

Result<void> put_class(sql::Database& database, const std::string& program, std::uint64_t revision,
                       const ImportClass& found) {
  return sql::run(database,
                  "UPDATE import SET base = ?3, class = ?4, fault = ?5, compared_us = ?6 "
                  "WHERE revision = ?2 AND program = (SELECT id FROM program WHERE name = ?1)",
                  program, revision, found.base, found.edit, found.fault, found.time);
}

/// The revision of the target.
Result<Revision> accept_as(sql::Database& database, const ImportDecision& decision,
                           const Import& import) {
  if (auto named = check_program_name(decision.target); !named) return fail(named.error());
  if (decision.target == decision.program) {
    return fail(Errc::Conflict, "program {} is what it came as: accept it without another name",
                decision.program);
  }
  const auto content = find_content(database, import.revision.content);
  if (!content) return fail(content.error());
  if (!*content)
    return fail(Errc::Corrupt, "content {} is not there", import.revision.content.hex());
  Upload upload;
  upload.program = decision.target;
  upload.control = import.revision.control;
  upload.comment = fmt::format("{}, as {} revision {}", import.revision.comment, decision.program,
                               decision.revision);
  upload.author = import.revision.author;
  return publish_revision(database, upload, (*content)->id, decision.time);
}

}  // namespace

Result<std::vector<Import>> ImportRepository::list(bool is_pending, Page page) {
  static const std::string kPending = import_select() + "WHERE import.state = 'pending' AND " +
                                      kRevisionVisible +
                                      "ORDER BY revision.created_us, program.name, revision.number "
                                      "LIMIT ?1 OFFSET ?2";
  static const std::string kDecided = import_select() +
                                      "WHERE import.state <> 'pending' "
                                      "ORDER BY import.decided_us DESC, program.name, "
                                      "revision.number LIMIT ?1 OFFSET ?2";
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, is_pending ? kPending : kDecided, read_import, page.limit,
                         page.offset);
  });
}

Result<std::uint64_t> ImportRepository::count_pending() {
  static const std::string kSql =
      "SELECT count(*) FROM import JOIN revision ON revision.program = import.program AND "
      "revision.number = import.revision JOIN program ON program.id = import.program "
      "WHERE import.state = 'pending' AND " +
      kRevisionVisible;
  const auto found = connections_.read([&](sql::Database& database) {
    return sql::first_row(database, kSql, [](const sql::Statement& row) { return row.number(0); });
  });
  if (!found) return fail(found.error());
  return found->value_or(0);
}

Result<Import> ImportRepository::find(const std::string& program, std::uint64_t revision) {
  return connections_.read(
      [&](sql::Database& database) { return find_import(database, program, revision); });
}

Result<std::vector<Import>> ImportRepository::uncompared(std::uint64_t limit) {
  static const std::string kSql =
      import_select() + "WHERE import.state = 'pending' AND import.compared_us IS NULL AND " +
      kRevisionVisible + "ORDER BY revision.created_us, program.name, revision.number LIMIT ?1";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_import, limit); });
}

Result<void> ImportRepository::set_class(const std::string& program, std::uint64_t revision,
                                         const ImportClass& found) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto import = find_import(database, program, revision);
    if (!import) return fail(import.error());
    if (import->state != ImportState::Pending)
      return fail(Errc::NotFound, "program {} revision {} is pending no more", program, revision);
    return put_class(database, program, revision, found);
  });
}

Result<Revision> ImportRepository::decide(const ImportDecision& decision) {
  return connections_.write([&](sql::Database& database) -> Result<Revision> {
    const auto import = find_import(database, decision.program, decision.revision);
    if (!import) return fail(import.error());
    if (import->state != ImportState::Pending) {
      return fail(Errc::Conflict, "program {} revision {} is {} already", decision.program,
                  decision.revision,
                  import->state == ImportState::Rejected ? "rejected" : "accepted");
    }
    if (auto same = check_newest(database, decision); !same) return fail(same.error());
    Judgment judgment{.program = decision.program,
                      .number = decision.revision,
                      .who = decision.who,
                      .time = decision.time,
                      .reason = decision.reason};
    if (const auto& found = decision.at_once) {
      if (auto kept = put_class(database, decision.program, decision.revision, *found); !kept)
        return fail(kept.error());
      judgment.is_at_once = true;
      judgment.reason = fmt::format("at once, class {} against revision {}, {}", found->edit,
                                    found->base.value_or(0), decision.reason);
    }
    if (decision.state == ImportState::Accepted) return accept_revision(database, judgment);
    if (decision.state == ImportState::Rejected) {
      if (auto done = reject_revision(database, judgment); !done) return fail(done.error());
      return import->revision;
    }
    auto target = accept_as(database, decision, *import);
    if (!target) return target;
    judgment.target = target->program;
    judgment.target_revision = target->number;
    if (auto done = reject_revision(database, judgment); !done) return fail(done.error());
    return target;
  });
}

}  // namespace dripline::storage
