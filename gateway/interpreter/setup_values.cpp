#include "gateway/interpreter/setup_values.hpp"

#include <algorithm>
#include <array>

#include "gateway/interpreter/core/dialects.hpp"

namespace dripline::interpreter {
namespace {

/// `length` and `Z` are two names of one value.
constexpr std::array<std::string_view, 7> kLathe{"X",      "Z",      "length",     "radius",
                                                 "wear.X", "wear.Z", "wear.radius"};
constexpr std::array<std::string_view, 5> kMill{"length", "Z", "radius", "wear.Z", "wear.radius"};
/// The tool store of a TNC 151/155 has L and R alone.
constexpr std::array<std::string_view, 3> kTnc{"length", "Z", "radius"};

struct Row {
  const Dialect& dialect;
  SetupValues values;
};

}  // namespace

SetupValues setup_values(std::string_view control) {
  const std::array rows{
      Row{kCenturionDialect, {.tool = kLathe}}, Row{kFanucDialect, {.tool = kMill}},
      Row{kFanucLatheDialect, {.tool = kLathe}},
      // The tool table of LinuxCNC has lengths along all axes.
      Row{kRs274NgcDialect, {.tool = kLathe}}, Row{kTnc155Dialect, {.tool = kTnc}}};
  const auto found =
      std::ranges::find_if(rows, [&](const Row& row) { return row.dialect.name == control; });
  if (found != rows.end()) return found->values;
  return {.tool = {}, .has_offsets = false, .has_variables = false};
}

}  // namespace dripline::interpreter
