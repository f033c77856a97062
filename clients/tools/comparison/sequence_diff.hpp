#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dripline::comparison {

/// Elements of two sequences that are not the same; those between two runs are, in pairs.
struct EditRun {
  std::size_t first = 0, first_count = 0;
  std::size_t second = 0, second_count = 0;
  friend bool operator==(const EditRun&, const EditRun&) = default;
};

/// What has to be taken out of `first` and put in from `second`, in order. The shortest script
/// (E. W. Myers, An O(ND) Difference Algorithm and Its Variations, 1986, the linear-space variant)
/// unless it is longer than some thousand edits: then one that is nearly as short, in time that is
/// proportional to the lengths times their square root. Elements are small numbers: memory is
/// linear in the lengths and in the largest element.
std::vector<EditRun> diff_sequences(std::span<const std::uint32_t> first,
                                    std::span<const std::uint32_t> second);

}  // namespace dripline::comparison
