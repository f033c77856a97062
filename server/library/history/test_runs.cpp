#include "server/library/history/test_runs.hpp"

#include <string_view>

namespace dripline::library {

/// The texts are the gateway's (run_loop_test_run.cpp, program_check.cpp), for runs that the store
/// does not know as tests: older ones, and those whose switch was turned on at the last moment. A
/// program may write the same in an alarm of its own, but has executed a block then.
bool is_test_run(const storage::Run& run) {
  constexpr std::string_view kEnd = "test run: ", kAlarm = ", found by a test run)";
  if (run.is_test || run.state == storage::RunState::Tested) return true;
  const std::string_view reason = run.reason;
  const bool says_so = reason.starts_with(kEnd) || reason.ends_with(kAlarm);
  return storage::is_finished(run.state) && run.counters.executed == 0 && says_so;
}

}  // namespace dripline::library
