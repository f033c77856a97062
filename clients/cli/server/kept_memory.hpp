#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/lib/api_types.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// The memory that a machine's control keeps after a program, as its gateway reports it at the end
/// of a run.
struct KeptCell {
  std::optional<double> value;  ///< none: vacant
  std::optional<double> base;   ///< what the setup gave it
  friend bool operator==(const KeptCell&, const KeptCell&) = default;
};
using KeptMemory = std::map<std::string, KeptCell>;

KeptMemory cells_of(const client::Memory& memory);

/// `name` matches when it holds `filter`, or all of it when that is empty.
KeptMemory filtered(const KeptMemory& memory, std::string_view filter);

/// A setup that gives these cells as variables, over those it has of the same names; comments and
/// layout stay. Errors: Syntax (no TOML; `variable` written as one list).
Result<std::string> with_variables(std::string_view setup,
                                   const std::map<std::string, double>& variables);

}  // namespace dripline::cli
