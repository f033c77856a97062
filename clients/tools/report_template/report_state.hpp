#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "protocol/measurement/measurement.hpp"

namespace dripline::report_template {

/// A value that was read, with what it must be.
struct Value {
  measurement::Characteristic characteristic;
  double actual = 0;
  std::string tool;
  measurement::Verdict verdict = measurement::Verdict::Unknown;
  friend bool operator==(const Value&, const Value&) = default;
};

/// Numbers of a line as read; which of them are there.
struct LineNumbers {
  std::optional<double> actual, deviation, nominal, lower, upper, tolerance, upper_deviation,
      lower_deviation;
  std::uint8_t decimals = 0;  ///< the most that one has
  friend bool operator==(const LineNumbers&, const LineNumbers&) = default;
};

struct LineNumberRow {
  const char* name;  ///< in forms, and in states
  std::optional<double> LineNumbers::*member;
};
inline constexpr std::array kLineNumbers{
    LineNumberRow{"actual", &LineNumbers::actual},
    LineNumberRow{"deviation", &LineNumbers::deviation},
    LineNumberRow{"nominal", &LineNumbers::nominal},
    LineNumberRow{"lower", &LineNumbers::lower},
    LineNumberRow{"upper", &LineNumbers::upper},
    LineNumberRow{"tolerance", &LineNumbers::tolerance},
    LineNumberRow{"upper_deviation", &LineNumbers::upper_deviation},
    LineNumberRow{"lower_deviation", &LineNumbers::lower_deviation},
};

/// What is known of a part while its lines come.
struct PartSummary {
  std::string number, serial;
  std::uint64_t values = 0, findings = 0;
  measurement::Verdict verdict = measurement::Verdict::Unknown;  ///< of all so far
  friend bool operator==(const PartSummary&, const PartSummary&) = default;
};

/// Where the interpretation of a machine's lines is: all it depends on besides its template.
/// Bounded, whatever comes. As JSON it is kept beside the measurements.
struct ReportState {
  struct Partial {  ///< of a rule with several lines
    std::size_t rule = 0, step = 0;
    std::vector<std::string> texts;  ///< of the lines that came
    friend bool operator==(const Partial&, const Partial&) = default;
  };
  bool is_open = false;  ///< a part is
  PartSummary part;
  std::map<std::string, std::string> context;       ///< texts in force
  LineNumbers pending;                              ///< for the next value
  std::map<std::string, LineNumbers> pending_of;    ///< for the next value of a characteristic
  static constexpr std::size_t kMaxPending = 2048;  ///< no template has more names
  std::optional<Partial> partial;
  std::map<std::size_t, std::uint64_t> ordinals;  ///< how often a rule applied, in this part
  std::set<std::string> seen;                     ///< required characteristics that came
  std::optional<std::int64_t> highest;            ///< count so far
  std::vector<std::pair<std::int64_t, std::int64_t>> missing;  ///< counts below it, from and to
  static constexpr std::size_t kMaxKept = 256;
  std::map<std::int64_t, std::string> kept;  ///< lines by their counts: the highest ones
  std::optional<std::uint64_t> expected;
  std::uint64_t lines = 0;                                  ///< with values
  bool is_judged = false;                                   ///< a value had limits
  measurement::Verdict worst = measurement::Verdict::Good;  ///< of those that had
  bool is_incomplete = false;
  std::string cut;            ///< a line of the part, or before it, that is not whole; shown text
  bool is_after_cut = false;  ///< what comes next may be the rest of it
  bool has_expected = false;  ///< a line stated how many, not the template
  std::string last_end;       ///< the line that ended a part, until another comes
  friend bool operator==(const ReportState&, const ReportState&) = default;
};

std::string to_json(const ReportState& state);
/// Errors: Corrupt.
Result<ReportState> parse_state(std::string_view json);

}  // namespace dripline::report_template
