#include "server/machines/program_fetcher.hpp"

#include "protocol/process/log.hpp"

namespace dripline::machines {

Result<void> ProgramFetcher::begin() {
  for (const auto state : {storage::RunState::Ordered, storage::RunState::Active}) {
    constexpr std::uint64_t kPage = 500;
    for (std::uint64_t offset = 0;; offset += kPage) {
      storage::RunFilter filter;
      filter.state = state;
      const auto runs = store_.runs.list(filter, {.limit = kPage, .offset = offset});
      if (!runs) return fail(runs.error());
      for (const auto& run : *runs) note(run);
      if (runs->size() < kPage) break;
    }
  }
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  return {};
}

void ProgramFetcher::end() {
  worker_.request_stop();
  if (worker_.joinable()) worker_.join();
}

void ProgramFetcher::note(const storage::Run& run) {
  {
    const std::lock_guard lock(mutex_);
    if (storage::is_finished(run.state)) {
      const auto known = bytes_of_.find(run.id);
      if (known == bytes_of_.end()) return;
      bytes_ -= known->second;
      bytes_of_.erase(known);
      return;  // its jobs end when they are next
    }
    if (!bytes_of_.try_emplace(run.id, 0).second) return;
  }
  put({.run = run.id, .content = run.content});
  put({.run = run.id, .approval = run.approval});
}

void ProgramFetcher::add(const std::string& run, const Digest& content) {
  put({.run = run, .content = content});
}

void ProgramFetcher::put(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (!bytes_of_.contains(job.run) || jobs_.size() >= kMostJobs) return;
    jobs_.push_back(std::move(job));
  }
  changed_.notify_one();
}

std::optional<ProgramFetcher::Job> ProgramFetcher::take(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait(lock, stop, [this] { return !jobs_.empty(); })) return std::nullopt;
  Job job = std::move(jobs_.front());
  jobs_.pop_front();
  return job;
}

void ProgramFetcher::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    auto job = take(stop);
    if (!job) return;
    const Outcome outcome = advance(*job);
    if (outcome != Outcome::Done) put(*std::move(job));
    if (outcome != Outcome::Away) continue;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, kAwayPause, [] { return false; });
  }
}

ProgramFetcher::Outcome ProgramFetcher::advance(Job& job) {
  if (!count(job.run, 0)) return Outcome::Done;
  return job.content ? fetch_chunk(job) : look_for_called(job);
}

ProgramFetcher::Outcome ProgramFetcher::look_for_called(const Job& job) {
  const auto calls = store_.runs.calls(job.run);
  if (!calls) return outcome_of(job, calls.error());
  std::vector<storage::Revision> pinned;
  if (job.approval) {
    auto found = store_.releases.pinned(*job.approval);
    if (!found) return outcome_of(job, found.error());
    pinned = *std::move(found);
  }
  for (const auto& call : *calls) add(job.run, call.content);
  for (const auto& revision : pinned) add(job.run, revision.content);
  return Outcome::Done;
}

ProgramFetcher::Outcome ProgramFetcher::fetch_chunk(Job& job) {
  const auto fetched = store_.programs.fetch_ahead(*job.content, job.position);
  if (!fetched) return outcome_of(job, fetched.error());
  if (fetched->is_end || fetched->bytes == 0) return Outcome::Done;
  ++job.position;
  return count(job.run, fetched->bytes) ? Outcome::GoesOn : Outcome::Done;
}

ProgramFetcher::Outcome ProgramFetcher::outcome_of(const Job& job, const Error& error) {
  if (error.code != Errc::Corrupt && error.code != Errc::NotFound) return Outcome::Away;
  process::log_warning("program not fetched ahead run={}: {}", job.run, error.what);
  return Outcome::Done;
}

bool ProgramFetcher::count(const std::string& run, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  const auto known = bytes_of_.find(run);
  if (known == bytes_of_.end()) return false;
  known->second += bytes;
  bytes_ += bytes;
  return bytes_ < room_;
}

}  // namespace dripline::machines
