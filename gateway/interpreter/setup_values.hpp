#pragma once

#include <span>
#include <string_view>

namespace dripline::interpreter {

/// What of a setup's `[[tool]]`, `[[offset]]` and `[[variable]]` has an effect on a control; the
/// rest is read and changes nothing (deploy/docs/setup-format.md).
struct SetupValues {
  std::span<const std::string_view> tool;  ///< keys, the wear's as "wear.X"
  bool has_offsets = true, has_variables = true;
};

/// By the control's name; one that is not known has nothing.
SetupValues setup_values(std::string_view control);

}  // namespace dripline::interpreter
