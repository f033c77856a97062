#pragma once

#include <functional>
#include <string>

#include "clients/cli/context.hpp"
#include "clients/tools/chart_images/chart_images.hpp"
#include "clients/tools/charts/measurement_chart.hpp"

namespace dripline::cli {

struct PictureOutput {
  std::string path;  ///< its suffix decides: .svg, .png or .pdf; "-": SVG to standard output
  double scale = 1;
};

/// -o and --scale.
void add_picture_output(Command command, PictureOutput& output);

/// Draws and writes; gives the exit status.
int write_picture(const PictureOutput& output, const charts::ChartRequest& request,
                  const chart_images::Drawing& draw);

}  // namespace dripline::cli
