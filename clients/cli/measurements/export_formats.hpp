#pragma once

#include <string>
#include <vector>

#include "clients/cli/measurements/measurement_input.hpp"

namespace dripline::cli {

/// How measurements are exported.
struct MeasurementExport {
  MeasurementChoice choice;
  std::string format, output;
  std::string title = "Measurement report";
  bool is_utf8 = false;  ///< AQDEF
  double cell = 0, base = 5;
  std::string x = "radius";  ///< points: what their X is
};

/// dfq, dfd, dfx, qif, html, pdf, measurements, jsonl, points, dxf, stl.
const std::vector<std::string>& measurement_formats();
/// Gives the exit status.
int export_measurements(Context& context, const MeasurementExport& request);

}  // namespace dripline::cli
