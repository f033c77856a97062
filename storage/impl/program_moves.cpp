#include "storage/impl/program_moves.hpp"

#include "protocol/base/names.hpp"
#include "storage/impl/content.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/impl/revision_rows.hpp"

namespace dripline::storage {
namespace {

struct ProgramState {
  bool is_known = false;        ///< the name was used, maybe by a program that was removed since
  std::uint64_t revisions = 0;  ///< that can be seen
  std::uint64_t held = 0;       ///< the highest of those that wait for acceptance; 0: none
};

Result<ProgramState> state_of(sqlite::Database& database, const std::string& program) {
  static const std::string kSql =
      "SELECT count(DISTINCT program.id), count(revision.number), "
      "coalesce(max(iif(revision.standing = 'held', revision.number, 0)), 0) "
      "FROM program LEFT JOIN revision ON revision.program = program.id AND " +
      kRevisionVisible + "WHERE program.name = ?1";
  const auto row = sqlite::first_row(
      database, kSql,
      [](const sqlite::Statement& s) {
        return ProgramState{s.integer(0) != 0, s.number(1), s.number(2)};
      },
      program);
  if (!row) return fail(row.error());
  return row->value_or(ProgramState{});
}

/// `to` must be free. A name that a removed program had is not free for a rename: runs have it.
Result<void> check_target(sqlite::Database& database, const ProgramMove& move, bool is_rename) {
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

Result<void> write_down(sqlite::Database& database, const ProgramMove& move,
                        const std::string& action, const std::string& detail, UtcTime now) {
  return add_audit(database, {now, move.who, action, move.to, detail});
}

}  // namespace

Result<void> check_unused(sqlite::Database& database, const std::string& program) {
  const auto run = sqlite::first_row(
      database,
      "SELECT run.id, machine.name FROM run JOIN machine ON machine.id = run.machine "
      "JOIN program ON program.id = run.program "
      "WHERE program.name = ?1 AND run.state IN ('ordered', 'active') LIMIT 1",
      [](const sqlite::Statement& row) {
        return fmt::format("run {} on {}", row.text(0), row.text(1));
      },
      program);
  if (!run) return fail(run.error());
  if (!*run) return {};
  return fail(Errc::Busy, "program {} is used by the unfinished {}", program, **run);
}

Result<Revision> copy_program(sqlite::Database& database, const ProgramMove& move,
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
  upload.author = move.who;
  auto copy = publish_revision(database, upload, (*content)->id, now);
  if (!copy) return copy;
  const std::string detail =
      fmt::format("revision {}: {} sha256 {}", copy->number, upload.comment, source->content.hex());
  if (auto written = write_down(database, move, "program.copy", detail, now); !written) {
    return fail(written.error());
  }
  return copy;
}

Result<void> rename_program(sqlite::Database& database, const ProgramMove& move, UtcTime now) {
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
          sqlite::run(database, "UPDATE program SET name = ?2 WHERE name = ?1", move.from, move.to);
      !renamed) {
    return renamed;
  }
  return write_down(database, move, "program.rename",
                    fmt::format("was {}, with {} revision{}", move.from, source->revisions,
                                source->revisions == 1 ? "" : "s"),
                    now);
}

}  // namespace dripline::storage
