#include "server/library/job_queue.hpp"

#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"

namespace dripline::library {
namespace {

using storage::Job;
using storage::JobState;

Result<void> check_number(std::string_view what, std::uint64_t number, std::uint64_t highest) {
  if (number >= 1 && number <= highest) return {};
  return fail(Errc::LimitExceeded, "{} is {}: 1 to {}", what, number, highest);
}

Result<void> check_text(std::string_view what, const std::string& text) {
  if (text.size() <= JobQueue::kMaxText) return {};
  return fail(Errc::LimitExceeded, "{} of {} bytes: at most {}", what, text.size(),
              JobQueue::kMaxText);
}

Result<Job> owned(Result<Job> job, const std::string& machine, std::uint64_t id) {
  if (!job || job->machine == machine) return job;
  return fail(Errc::NotFound, "machine {} has no job {}", machine, id);
}

}  // namespace

std::string_view to_string(JobChange::Kind kind) {
  switch (kind) {
    case JobChange::Kind::Added:
      return "added";
    case JobChange::Kind::Moved:
      return "moved";
    case JobChange::Kind::Removed:
      return "removed";
    case JobChange::Kind::Held:
      return "held";
    case JobChange::Kind::Released:
      return "released";
  }
  return "";
}

Result<Job> take_job(storage::JobStore& jobs, const std::string& machine,
                     std::optional<std::uint64_t> job) {
  const auto hold = jobs.hold_of(machine);
  if (!hold) return fail(hold.error());
  if (*hold) {
    return fail(Errc::Conflict, "the jobs of machine {} are held by {}: {}", machine, (*hold)->who,
                (*hold)->reason);
  }
  if (job) {
    auto chosen = owned(jobs.find(*job), machine, *job);
    if (!chosen) return chosen;
    if (chosen->state == JobState::Waiting || chosen->state == JobState::Active) return chosen;
    return fail(Errc::Conflict, "job {} is {}", *job, to_string(chosen->state));
  }
  auto next = jobs.next(machine);
  if (!next) return fail(next.error());
  if (!*next) return fail(Errc::NotFound, "no job waits for machine {}", machine);
  return std::move(**next);
}

Result<JobQueue::Queue> JobQueue::list(const std::string& machine, bool is_open,
                                       storage::Page page) const {
  if (auto known = parts_.store.machines.find(machine); !known) return fail(known.error());
  auto jobs = parts_.store.jobs.list(machine, is_open, page);
  if (!jobs) return fail(jobs.error());
  auto hold = parts_.store.jobs.hold_of(machine);
  if (!hold) return fail(hold.error());
  return Queue{*std::move(jobs), *std::move(hold)};
}

Result<void> JobQueue::check_fits(const Addition& addition) const {
  const Job& job = addition.job;
  if (auto good = check_number("quantity", job.quantity, kMaxQuantity); !good) return good;
  if (auto good = check_number("parts_per_run", job.parts_per_run, kMaxPartsPerRun); !good)
    return good;
  if (auto good = check_text("comment", job.comment); !good) return good;
  const auto machine = parts_.store.machines.find(job.machine);
  if (!machine) return fail(machine.error());
  const auto admitted = parts_.releases.admit({.machine = job.machine,
                                               .program = job.program,
                                               .revision = job.revision,
                                               .role = addition.role});
  if (!admitted) return fail(admitted.error());
  return library::check_fits(admitted->revision, *machine);
}

Result<Job> JobQueue::add(Addition addition, const storage::Actor& who) {
  if (auto fits = check_fits(addition); !fits) return fail(fits.error());
  addition.job.author = who.name;
  addition.job.created = parts_.clock.now();
  auto added = parts_.store.jobs.add(addition.job, who, addition.place);
  if (added) {
    process::log_info("job {} added machine={} program={} quantity={} by={}", added->id,
                      added->machine, added->program, added->quantity, who.name);
    notify({.kind = JobChange::Kind::Added, .machine = added->machine, .job = *added});
  }
  return added;
}

Result<Job> JobQueue::own(const std::string& machine, std::uint64_t job) const {
  return owned(parts_.store.jobs.find(job), machine, job);
}

Result<Job> JobQueue::move(const std::string& machine, std::uint64_t job, std::uint64_t place,
                           const storage::Actor& who) {
  if (auto good = check_number("place", place, storage::JobStore::kMaxJobs); !good)
    return fail(good.error());
  if (auto known = own(machine, job); !known) return known;
  auto moved = parts_.store.jobs.move(job, place, who, parts_.clock.now());
  if (moved) notify({.kind = JobChange::Kind::Moved, .machine = machine, .job = *moved});
  return moved;
}

Result<void> JobQueue::remove(const std::string& machine, std::uint64_t job,
                              const storage::Actor& who) {
  if (auto known = own(machine, job); !known) return fail(known.error());
  if (auto removed = parts_.store.jobs.remove(job, who, parts_.clock.now()); !removed)
    return removed;
  JobChange change{.kind = JobChange::Kind::Removed, .machine = machine};
  if (auto now = parts_.store.jobs.find(job)) change.job = *std::move(now);
  notify(std::move(change));
  return {};
}

Result<void> JobQueue::hold(const std::string& machine, const std::string& reason,
                            const storage::Actor& who) {
  if (reason.find_first_not_of(" \t\r\n") == std::string::npos)
    return fail(Errc::Syntax, "a hold needs a reason");
  if (auto good = check_text("reason", reason); !good) return good;
  const storage::JobHold hold{
      .machine = machine, .who = who.name, .reason = reason, .since = parts_.clock.now()};
  if (auto held = parts_.store.jobs.hold(hold, who); !held) return held;
  process::log_info("jobs held machine={} by={}: {}", machine, who.name, reason);
  notify({.kind = JobChange::Kind::Held, .machine = machine, .hold = hold});
  return {};
}

Result<void> JobQueue::release(const std::string& machine, const storage::Actor& who) {
  auto released = parts_.store.jobs.release(machine, who, parts_.clock.now());
  if (!released) return released;
  process::log_info("jobs released machine={} by={}", machine, who.name);
  notify({.kind = JobChange::Kind::Released, .machine = machine});
  return released;
}

void JobQueue::notify(JobChange change) const {
  if (parts_.on_change) parts_.on_change(change);
}

Result<Job> JobQueue::take(const std::string& machine, std::optional<std::uint64_t> job) const {
  return take_job(parts_.store.jobs, machine, job);
}

}  // namespace dripline::library
