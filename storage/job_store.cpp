#include "storage/job_store.hpp"

#include <array>

namespace dripline::storage {

std::string_view to_string(JobState state) {
  constexpr std::array<std::string_view, 4> kStates{"waiting", "active", "done", "removed"};
  return kStates.at(static_cast<std::size_t>(state));
}

}  // namespace dripline::storage
