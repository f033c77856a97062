#include "gateway/interpreter/position_rules.hpp"

#include <algorithm>
#include <array>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/positions.hpp"

namespace dripline::interpreter {

const PositionRules& position_rules(std::string_view control) {
  static constexpr PositionRules kNone{};
  struct Row {
    const Dialect& dialect;
    const PositionRules& rules;
  };
  const std::array rows{
      Row{kFanucDialect, kFanucPosition},         Row{kFanucLatheDialect, kFanucLathePosition},
      Row{kCenturionDialect, kCenturionPosition}, Row{kRs274NgcDialect, kRs274NgcPosition},
      Row{kTnc155Dialect, kTncPosition},          Row{kItncDialect, kTncPosition}};
  const auto found =
      std::ranges::find_if(rows, [&](const Row& row) { return row.dialect.name == control; });
  return found != rows.end() ? found->rules : kNone;
}

}  // namespace dripline::interpreter
