#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "clients/tools/post/target.hpp"

namespace dripline::post {

/// Coordinates as a target's words count them, absolute: rounded from the machine's position each
/// time, so that no error adds up.
class Grid {
 public:
  using Values = std::array<double, interpreter::kAxisCount>;

  /// `shift`: program coordinate of the machine's zero, millimeters and degrees.
  Grid(const Target& target, interpreter::Units units, const Values& shift = {});

  const Target& target() const { return *target_; }
  interpreter::Units units() const { return units_; }
  int decimals() const { return range_of(target_->coordinate, units_).decimals; }

  /// Of the word of that axis: a diameter is twice a radius.
  std::int64_t counts(interpreter::Axis axis, double machine) const;
  double machine(interpreter::Axis axis, std::int64_t counts) const;
  /// Millimeters or degrees of the machine.
  double step(interpreter::Axis axis) const { return step_[static_cast<std::size_t>(axis)]; }
  /// Millimeters of one count of an arc's center: a radius on a lathe, too.
  double center_step() const { return center_step_; }
  bool is_in_range(std::int64_t counts) const;

 private:
  const Target* target_;
  interpreter::Units units_;
  Values shift_, step_{};
  double center_step_ = 0;
};

/// The lead that the target's word has, of the thread between two points rounded to the grid; and
/// the lead of the path that a word has.
Length lead_word(const Grid& grid, const interpreter::Position& from,
                 const interpreter::Position& to, Length lead_of_path);
Length lead_of_path(const Grid& grid, const interpreter::Position& from,
                    const interpreter::Position& to, Length lead_word);

/// How a number looks.
struct NumberLook {
  bool has_point = false;  ///< a whole number ends with a point
  bool has_plus = false;
  char point = '.';
};

/// Appends `counts` / 10^`decimals`, without zeros at its end.
void append_number(std::string& out, std::int64_t counts, int decimals, NumberLook look = {});

/// A value in counts of 10^-`decimals`; nearest.
std::int64_t counts_of(double value, int decimals);
double value_of(std::int64_t counts, int decimals);

}  // namespace dripline::post
