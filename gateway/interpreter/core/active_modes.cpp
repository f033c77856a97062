#include "gateway/interpreter/core/active_modes.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace dripline::interpreter {

std::string_view hole_cycle_name(int g_code) {
  using Row = std::pair<int, std::string_view>;
  constexpr std::array kNames{
      Row{73, "peck drill with short retracts"},
      Row{74, "left tap"},
      Row{76, "fine bore"},
      Row{81, "drill"},
      Row{82, "drill with dwell"},
      Row{83, "peck drill"},
      Row{84, "tap"},
      Row{85, "bore"},
      Row{86, "bore with spindle stop"},
      Row{87, "back bore"},
      Row{88, "bore with manual retract"},
      Row{89, "bore with dwell"},
  };
  const auto* row = std::ranges::find(kNames, g_code, &Row::first);
  return row != kNames.end() ? row->second : std::string_view();
}

}  // namespace dripline::interpreter
