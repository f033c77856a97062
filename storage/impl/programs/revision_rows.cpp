#include "storage/impl/programs/revision_rows.hpp"

#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/field_rows.hpp"
#include "storage/impl/repositories.hpp"

namespace dripline::storage {

const std::string kRevisionColumns =
    "program.name, revision.number, revision.sha256, coalesce(content.size, 0), revision.control, "
    "revision.comment, revision.author, revision.created_us, revision.standing = 'held', "
    "revision.accepted_us, named.sha256, revision.state, revision.released_us, "
    "revision.withdrawn_us, revision.cam_file, revision.in_force_after, revision.released_after, "
    "revision.withdrawn_after ";
const std::string kRevisionTables =
    "FROM revision JOIN program ON program.id = revision.program "
    "LEFT JOIN content ON content.sha256 = revision.sha256 "
    "LEFT JOIN content AS named ON named.id = revision.content ";
const std::string kRevisionVisible =
    "revision.number > program.removed_through AND revision.standing <> 'rejected' ";

Revision read_revision(const sql::Statement& row) {
  Revision revision;
  revision.program = row.text(0);
  revision.number = row.number(1);
  revision.content = read_digest(row, 2);
  revision.size = row.number(3);
  revision.control = row.text(4);
  revision.comment = row.text(5);
  revision.author = row.text(6);
  revision.created = row.time(7);
  revision.is_held = row.integer(8) != 0;
  revision.accepted = row.optional_time(9);
  // The schema allows only these words; a row with another one is damaged and runs nowhere.
  revision.state = parse_revision_state(row.text(11)).value_or(RevisionState::Withdrawn);
  revision.released = row.optional_time(12);
  revision.withdrawn = row.optional_time(13);
  revision.cam_file = row.text(14);
  const auto run = [&](int column) -> std::optional<std::uint64_t> {
    const auto number = row.optional_integer(column);
    return number ? std::optional(static_cast<std::uint64_t>(*number)) : std::nullopt;
  };
  revision.in_force_after = run(15);
  revision.released_after = run(16);
  revision.withdrawn_after = run(17);
  return revision;
}

BoundRevision read_bound(const sql::Statement& row) {
  return {read_revision(row), read_digest(row, 10)};
}

Result<void> check_content(const Revision& revision, const Digest& named) {
  if (named == revision.content) return {};
  return fail(Errc::Corrupt,
              "program {} revision {}: its row names content {}, but the revision was stored with "
              "{}: the database is damaged; push the program again",
              revision.program, revision.number, named.hex(), revision.content.hex());
}

namespace {

std::string select_visible(std::string_view condition) {
  return fmt::format("SELECT {}{}WHERE program.name = ?1 AND {}{}", kRevisionColumns,
                     kRevisionTables, kRevisionVisible, condition);
}

Result<std::optional<Revision>> checked(Result<std::optional<BoundRevision>> found) {
  if (!found) return fail(found.error());
  if (!*found) return std::optional<Revision>();
  if (auto good = check_content((*found)->revision, (*found)->named); !good) {
    return fail(good.error());
  }
  return std::optional(std::move((*found)->revision));
}

Result<std::optional<BoundRevision>> newest(sql::Database& database, const std::string& program,
                                            std::string_view decision) {
  static const std::string kSql =
      select_visible("AND revision.standing = ?2 ORDER BY revision.number DESC LIMIT 1");
  return sql::first_row(database, kSql, read_bound, program, decision);
}

/// Why there is no latest revision.
Result<Revision> no_latest(sql::Database& database, const std::string& program) {
  const auto held = newest(database, program, "held");
  if (!held) return fail(held.error());
  if (*held) {
    return fail(Errc::Conflict,
                "program {} came from a machine and waits for acceptance: accept its revision {} "
                "first",
                program, (*held)->revision.number);
  }
  return fail(Errc::NotFound, "program {} is not in the library", program);
}

struct ProgramRow {
  std::int64_t id = 0;
  std::uint64_t highest = 0;  ///< number ever given; 0: none yet
};

/// Makes the program when it is new.
Result<ProgramRow> program_row(sql::Database& database, const std::string& name) {
  const auto made = sql::run(
      database, "INSERT INTO program (name) VALUES (?1) ON CONFLICT (name) DO NOTHING", name);
  if (!made) return fail(made.error());
  const auto row = sql::first_row(
      database,
      "SELECT id, coalesce((SELECT max(number) FROM revision WHERE program = id), 0) "
      "FROM program WHERE name = ?1",
      [](const sql::Statement& s) {
        return ProgramRow{s.integer(0), s.number(1)};
      },
      name);
  if (!row) return fail(row.error());
  return row->value();
}

/// The revision that the upload would only repeat.
Result<std::optional<Revision>> find_same(sql::Database& database, const Upload& upload,
                                          std::int64_t content) {
  for (const std::string_view decision : {"accepted", "held"}) {
    if (decision == "held" && !upload.is_held) break;
    auto known = newest(database, upload.program, decision);
    if (!known) return fail(known.error());
    // One whose row is damaged, or that was withdrawn, is not repeated: the upload becomes a new
    // one.
    if (!*known || (*known)->named != (*known)->revision.content) continue;
    if ((*known)->revision.state == RevisionState::Withdrawn) continue;
    // The same text for another control is another program.
    if (!upload.control.empty() && (*known)->revision.control != upload.control) continue;
    const auto row = find_content(database, (*known)->revision.content);
    if (!row) return fail(row.error());
    if (*row && (*row)->id == content) return std::optional(std::move((*known)->revision));
  }
  return std::nullopt;
}

Result<void> set_standing(sql::Database& database, const Judgment& judgment,
                          std::string_view decision, std::optional<UtcTime> accepted) {
  return sql::run(database,
                  "UPDATE revision SET standing = ?3, accepted_us = ?4, "
                  "in_force_after = (SELECT coalesce(max(run.number), 0) FROM run) "
                  "WHERE number = ?2 AND program = (SELECT id FROM program WHERE name = ?1)",
                  judgment.program, judgment.number, decision, accepted);
}

Result<void> write_down(sql::Database& database, const Judgment& judgment,
                        const std::string& action, const Digest& content) {
  std::string detail = fmt::format("revision {} sha256 {}", judgment.number, content.hex());
  if (!judgment.target.empty())
    detail += fmt::format(" as {} revision {}", judgment.target, judgment.target_revision);
  if (!judgment.reason.empty()) detail += ": " + judgment.reason;
  return add_audit(database, {judgment.time, judgment.who, action, judgment.program, detail});
}

/// Who sent it, as the library names the author of what a machine sends.
std::string sender_of(const std::string& author) {
  constexpr std::string_view kMachine = "machine ";
  return author.starts_with(kMachine) ? author.substr(kMachine.size()) : author;
}

Result<void> begin_import(sql::Database& database, std::int64_t program, std::uint64_t number,
                          const Upload& upload) {
  return sql::run(database, "INSERT INTO import (program, revision, machine) VALUES (?1, ?2, ?3)",
                  program, number, sender_of(upload.author));
}

Result<void> end_import(sql::Database& database, const Judgment& judgment, std::string_view state) {
  return sql::run(
      database,
      "UPDATE import SET state = ?3, decided_us = ?4, who = ?5, reason = ?6, "
      "is_at_once = ?7, target = ?8, target_revision = nullif(?9, 0) WHERE revision = ?2 AND "
      "program = (SELECT id FROM program WHERE name = ?1)",
      judgment.program, judgment.number, state, judgment.time, judgment.who.name, judgment.reason,
      judgment.is_at_once ? 1 : 0, judgment.target, judgment.target_revision);
}

}  // namespace

Result<Revision> find_revision(sql::Database& database, const std::string& program,
                               std::optional<std::uint64_t> number) {
  static const std::string kNumbered = select_visible("AND revision.number = ?2");
  auto found = checked(number ? sql::first_row(database, kNumbered, read_bound, program, *number)
                              : newest(database, program, "accepted"));
  if (!found) return fail(found.error());
  if (*found) return std::move(**found);
  if (!number) return no_latest(database, program);
  return fail(Errc::NotFound, "program {} has no revision {} in the library", program, *number);
}

namespace {

/// What was stated with the upload is in force, whether or not it made a new revision.
Result<Revision> described(sql::Database& database, const Upload& upload, std::uint64_t number,
                           UtcTime now) {
  Revision revision;
  revision.program = upload.program;
  revision.number = number;
  auto done = describe(database, revision, upload.change, upload.author, now);
  if (!done) return fail(done.error());
  return find_revision(database, upload.program, number);
}

}  // namespace

Result<Revision> publish_revision(sql::Database& database, const Upload& upload,
                                  std::int64_t content, UtcTime now) {
  auto same = find_same(database, upload, content);
  if (!same) return fail(same.error());
  if (*same) return described(database, upload, (*same)->number, now);
  const auto program = program_row(database, upload.program);
  if (!program) return fail(program.error());
  const auto inserted = sql::run(
      database,
      "INSERT INTO revision (program, number, content, control, comment, author, created_us, "
      "standing, sha256, in_force_after) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, "
      "(SELECT sha256 FROM content WHERE content.id = ?3), "
      "(SELECT coalesce(max(run.number), 0) FROM run))",
      program->id, program->highest + 1, content, upload.control, upload.comment, upload.author,
      now, upload.is_held ? "held" : "accepted");
  if (!inserted) return fail(inserted.error());
  if (upload.is_held) {
    const auto begun = begin_import(database, program->id, program->highest + 1, upload);
    if (!begun) return fail(begun.error());
  }
  return described(database, upload, program->highest + 1, now);
}

Result<Revision> accept_revision(sql::Database& database, const Judgment& judgment) {
  auto revision = find_revision(database, judgment.program, judgment.number);
  if (!revision || !revision->is_held) return revision;
  if (auto set = set_standing(database, judgment, "accepted", judgment.time); !set) {
    return fail(set.error());
  }
  if (auto ended = end_import(database, judgment, "accepted"); !ended) return fail(ended.error());
  if (auto written = write_down(database, judgment, "program.accept", revision->content);
      !written) {
    return fail(written.error());
  }
  return find_revision(database, judgment.program, judgment.number);
}

Result<void> reject_revision(sql::Database& database, const Judgment& judgment) {
  const auto revision = find_revision(database, judgment.program, judgment.number);
  if (!revision) return fail(revision.error());
  if (!revision->is_held) {
    return fail(Errc::Conflict,
                "program {} revision {} is in force; only one that waits for acceptance can be "
                "rejected",
                judgment.program, judgment.number);
  }
  if (auto set = set_standing(database, judgment, "rejected", std::nullopt); !set) return set;
  const bool is_moved = !judgment.target.empty();
  if (auto ended = end_import(database, judgment, is_moved ? "accepted_as" : "rejected"); !ended)
    return ended;
  return write_down(database, judgment, is_moved ? "program.accept_as" : "program.reject",
                    revision->content);
}

}  // namespace dripline::storage
