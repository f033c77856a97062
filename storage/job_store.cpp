#include "storage/job_store.hpp"

#include <array>

namespace dripline::storage {

std::string_view to_string(JobState state) {
  constexpr std::array<std::string_view, 4> kStates{"waiting", "active", "done", "removed"};
  return kStates.at(static_cast<std::size_t>(state));
}

std::string_view to_string(JobCount count) {
  return count == JobCount::Good ? "good" : "made";
}

Result<JobCount> parse_job_count(std::string_view text) {
  for (const auto count : {JobCount::Made, JobCount::Good}) {
    if (to_string(count) == text) return count;
  }
  return fail(Errc::Syntax, "counts is '{}': made or good", text);
}

}  // namespace dripline::storage
