#include "clients/cli/measurements/picture_output.hpp"

#include "clients/cli/measurements/measurement_input.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/charts/svg_canvas.hpp"

namespace dripline::cli {
namespace {

Result<std::string> svg_of(const charts::ChartRequest& request, const chart_images::Drawing& draw) {
  charts::SvgCanvas canvas(request.width, request.height,
                           request.title.empty() ? "Measured values" : request.title);
  if (auto drawn = draw(canvas); !drawn) return fail(drawn.error());
  return std::move(canvas).finish();
}

}  // namespace

void add_picture_output(Command command, PictureOutput& output) {
  command
      .add_option("-o,--output", output.path,
                  "Picture to write: .svg, .png or .pdf; - for SVG on standard output")
      .required();
  command.add_option("--scale", output.scale, "PNG: pixels for each of width and height [1]")
      .check(in_range(0.25, 8.0));
}

int write_picture(const PictureOutput& output, const charts::ChartRequest& request,
                  const chart_images::Drawing& draw) {
  const chart_images::Size size{request.width, request.height, output.scale};
  Result<std::string> bytes;
  if (has_suffix(output.path, ".png")) {
    bytes = chart_images::draw_png(size, draw);
  } else if (has_suffix(output.path, ".pdf")) {
    bytes = chart_images::draw_pdf(size, draw);
  } else if (output.path == "-" || has_suffix(output.path, ".svg")) {
    bytes = svg_of(request, draw);
  } else {
    return complain(Error{Errc::Syntax, "--output " + output.path + ": .svg, .png or .pdf"});
  }
  if (!bytes) return complain(bytes.error());
  return write_to(output.path, *bytes);
}

}  // namespace dripline::cli
