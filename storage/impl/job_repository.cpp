#include "storage/impl/job_repository.hpp"

#include <algorithm>

#include "storage/impl/audit_repository.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

/// Each job with what its runs say; `verdicts`: what was measured of them, which takes a time in
/// proportion to the runs.
std::string select_with(const std::string& verdicts) {
  return "SELECT * FROM (SELECT job.id, machine.name AS machine, program.name, job.revision, "
         "job.quantity, job.parts_per_run, job.comment, job.author, job.created_us, "
         "job.removed_us, job.position, c.made AS completed, "
         "(SELECT count(*) FROM run WHERE run.job = job.id AND run.state <> 'refused') AS runs, "
         "EXISTS (SELECT 1 FROM run WHERE run.job = job.id AND run.state IN ('ordered', "
         "'active')) AS is_active, job.counts, CASE WHEN job.counts = 'good' THEN c.good ELSE "
         "c.made "
         "END AS counted, " +
         verdicts +
         " FROM job JOIN job_count AS c ON c.job = job.id JOIN machine ON machine.id = "
         "job.machine JOIN program ON program.id = job.program) AS jobs ";
}

std::string sum_of_runs(const char* parts, const char* runs) {
  return fmt::format(
      "(SELECT coalesce(sum(min({}, job.parts_per_run)), 0) FROM run_verdicts AS v WHERE v.job = "
      "job.id AND v.state {})",
      parts, runs);
}

// A condition follows.
const std::string kSelectJob = select_with("0, 0, 0, 0");
const std::string kSelectShown =
    select_with("c.good, " + sum_of_runs("v.rework", "<> 'refused'") + ", " +
                sum_of_runs("v.scrap", "<> 'refused'") + ", " +
                sum_of_runs("v.good + v.rework + v.scrap", "= 'completed'"));
const std::string kOpen = "removed_us IS NULL AND (counted < quantity OR is_active) ";
const std::string kInOrder = "ORDER BY position, id ";

Job read_job(const sql::Statement& row) {
  Job job;
  job.id = row.number(0);
  job.machine = row.text(1);
  job.program = row.text(2);
  if (const auto revision = row.optional_integer(3))
    job.revision = static_cast<std::uint64_t>(*revision);
  job.quantity = row.number(4);
  job.parts_per_run = row.number(5);
  job.comment = row.text(6);
  job.author = row.text(7);
  job.created = row.time(8);
  job.completed = row.number(11);
  job.runs = row.number(12);
  job.counts = row.text(14) == "good" ? JobCount::Good : JobCount::Made;
  job.counted = row.number(15);
  job.good = row.number(16);
  job.rework = row.number(17);
  job.scrap = row.number(18);
  job.unknown = job.completed - std::min(job.completed, row.number(19));
  if (row.optional_time(9)) {
    job.state = JobState::Removed;
  } else if (row.integer(13) != 0) {
    job.state = JobState::Active;
  } else if (job.counted >= job.quantity) {
    job.state = JobState::Done;
  }
  return job;
}

Result<Job> one_job(std::uint64_t id, Result<std::optional<Job>> job) {
  if (!job) return fail(job.error());
  if (!*job) return fail(Errc::NotFound, "job {} is not known", id);
  return std::move(**job);
}

Result<Job> find_job(sql::Database& database, std::uint64_t id) {
  static const std::string kSql = kSelectJob + "WHERE id = ?1";
  return one_job(id, sql::first_row(database, kSql, read_job, id));
}

const std::string kOpenOfMachine =
    "WHERE machine = ?1 AND " + kOpen + kInOrder + "LIMIT ?2 OFFSET ?3";

Result<std::vector<Job>> open_jobs(sql::Database& database, const std::string& machine, Page page) {
  static const std::string kSql = kSelectJob + kOpenOfMachine;
  return sql::all_rows(database, kSql, read_job, machine, page.limit, page.offset);
}

Result<void> check_open(const Job& job) {
  if (job.state != JobState::Done && job.state != JobState::Removed) return {};
  return fail(Errc::Conflict, "job {} is {}", job.id, to_string(job.state));
}

/// Numbers the open jobs again, with `job` at `place`.
Result<void> put_at(sql::Database& database, const Job& job, std::uint64_t place) {
  auto jobs = open_jobs(database, job.machine, {.limit = JobStore::kMaxJobs + 1});
  if (!jobs) return fail(jobs.error());
  const auto own = std::ranges::find(*jobs, job.id, &Job::id);
  if (own != jobs->end()) jobs->erase(own);
  const auto at = std::min<std::size_t>(place == 0 ? 0 : place - 1, jobs->size());
  jobs->insert(jobs->begin() + static_cast<std::ptrdiff_t>(at), job);
  std::int64_t position = 0;
  for (const Job& next : *jobs) {
    auto set =
        sql::run(database, "UPDATE job SET position = ?2 WHERE id = ?1", next.id, ++position);
    if (!set) return set;
  }
  return {};
}

std::string words_of(const Job& job) {
  return fmt::format("job {}: {}{}, {} {}parts", job.id, job.program,
                     job.revision ? fmt::format(" revision {}", *job.revision) : "", job.quantity,
                     job.counts == JobCount::Good ? "good " : "");
}

const std::string kSelectHold =
    "SELECT machine.name, who, reason, since_us FROM job_hold JOIN machine ON machine.id = "
    "job_hold.machine ";

JobHold read_hold(const sql::Statement& row) {
  return {row.text(0), row.text(1), row.text(2), row.time(3)};
}

Result<std::optional<JobHold>> find_hold(sql::Database& database, const std::string& machine) {
  static const std::string kSql = kSelectHold + "WHERE machine.name = ?1";
  return sql::first_row(database, kSql, read_hold, machine);
}

}  // namespace

Result<void> check_job(sql::Database& database, const Run& run) {
  if (!run.job) return {};
  const auto job = find_job(database, *run.job);
  if (!job) return fail(job.error());
  if (job->machine != run.machine || job->program != run.program ||
      (job->revision && *job->revision != run.revision)) {
    return fail(Errc::Conflict, "job {} is {} on {}, and not {} revision {} on {}", job->id,
                job->program, job->machine, run.program, run.revision, run.machine);
  }
  if (auto open = check_open(*job); !open) return open;
  if (job->counted >= job->quantity) {
    return fail(Errc::Conflict, "job {} has all its {} {}parts", job->id, job->quantity,
                job->counts == JobCount::Good ? "good " : "");
  }
  const auto held = find_hold(database, run.machine);
  if (!held) return fail(held.error());
  if (!*held) return {};
  return fail(Errc::Conflict, "the jobs of machine {} are held by {}: {}", run.machine,
              (*held)->who, (*held)->reason);
}

Result<std::vector<Job>> JobRepository::list(const std::string& machine, bool is_open, Page page) {
  static const std::string kClosed = kSelectShown + "WHERE machine = ?1 AND NOT (" + kOpen +
                                     ") ORDER BY id DESC LIMIT ?2 OFFSET ?3";
  static const std::string kOpenShown = kSelectShown + kOpenOfMachine;
  return connections_.read([&](sql::Database& database) {
    return sql::all_rows(database, is_open ? kOpenShown : kClosed, read_job, machine, page.limit,
                         page.offset);
  });
}

Result<Job> JobRepository::find(std::uint64_t id) {
  static const std::string kSql = kSelectShown + "WHERE id = ?1";
  return connections_.read([&](sql::Database& database) {
    return one_job(id, sql::first_row(database, kSql, read_job, id));
  });
}

Result<Job> JobRepository::add(const Job& job, const Actor& who,
                               std::optional<std::uint64_t> place) {
  return connections_.write([&](sql::Database& database) -> Result<Job> {
    const auto machine = known_machine(database, job.machine);
    if (!machine) return fail(machine.error());
    const auto revision = find_revision(database, job.program, job.revision);
    if (!revision) return fail(revision.error());
    const auto open = open_jobs(database, job.machine, {.limit = kMaxJobs});
    if (!open) return fail(open.error());
    if (open->size() >= kMaxJobs) {
      return fail(Errc::LimitExceeded, "machine {} has {} jobs, the limit", job.machine, kMaxJobs);
    }
    const auto inserted = sql::insert(
        database,
        "INSERT INTO job (machine, position, program, revision, quantity, parts_per_run, comment, "
        "author, created_us, counts) SELECT ?1, coalesce((SELECT max(position) FROM job WHERE "
        "machine = ?1), 0) + 1, id, ?3, ?4, ?5, ?6, ?7, ?8, ?9 FROM program WHERE name = ?2 "
        "RETURNING id",
        *machine, job.program, job.revision, job.quantity, job.parts_per_run, job.comment,
        job.author, job.created, to_string(job.counts));
    if (!inserted) return fail(inserted.error());
    auto added = find_job(database, static_cast<std::uint64_t>(*inserted));
    if (!added) return added;
    if (place) {
      if (auto put = put_at(database, *added, *place); !put) return fail(put.error());
    }
    auto written =
        add_audit(database, {job.created, who, "job.add", job.machine, words_of(*added)});
    if (!written) return fail(written.error());
    return added;
  });
}

Result<Job> JobRepository::move(std::uint64_t id, std::uint64_t place, const Actor& who,
                                UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<Job> {
    auto job = find_job(database, id);
    if (!job) return job;
    if (auto open = check_open(*job); !open) return fail(open.error());
    if (auto put = put_at(database, *job, place); !put) return fail(put.error());
    auto written = add_audit(database, {time, who, "job.move", job->machine,
                                        fmt::format("{} to place {}", words_of(*job), place)});
    if (!written) return fail(written.error());
    return job;
  });
}

Result<void> JobRepository::remove(std::uint64_t id, const Actor& who, UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto job = find_job(database, id);
    if (!job) return fail(job.error());
    if (auto open = check_open(*job); !open) return open;
    if (job->state == JobState::Active)
      return fail(Errc::Busy, "job {} has a run that has not ended", id);
    auto removed = sql::run(database, "UPDATE job SET removed_us = ?2 WHERE id = ?1", id, time);
    if (!removed) return removed;
    return add_audit(database, {time, who, "job.remove", job->machine, words_of(*job)});
  });
}

Result<std::optional<Job>> JobRepository::next(const std::string& machine) {
  static const std::string kSql =
      kSelectJob + "WHERE machine = ?1 AND removed_us IS NULL AND counted < quantity " + kInOrder +
      "LIMIT 1";
  return connections_.read(
      [&](sql::Database& database) { return sql::first_row(database, kSql, read_job, machine); });
}

Result<void> JobRepository::hold(const JobHold& hold, const Actor& who) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    const auto machine = known_machine(database, hold.machine);
    if (!machine) return fail(machine.error());
    auto held = sql::run(database,
                         "INSERT INTO job_hold (machine, who, reason, since_us) VALUES (?1, ?2, "
                         "?3, ?4) ON CONFLICT (machine) DO UPDATE SET who = excluded.who, "
                         "reason = excluded.reason, since_us = excluded.since_us",
                         *machine, hold.who, hold.reason, hold.since);
    if (!held) return held;
    return add_audit(database, {hold.since, who, "job.hold", hold.machine, hold.reason});
  });
}

Result<void> JobRepository::release(const std::string& machine, const Actor& who, UtcTime time) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto released = sql::run(database,
                             "DELETE FROM job_hold WHERE machine = (SELECT id FROM machine "
                             "WHERE name = ?1)",
                             machine);
    if (!released) return released;
    if (database.changes() == 0)
      return fail(Errc::NotFound, "the jobs of machine {} are not held", machine);
    return add_audit(database, {time, who, "job.release", machine, ""});
  });
}

Result<std::optional<JobHold>> JobRepository::hold_of(const std::string& machine) {
  return connections_.read([&](sql::Database& database) { return find_hold(database, machine); });
}

Result<std::vector<JobHold>> JobRepository::holds() {
  static const std::string kSql = kSelectHold + "ORDER BY machine.name";
  return connections_.read(
      [&](sql::Database& database) { return sql::all_rows(database, kSql, read_hold); });
}

}  // namespace dripline::storage
