#pragma once

#include "storage/impl/connections.hpp"
#include "storage/job_store.hpp"
#include "storage/run_store.hpp"

namespace dripline::storage {

/// Whether a run may begin for its job, inside the transaction that creates it. Errors: NotFound,
/// Conflict (of another machine or program, done, removed, or the machine's jobs are held).
Result<void> check_job(sql::Database& database, const Run& run);

class JobRepository final : public JobStore {
 public:
  explicit JobRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<Job>> list(const std::string& machine, bool is_open, Page page) override;
  Result<Job> find(std::uint64_t id) override;
  Result<Job> add(const Job& job, const Actor& who, std::optional<std::uint64_t> place) override;
  Result<Job> move(std::uint64_t id, std::uint64_t place, const Actor& who, UtcTime time) override;
  Result<void> remove(std::uint64_t id, const Actor& who, UtcTime time) override;
  Result<std::optional<Job>> next(const std::string& machine) override;
  Result<void> hold(const JobHold& hold, const Actor& who) override;
  Result<void> release(const std::string& machine, const Actor& who, UtcTime time) override;
  Result<std::optional<JobHold>> hold_of(const std::string& machine) override;
  Result<std::vector<JobHold>> holds() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
