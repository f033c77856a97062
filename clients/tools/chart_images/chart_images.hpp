#pragma once

#include <functional>
#include <string>

#include "clients/tools/charts/canvas.hpp"
#include "protocol/base/result.hpp"

/// Pictures of clients/tools/charts as pixels and as paper, by cairo.
namespace dripline::chart_images {

using Drawing = std::function<Result<void>(charts::Canvas&)>;

struct Size {
  double width = 960, height = 600;  ///< in units of 1/96 inch
  double scale = 1;                  ///< pixels a unit, for PNG
};

/// The bytes of the file. Errors: Io (what cairo reports), LimitExceeded (sides over
/// charts::kMaxSide pixels), those of `draw`.
Result<std::string> draw_png(const Size& size, const Drawing& draw);
/// One page of that size.
Result<std::string> draw_pdf(const Size& size, const Drawing& draw);

}  // namespace dripline::chart_images
