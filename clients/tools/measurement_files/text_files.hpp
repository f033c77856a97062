#pragma once

#include <optional>

#include "clients/tools/measurement_files/source.hpp"

namespace dripline::measurement_files {

/// RFC 4180: the line of names, and one measurement's. Texts are guarded (protocol/base/csv.hpp);
/// the reader takes the guard off.
std::string_view csv_head();
std::string csv_line(const measurement::Measurement& measurement);
/// Both, of all of them.
Result<void> write_csv(MeasurementSource& source, const Sink& sink);
/// One JSON object a line, with the same names.
Result<void> write_json_lines(MeasurementSource& source, const Sink& sink);

/// One line of write_json_lines; also one element of the server's answer.
std::string json_line(const measurement::Measurement& measurement);
/// Errors: Syntax (no object, no number as `actual`, a value of another kind).
Result<measurement::Measurement> read_json_line(std::string_view line);

inline constexpr std::size_t kMaxLine = 64 * 1024;
inline constexpr std::size_t kMaxColumns = 256;

/// Reads a file in either form, which its first character determines; of CSV any columns in any
/// order, `actual` (or `value`) at least, with comma, semicolon or tab. Empty lines are skipped.
/// Errors: Syntax (with the line), LimitExceeded.
Result<void> read_measurements(std::string_view file, const Visitor& visit);

}  // namespace dripline::measurement_files
