#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::tektronix1704 {

inline constexpr std::size_t kAxes = 3;  // X, Y, Z

/// How the control counts (manual: numbers and units).
enum class UnitSet : std::uint8_t {
  Inch,     ///< 0.0001 inch, F in 0.1 inch per minute
  Option1,  ///< 0.0002 inch
  Option2,  ///< 0.001 inch, F in inch per minute
  Metric,   ///< 0.001 mm, F in mm per minute
};

/// What a fixed cycle does between R and R (manual: fixed cycles).
enum class CycleStep : std::uint8_t {
  FeedIn,
  PeckIn,
  Dwell,
  SpindleStop,
  SpindleReverse,
  ProgramStop,
  FeedOut,
  RapidOut,
  ManualOut,  ///< the operator retracts; taken to be at R afterwards
};
using CycleSteps = std::vector<CycleStep>;

struct AxisLimits {
  std::optional<std::int64_t> low, high;  ///< counts, machine
};

/// How the unit was built and what its operator has set: the `[control]` options.
struct ControlOptions {
  std::size_t axes = 3;
  UnitSet units = UnitSet::Inch;
  bool has_arcs = true, has_cycles = true, has_dwell = true, has_quill = false;
  bool has_spindle_speed = false, has_tool_codes = false, has_tool_changer = false, has_mist = true;
  bool is_strict = false;         ///< what the manual forbids stops the tape
  bool skips_bad_blocks = false;  ///< a block that does not read is reported and left out
  bool runs_bad_arcs = false;     ///< arcs off their circle or quadrant are swept to the end's ray
  bool option1_feed_is_doubled = false;
  bool cycle_z_moves_with_xy = false;
  bool m05_is_delayed = true, m09_is_delayed = true, m05_stops_coolant = true;
  bool checks_reader = false;
  double reader_characters_per_second = 300;
  std::int64_t arc_tolerance = 5;                        ///< counts
  double max_feed = 200.0, min_feed = 0.1, rapid = 400;  ///< per minute, in the control's unit
  double dwell_seconds = 1.3, peck_seconds = 1.3;        ///< panel selectors
  std::array<CycleSteps, 10> cycles;                     ///< G80 to G89
  std::array<AxisLimits, kAxes> travel;
  std::array<double, 100> spindle_speed{};  ///< revolutions per minute of each S code
  std::array<std::string, 100> m_names;     ///< of the machine builder's M functions
  std::vector<std::string> mdi;             ///< blocks keyed in before the tape starts
  std::optional<int> search;                ///< sequence number to run the tape forward to
  bool stops_at_search = false;             ///< and the operator is asked there
  std::uint32_t part = 1;                   ///< program of the tape that the start reads
  bool optional_stop = false;
  bool is_mdi = false;  ///< Setup::is_mdi: no leader, and no end code
  std::array<bool, kAxes> mirror{};
  std::array<std::int64_t, kAxes> start{}, zero{};  ///< machine counts

  bool is_metric() const { return units == UnitSet::Metric; }
  double mm_per_count() const;
  /// Of one count of F, per minute, in the control's unit (inch or mm).
  double feed_per_count() const {
    return units == UnitSet::Inch || units == UnitSet::Option1 ? 0.1 : 1;
  }
  Length length(double in_unit) const {
    return is_metric() ? Length::mm(in_unit) : Length::inch(in_unit);
  }
};

/// Errors: Syntax, Unsupported, naming the option.
Result<ControlOptions> read_options(const Setup& setup);

/// The rows of its options, for people.
std::vector<ListedOption> list_options();

}  // namespace dripline::interpreter::tektronix1704
