// Points as numbers in lines. Properties: they are read or refused with a reason; written as CSV
// they come back; a height field of them, where there is one, has its bounds.
#include <cstdint>
#include <cstdlib>

#include "clients/tools/measurement_files/points.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::measurement_files;
  const auto points = read_points({reinterpret_cast<const char*>(data), size});
  if (!points) {
    if (points.error().what.empty()) std::abort();
    return 0;
  }
  std::string text;
  const auto written =
      write_points_csv(*points, [&](std::string_view bytes) -> dripline::Result<void> {
        text += bytes;
        return {};
      });
  const auto again = read_points(text);
  if (!written || !again || again->size() != points->size()) std::abort();
  if (const auto grid = make_height_grid(*points, 0)) {
    if (grid->heights.size() != grid->columns * grid->rows || grid->heights.size() > kMaxGridCells)
      std::abort();
  }
  return 0;
}
