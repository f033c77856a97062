#pragma once

#include "clients/tools/measurement_files/source.hpp"

namespace dripline::measurement_files {

struct PartReportHead {
  std::string title = "Measurement report";
  std::string note;  ///< below the title: who made it, of what; may be empty
};

/// A page for each workpiece: what was measured against what it has to be, and the verdict. One
/// HTML file without anything from outside; its style sheet has rules for paper. Errors:
/// LimitExceeded (no measurement), those of source and sink.
Result<void> write_part_report(MeasurementSource& source, const PartReportHead& head,
                               const Sink& sink);

}  // namespace dripline::measurement_files
