#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/offsets/offset_rule.hpp"

namespace dripline::offsets {

/// A measured deviation from the nominal, in the unit of the setup's file.
struct Deviation {
  std::uint64_t measurement = 0;  ///< its id
  double value = 0;
};

/// What follows from deviations, with reasons in words in both cases.
struct Outcome {
  std::vector<std::string> reasons;
  std::size_t used = 0, left_out = 0;
  double mean = 0;
  std::uint64_t first = 0, last = 0;  ///< measurements that were used
  std::optional<double> new_value;    ///< absent: the value is left alone
  bool is_within_policy = false;      ///< may be applied without a person
};

/// `deviations`: measured under `value`, the value in force, oldest first, in `unit`. Pure.
/// Deviations that are not finite are left out. A step that had to be limited is for a person.
Outcome propose(std::span<const Deviation> deviations, double value, const OffsetRule& rule,
                std::string_view unit = {});

/// Whether a step is within a limit, but for the rounding of binary numbers.
bool is_at_most(double step, double limit);

}  // namespace dripline::offsets
