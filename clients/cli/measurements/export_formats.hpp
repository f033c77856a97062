#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/cli/measurements/measurement_input.hpp"

namespace dripline::cli {

/// How measurements are exported.
struct MeasurementExport {
  MeasurementChoice choice;
  std::string format, output;
  std::string title;                 ///< html, pdf; empty: the usual one
  bool is_utf8 = false;              ///< AQDEF
  std::optional<double> cell, base;  ///< stl, mm
  std::string x;                     ///< points: what their X is; empty: radius
};

/// dfq, dfd, dfx, qif, html, pdf, measurements, jsonl, points, dxf, stl.
const std::vector<std::string>& measurement_formats();
/// Gives the exit status.
int export_measurements(Context& context, const MeasurementExport& request);

}  // namespace dripline::cli
