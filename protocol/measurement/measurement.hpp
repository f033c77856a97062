#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

/// Measured values as the store, the server, the statistics and the clients share them. Pure; any
/// thread.
namespace dripline::measurement {

/// Of a measurement, or of a part: the order is from best to worst, see `worse`.
enum class Verdict : std::uint8_t {
  Good,
  Unknown,  ///< no limits, or something is missing
  Rework,   ///< outside its limits on the side where material is left
  Scrap,
};
std::string_view to_string(Verdict verdict);  ///< good, unknown, rework, scrap
/// Errors: Syntax.
Result<Verdict> parse_verdict(std::string_view text);
inline Verdict worse(Verdict a, Verdict b) {
  return a < b ? b : a;
}

/// On which side of its limits a part can be worked on again.
enum class ReworkSide : std::uint8_t { None, Below, Above, Both };

/// What is measured. Numbers are in `unit`; limits are absolute values, not deviations.
struct Characteristic {
  std::string name;  ///< identifies it on its machine
  std::optional<double> nominal;
  std::optional<double> lower, upper;  ///< still good; absent: not limited on that side
  std::string unit = "mm";             ///< mm, inch, deg, ... as the report has it
  std::uint8_t decimals = 3;           ///< that the report has
  friend bool operator==(const Characteristic&, const Characteristic&) = default;
};

/// Good within the limits (both ends are good), Unknown without any. A value that is not finite is
/// Unknown.
Verdict judge(const Characteristic& characteristic, double actual, ReworkSide rework);

/// The record that reported it, identified for ever together with its machine.
struct RecordKey {
  std::uint64_t epoch = 0, number = 0;
  friend auto operator<=>(const RecordKey&, const RecordKey&) = default;
};

/// One actual value.
struct Measurement {
  std::uint64_t id = 0;  ///< rises in the order in which they were stored; 0: not stored
  std::string machine;
  std::string run;      ///< empty: outside any run
  std::string program;  ///< empty: outside any run, or not known
  std::uint64_t revision = 0;
  std::uint64_t block = 0, line = 0;  ///< that reported it
  std::uint64_t part_id = 0;          ///< of the Part it belongs to; 0: not stored
  std::string part;                   ///< number of the part, as reported; may be empty
  std::string serial;                 ///< of the workpiece, as reported; may be empty
  std::string tool;                   ///< that cut it: T3, ...; may be empty
  Characteristic characteristic;
  double actual = 0;
  UtcTime time{};  ///< at the machine
  RecordKey record;
  std::uint32_t item = 0;  ///< of the record's measurements, from 0
  Verdict verdict = Verdict::Unknown;
};

/// Limits and nominal values that differ by less than this part of them are the same: they were
/// computed in different ways.
inline constexpr double kSameLimit = 1e-12;
enum class Limits : std::uint8_t {
  All,      ///< nominal value and both limits
  Lower,    ///< nominal value and lower limit
  Upper,    ///< nominal value and upper limit
  Nominal,  ///< the nominal value alone
};
/// `D40: nominal 40, 39.95 to 40.05`, at most ten digits of each.
std::string limits_text(const Characteristic& characteristic);
/// Whether all, which are of one characteristic, had to be the same: what is judged by limits that
/// most of it did not have says nothing. Errors: Conflict, with both and since when.
Result<void> check_one_tolerance(std::span<const Measurement> all, Limits which);

/// actual - nominal; nullopt without a nominal.
inline std::optional<double> deviation(const Measurement& measurement) {
  if (!measurement.characteristic.nominal) return std::nullopt;
  return measurement.actual - *measurement.characteristic.nominal;
}

}  // namespace dripline::measurement
