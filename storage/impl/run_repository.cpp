#include "storage/impl/repositories.hpp"

#include <algorithm>

#include "storage/impl/job_repository.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/revision_rows.hpp"

namespace dripline::storage {
namespace {

const std::string kSelectRun =
    "SELECT run.id, machine.name, program.name, run.revision, run.sha256, coalesce(content.size, "
    "0), "
    "run.control, run.state, run.sent, run.accepted, run.executed, run.line, run.sequence, "
    "run.reason, run.executed_content, run.content_verified, run.author, run.created_us, "
    "run.started_us, run.ended_us, run.outputs, run.setup, run.sha256 IS NOT DISTINCT FROM "
    "revision.sha256, "
    "run.allowed_as, "
    "run.approval, run.job, run.gateway_setup, run.motion_seconds, run.path_mm, run.is_test, "
    "run.number FROM run "
    "JOIN machine ON machine.id = run.machine JOIN program ON program.id = run.program "
    "JOIN revision ON revision.program = run.program AND revision.number = run.revision "
    "LEFT JOIN content ON content.sha256 = run.sha256 ";

Run read_run(const sql::Statement& row) {
  Run run;
  run.id = row.text(0);
  run.machine = row.text(1);
  run.program = row.text(2);
  run.revision = row.number(3);
  run.content = read_digest(row, 4);
  run.size = row.number(5);
  run.control = row.text(6);
  // The schema allows only these words; a row with another one is damaged, and its run was cut off.
  run.state = parse_run_state(row.text(7)).value_or(RunState::Interrupted);
  run.counters = {row.number(8), row.number(9), row.number(10)};
  run.line = row.number(11);
  run.sequence = row.integer(12);
  run.reason = row.text(13);
  run.executed_content = row.optional_text(14);
  // A row that names another revision than the run was created with is damaged: nothing was
  // verified.
  const bool is_bound = row.integer(22) != 0;
  if (const auto verified = row.optional_integer(15)) {
    run.content_verified = *verified != 0 && is_bound;
  }
  run.author = row.text(16);
  run.created = row.time(17);
  run.started = row.optional_time(18);
  run.ended = row.optional_time(19);
  run.outputs = row.number(20);
  if (const auto setup = row.optional_integer(21)) {
    run.setup = static_cast<std::uint64_t>(*setup);
  }
  run.allowed_as = parse_run_allowance(row.text(23)).value_or(RunAllowance::Released);
  if (const auto approval = row.optional_integer(24))
    run.approval = static_cast<std::uint64_t>(*approval);
  if (const auto job = row.optional_integer(25)) run.job = static_cast<std::uint64_t>(*job);
  run.gateway_setup = row.optional_text(26);
  const auto seconds = row.optional_real(27), path = row.optional_real(28);
  if (seconds && path) run.statistics = RunStatistics{*seconds, *path};
  run.is_test = row.integer(29) != 0;
  run.number = row.number(30);
  return run;
}

/// Errors: NotFound.
Result<Run> find_run(sql::Database& database, const std::string& id) {
  static const std::string kSql = kSelectRun + "WHERE run.id = ?1";
  auto run = sql::first_row(database, kSql, read_run, id);
  if (!run) return fail(run.error());
  if (!*run) return fail(Errc::NotFound, "run {} is not known", id);
  return std::move(**run);
}

struct RunPlace {
  std::int64_t machine = 0;
  std::int64_t program = 0;
};

/// What was judged before may have been withdrawn since.
Result<void> check_state(const Run& run, RevisionState state) {
  const bool must_be_released = run.allowed_as == RunAllowance::Released;
  const bool is_allowed =
      must_be_released ? state == RevisionState::Released : state != RevisionState::Withdrawn;
  if (is_allowed) return {};
  return fail(Errc::Conflict, "program {} revision {} is {}", run.program, run.revision,
              to_string(state));
}

/// The run's content must be its revision's: what is fed is what was approved.
Result<std::int64_t> known_revision(sql::Database& database, const Run& run) {
  struct Found {
    std::int64_t program;
    Digest content;
    bool is_held;
    Digest named;
    RevisionState state;
  };
  const auto found = sql::first_row(
      database,
      "SELECT program.id, revision.sha256, revision.standing = 'held', content.sha256, "
      "revision.state FROM revision "
      "JOIN program ON program.id = revision.program "
      "LEFT JOIN content ON content.id = revision.content "
      "WHERE program.name = ?1 AND revision.number = ?2 "
      "AND revision.number > program.removed_through AND revision.standing <> 'rejected'",
      [](const sql::Statement& row) {
        return Found{row.integer(0), read_digest(row, 1), row.integer(2) != 0, read_digest(row, 3),
                     parse_revision_state(row.text(4)).value_or(RevisionState::Withdrawn)};
      },
      run.program, run.revision);
  if (!found) return fail(found.error());
  if (!*found) {
    return fail(Errc::NotFound, "program {} has no revision {} in the library", run.program,
                run.revision);
  }
  if ((*found)->is_held) {
    return fail(Errc::Conflict,
                "program {} revision {} came from a machine and waits for acceptance: accept it "
                "before it is run",
                run.program, run.revision);
  }
  if (auto allowed = check_state(run, (*found)->state); !allowed) return fail(allowed.error());
  if ((*found)->content != run.content) {
    return fail(Errc::Conflict, "run {}: content {} is not that of {} revision {}", run.id,
                run.content.hex(), run.program, run.revision);
  }
  Revision revision;
  revision.program = run.program;
  revision.number = run.revision;
  revision.content = run.content;
  if (auto good = check_content(revision, (*found)->named); !good) return fail(good.error());
  return (*found)->program;
}

/// Of a run under a release that pins what its program calls: none of that was withdrawn since.
Result<void> check_pins(sql::Database& database, const Run& run) {
  if (!run.approval) return {};
  const auto withdrawn = sql::first_row(
      database,
      "SELECT revision_pin.name, revision_pin.revision FROM revision_pin JOIN revision "
      "ON revision.program = revision_pin.program AND revision.number = revision_pin.revision "
      "WHERE revision_pin.step = ?1 AND revision.state <> 'released' LIMIT 1",
      [](const sql::Statement& row) {
        return fmt::format("{} revision {}", row.text(0), row.number(1));
      },
      *run.approval);
  if (!withdrawn) return fail(withdrawn.error());
  if (!*withdrawn) return {};
  return fail(Errc::Conflict, "program {} revision {} calls {}, which was withdrawn", run.program,
              run.revision, **withdrawn);
}

Result<void> check_idle(sql::Database& database, std::int64_t machine, const std::string& name) {
  const auto unfinished = sql::first_row(
      database, "SELECT id FROM run WHERE machine = ?1 AND state IN ('ordered', 'active')",
      [](const sql::Statement& row) { return row.text(0); }, machine);
  if (!unfinished) return fail(unfinished.error());
  if (!*unfinished) return {};
  return fail(Errc::Busy, "machine {} has the unfinished run {}", name, **unfinished);
}

Result<void> insert_run(sql::Database& database, const Run& run, const RunPlace& place) {
  return sql::run(
      database,
      "INSERT INTO run (id, machine, program, revision, control, state, sent, accepted, executed, "
      "line, sequence, reason, executed_content, content_verified, author, created_us, started_us, "
      "ended_us, setup, sha256, allowed_as, approval, job, gateway_setup, is_test) VALUES (?1, ?2, "
      "?3, ?4, "
      "?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, ?19, ?20, ?21, ?22, ?23, "
      "?24, ?25)",
      run.id, place.machine, place.program, run.revision, run.control, to_string(run.state),
      run.counters.sent, run.counters.accepted, run.counters.executed, run.line, run.sequence,
      run.reason, run.executed_content, run.content_verified, run.author, run.created, run.started,
      run.ended, run.setup, std::span<const std::byte>(run.content.bytes),
      to_string(run.allowed_as), run.approval, run.job, run.gateway_setup, run.is_test ? 1 : 0);
}

}  // namespace

Result<void> RunRepository::create(const Run& run) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto machine = known_machine(database, run.machine);
    if (!machine) return fail(machine.error());
    const auto program = known_revision(database, run);
    if (!program) return fail(program.error());
    if (auto allowed = check_pins(database, run); !allowed) return allowed;
    if (auto good = check_job(database, run); !good) return good;
    if (!is_finished(run.state)) {
      if (auto idle = check_idle(database, *machine, run.machine); !idle) return idle;
    }
    auto inserted = insert_run(database, run, {*machine, *program});
    return inserted ? add_run_end(database, run.id) : inserted;
  });
}

Result<Run> RunRepository::find(const std::string& id) {
  return connections_.read([&](sql::Database& database) { return find_run(database, id); });
}

namespace {

std::string select_filtered(const RunFilter& filter) {
  std::string sql = kSelectRun + "WHERE true ";  // few texts, so that each is prepared once
  if (filter.machine) sql += "AND machine.name = ?1 ";
  if (filter.program) sql += "AND program.name = ?2 ";
  if (filter.state) sql += "AND run.state = ?3 ";
  if (filter.setup) sql += "AND run.setup = ?4 ";
  if (filter.with_outputs) sql += "AND run.outputs > 0 ";
  return sql +
         "AND (?1 IS NULL OR true) AND (?2 IS NULL OR true) AND (?3 IS NULL OR true) AND (?4 IS "
         "NULL OR "
         "true) ";
}

std::optional<std::string> state_of(const RunFilter& filter) {
  if (!filter.state) return std::nullopt;
  return std::string(to_string(*filter.state));
}

}  // namespace

Result<std::uint64_t> RunRepository::count(const RunFilter& filter) {
  const std::string sql = "SELECT count(*) FROM (" + select_filtered(filter) + ") AS runs";
  const auto state = state_of(filter);
  const auto found = connections_.read([&](sql::Database& database) {
    return sql::first_row(
        database, sql, [](const sql::Statement& row) { return row.number(0); }, filter.machine,
        filter.program, state, filter.setup);
  });
  if (!found) return fail(found.error());
  return found->value_or(0);
}

Result<std::vector<Run>> RunRepository::list(const RunFilter& filter, Page page) {
  const std::string sql = select_filtered(filter) + "ORDER BY run.number DESC LIMIT ?5 OFFSET ?6";
  const auto state = state_of(filter);
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, sql, read_run, filter.machine, filter.program, state,
                         filter.setup, page.limit, page.offset);
  });
}

Result<void> RunRepository::set_state(const std::string& id, RunState state,
                                      const std::string& reason) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto run = find_run(database, id);
    if (!run) return fail(run.error());
    if (run->state == state) return {};
    if (is_finished(run->state) || state == RunState::Ordered) {
      return fail(Errc::Conflict, "run {} is {} and cannot become {}", id, to_string(run->state),
                  to_string(state));
    }
    if (state == RunState::Active) {
      return sql::run(database,
                      "UPDATE run SET state = 'active', started_us = max(?2, created_us) "
                      "WHERE id = ?1 AND state = 'ordered'",
                      id, clock_.now());
    }
    const auto ended =
        sql::run(database,
                 "UPDATE run SET state = ?2, reason = ?3, "
                 "ended_us = max(?4, coalesce(started_us, created_us)) WHERE id = ?1",
                 id, to_string(state), reason, clock_.now());
    return ended ? add_run_end(database, id) : ended;
  });
}

namespace {

Result<void> write_counters(sql::Database& database, const RunProgress& progress) {
  const auto updated = sql::run(
      database,
      "UPDATE run SET line = CASE WHEN ?4 >= executed THEN ?5 ELSE line END, "
      "sequence = CASE WHEN ?4 >= executed THEN ?6 ELSE sequence END, sent = max(sent, ?2), "
      "accepted = max(accepted, ?3), executed = max(executed, ?4) "
      "WHERE id = ?1 AND machine = (SELECT id FROM machine WHERE name = ?7) "
      "AND state IN ('ordered', 'active')",
      progress.run, progress.counters.sent, progress.counters.accepted, progress.counters.executed,
      progress.line, progress.sequence, progress.machine);
  if (!updated || database.changes() > 0) return updated;
  const auto run = find_run(database, progress.run);  // ended: ignored
  if (!run) return fail(run.error());
  if (run->machine == progress.machine) return {};
  return fail(Errc::Conflict, "run {} is machine {}'s, not {}'s", run->id, run->machine,
              progress.machine);
}

}  // namespace

// Every few seconds for each machine, and repeated by the next status: not worth a disk flush.
Result<void> RunRepository::update_counters(const RunProgress& progress) {
  return connections_.write(
      [&](sql::Database& database) { return write_counters(database, progress); },
      Durability::Normal);
}

/// One that fails has changed nothing, and does not undo the others.
std::vector<Result<void>> RunRepository::update_all_counters(
    const std::vector<RunProgress>& progresses) {
  std::vector<Result<void>> updated;
  const auto written = connections_.write(
      [&](sql::Database& database) -> Result<void> {
        updated.clear();
        for (const auto& progress : progresses)
          updated.push_back(write_counters(database, progress));
        return {};
      },
      Durability::Normal);
  if (!written) updated.assign(progresses.size(), fail(written.error()));
  return updated;
}

namespace {

RunCall read_call(const sql::Statement& row) {
  return {row.text(0), row.text(1), row.number(2), read_digest(row, 3)};
}

Result<std::vector<RunCall>> calls_of(sql::Database& database, const std::string& run) {
  return sql::all_rows(
      database,
      "SELECT run_call.name, program.name, run_call.revision, run_call.sha256 FROM run_call "
      "JOIN run ON run.number = run_call.run JOIN program ON program.id = run_call.program "
      "WHERE run.id = ?1 ORDER BY run_call.name",
      read_call, run);
}

}  // namespace

Result<void> RunRepository::add_call(const std::string& id, const RunCall& call) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto run = find_run(database, id);
    if (!run) return fail(run.error());
    const auto calls = calls_of(database, id);
    if (!calls) return fail(calls.error());
    const auto known = std::ranges::find(*calls, call.name, &RunCall::name);
    if (known != calls->end()) {
      if (*known == call) return {};
      return fail(Errc::Conflict, "run {}: '{}' is {} revision {}, not {} revision {}", id,
                  call.name, known->program, known->revision, call.program, call.revision);
    }
    if (is_finished(run->state))
      return fail(Errc::Conflict, "run {} is {}: it calls nothing", id, to_string(run->state));
    if (calls->size() >= RunCall::kMax) {
      return fail(Errc::LimitExceeded, "run {} calls more than {} programs", id, RunCall::kMax);
    }
    const auto added = sql::run(
        database,
        "INSERT INTO run_call (run, name, program, revision, sha256) SELECT run.number, ?2, "
        "program.id, ?4, ?5 FROM run, program WHERE run.id = ?1 AND program.name = ?3",
        id, call.name, call.program, call.revision, std::span<const std::byte>(call.content.bytes));
    if (!added || database.changes() > 0) return added;
    return fail(Errc::NotFound, "program {} is not in the library", call.program);
  });
}

Result<std::vector<RunCall>> RunRepository::calls(const std::string& run) {
  return connections_.read([&](sql::Database& database) { return calls_of(database, run); });
}

Result<void> apply_beginning(sql::Database& database, std::int64_t machine,
                             const RunBeginning& beginning) {
  const auto begun = sql::run(database,
                              "UPDATE run SET state = 'active', started_us = max(?2, created_us) "
                              "WHERE id = ?1 AND machine = ?3 AND state = 'ordered'",
                              beginning.run, beginning.started, machine);
  if (!begun || !beginning.gateway_setup) return begun;
  return sql::run(database,
                  "UPDATE run SET gateway_setup = ?2 "
                  "WHERE id = ?1 AND machine = ?3 AND state = 'active'",
                  beginning.run, *beginning.gateway_setup, machine);
}

Result<void> apply_ending(sql::Database& database, std::int64_t machine, const RunEnding& ending) {
  if (!is_finished(ending.state)) {
    return fail(Errc::Syntax, "run {}: {} is not an end", ending.run, to_string(ending.state));
  }
  const auto& statistics = ending.statistics;
  const auto ended = sql::run(
      database,
      "UPDATE run SET state = ?2, sent = max(sent, ?3), accepted = max(accepted, ?4), "
      "executed = max(executed, ?5), line = ?6, sequence = ?7, reason = ?8, "
      "executed_content = ?9, content_verified = ?10, motion_seconds = ?13, path_mm = ?14, "
      "ended_us = max(?11, coalesce(started_us, created_us)) "
      "WHERE id = ?1 AND machine = ?12 AND state IN ('ordered', 'active')",
      ending.run, to_string(ending.state), ending.counters.sent, ending.counters.accepted,
      ending.counters.executed, ending.line, ending.sequence, ending.reason,
      ending.executed_content, ending.content_verified, ending.ended, machine,
      statistics ? std::optional(statistics->motion_seconds) : std::nullopt,
      statistics ? std::optional(statistics->path_mm) : std::nullopt);
  if (!ended || database.changes() == 0) return ended;
  return add_run_end(database, ending.run);
}

Result<void> add_outputs(sql::Database& database, std::int64_t machine, const NewOutputs& outputs) {
  return sql::run(database, "UPDATE run SET outputs = outputs + ?2 WHERE id = ?1 AND machine = ?3",
                  outputs.run, outputs.count, machine);
}

}  // namespace dripline::storage
