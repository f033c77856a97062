#include "storage/run_store.hpp"

#include <array>

namespace dripline::storage {
namespace {

struct StateName {
  RunState state;
  std::string_view name;
};
constexpr std::array kStateNames{
    StateName{RunState::Ordered, "ordered"},     StateName{RunState::Active, "active"},
    StateName{RunState::Completed, "completed"}, StateName{RunState::Aborted, "aborted"},
    StateName{RunState::Alarmed, "alarmed"},     StateName{RunState::Interrupted, "interrupted"},
    StateName{RunState::Refused, "refused"},     StateName{RunState::Tested, "tested"},
};

}  // namespace

std::string_view to_string(RunState state) {
  for (const StateName& row : kStateNames) {
    if (row.state == state) return row.name;
  }
  return "unknown";
}

Result<RunState> parse_run_state(std::string_view text) {
  for (const StateName& row : kStateNames) {
    if (row.name == text) return row.state;
  }
  return fail(Errc::Syntax,
              "'{}' is not a run state: ordered, active, completed, aborted, alarmed, interrupted, "
              "refused or tested",
              text);
}

}  // namespace dripline::storage
