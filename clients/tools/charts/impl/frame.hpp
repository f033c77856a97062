#pragma once

#include <string>
#include <vector>

#include "clients/tools/charts/axis.hpp"
#include "clients/tools/charts/pictures.hpp"

namespace dripline::charts {

/// What all pictures share: text size by the picture's, title above, notes below.
struct Frame {
  double text = 12;
  Box inside;  ///< what is left for plots and their labels
};

/// The size of all texts of a picture but its title.
double text_size_of(const Canvas& canvas);
/// Draws title and notes, which are broken between words where the width ends.
Frame draw_frame(Canvas& canvas, const Caption& caption, const std::vector<std::string>& notes);
/// How many ticks fit: one for each so many text sizes.
int tick_count(double length, double text, double per_tick);
/// "Diameter, mm".
std::string with_unit(const std::string& name, const std::string& unit);
/// The plot of `area`, with room for its labels at the left, `right` at the right and, if `has_x`,
/// below.
Plot plot_in(const Box& area, const Axis& x, const Axis& y, double text, double right, bool has_x);
/// Makes a scale wide enough for a value.
void include(double& low, double& high, double value);

}  // namespace dripline::charts
