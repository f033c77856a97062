#pragma once

#include "clients/tools/measurement_files/source.hpp"

namespace dripline::measurement_files {

/// QIF 3.0 (ANSI/DMSC QIF 3.0, ISO 23952:2020): a document with the characteristics and, of each
/// workpiece, the measurement results. Characteristics are of the kind "user defined", linear or
/// angular: a report states what was measured, not on which feature. Values keep their units (mm,
/// inch, deg). Machine, program, run, serial and tool are attributes. Errors: Unsupported (a unit
/// that is neither a length nor an angle), LimitExceeded (no measurement, a value that is not
/// finite), those of source and sink.
Result<void> write_qif(MeasurementSource& source, const Sink& sink);

}  // namespace dripline::measurement_files
