#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/tools/approximation/arc_approximation.hpp"

namespace dripline::cli {
namespace {

using interpreter::ArcMethod;

/// All lengths in one unit, the user's; which one does not matter.
struct ApproximateCommand {
  double x = 0, y = 0, radius = 0, from = 0, sweep = 90, tolerance = 0;
  std::string method = "chord";
  int decimals = 4;
  bool as_blocks = false;
};

ArcMethod method_of(const std::string& name) {
  if (name == "tangent") return ArcMethod::Tangent;
  return name == "secant" ? ArcMethod::Secant : ArcMethod::Chord;
}

/// Blocks of a control with whole counts: X12345 is 1.2345 with four decimals.
std::string blocks_text(const std::vector<interpreter::PathPoint>& points, int decimals) {
  const double scale = std::pow(10.0, decimals);
  std::string text;
  for (std::size_t i = 1; i < points.size(); ++i) {
    text += fmt::format("{}X{:.0f}Y{:.0f}\n", i == 1 ? "G01" : "", points[i].x.mm() * scale,
                        points[i].y.mm() * scale);
  }
  return text;
}

std::string points_text(const std::vector<interpreter::PathPoint>& points, int decimals,
                        bool has_color) {
  Table table({right("STEP"), right("X"), right("Y")});
  for (std::size_t i = 0; i < points.size(); ++i) {
    table.add({std::to_string(i), fmt::format("{:.{}f}", points[i].x.mm(), decimals),
               fmt::format("{:.{}f}", points[i].y.mm(), decimals)});
  }
  return table.render(has_color);
}

int approximate(Context& context, const ApproximateCommand& command) {
  const auto points = interpreter::approximate(
      {Length::mm(command.x), Length::mm(command.y), Length::mm(command.radius),
       Angle::degrees(command.from), Angle::degrees(command.sweep), Length::mm(command.tolerance),
       method_of(command.method)});
  if (!points) {
    complain(points.error());
    return kExitUsage;
  }
  if (context.wants_json) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& point : *points) list.push_back({{"x", point.x.mm()}, {"y", point.y.mm()}});
    context.print(json_text(nlohmann::ordered_json{{"points", std::move(list)}}));
  } else if (command.as_blocks) {
    context.print(blocks_text(*points, command.decimals));
  } else {
    context.print(points_text(*points, command.decimals, context.has_color()));
  }
  return kExitOk;
}

}  // namespace

void add_approximate_command(Command app, Context& context) {
  auto command = app.add_subcommand(
      "approximate", "Approximate an arc by straight lines, for controls without arcs");
  auto options = std::make_shared<ApproximateCommand>();
  command.add_option("--radius", options->radius, "Radius of the arc").required();
  command.add_option("--tolerance", options->tolerance, "Largest distance between lines and arc")
      .required();
  command.add_option("--x", options->x, "X of the center [0]");
  command.add_option("--y", options->y, "Y of the center [0]");
  command.add_option("--from", options->from, "Angle of the start point, degrees from +X [0]");
  command.add_option("--sweep", options->sweep,
                     "Included angle in degrees, counterclockwise positive [90]");
  command
      .add_option("--method", options->method,
                  "Lines inside (chord), outside (tangent) or across (secant) [chord]")
      .check(one_of({"chord", "tangent", "secant"}));
  command.add_option("--decimals", options->decimals, "Decimals of coordinates [4]")
      .check(in_range(0, 8));
  command.add_flag("--blocks", options->as_blocks,
                   "Print blocks in whole counts (tektronix-1704), not a table");
  add_json_flag(command, context);
  command.footer(
      "All lengths are in one unit of your choice.\n\nExample:\n  dnc approximate --x 1 --y 3 "
      "--radius 0.5 --from 270 --sweep 180 --tolerance 0.0005 --method secant --blocks");
  command.callback([&context, options] { context.status = approximate(context, *options); });
}

}  // namespace dripline::cli
