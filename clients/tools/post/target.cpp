#include "clients/tools/post/target.hpp"

#include <algorithm>

namespace dripline::post {
namespace {

/// In the order of Units: inch, millimeter.
constexpr std::array kTargets{
    // Manual of the Centurion 5T/6T: four decimals in inch, three in millimeters; tools 1 to 24.
    Target{.name = "centurion",
           .dialect = "centurion",
           .axes = "XZ",
           .is_lathe = true,
           .coordinate = {{{4, 999.9999}, {3, 9999.999}}},
           .feed = {{{2, 999}, {1, 9999}}},
           .feed_per_revolution = {{{5, 9.9999}, {4, 99.999}}},
           .speed = {0, 9999},
           .max_tool = 24,
           .max_radius_error = 0.001,
           .has_surface_speed = true,
           .has_threads = true,
           .has_mist = false},
    Target{.name = "fanuc",
           .dialect = "fanuc",
           .axes = "XYZABC",
           .coordinate = {{{4, 9999.9999}, {3, 99'999.999}}},
           .feed = {{{2, 9600}, {1, 240'000}}},
           .feed_per_revolution = {{{5, 9.99999}, {4, 500}}},
           .dwell = {3, 99'999},
           .max_tool = 400,
           .max_radius_error = 0.01,
           .feeds_along_circle = true,
           .radius = RadiusOf::Offset,
           .has_oriented_spindle = true},
    Target{.name = "fanuc-t",
           .dialect = "fanuc-t",
           .axes = "XZ",
           .is_lathe = true,
           .coordinate = {{{4, 9999.9999}, {3, 99'999.999}}},
           .feed = {{{2, 9600}, {1, 240'000}}},
           .feed_per_revolution = {{{5, 9.99999}, {4, 500}}},
           .dwell = {3, 99'999},
           .max_tool = 99,
           .max_radius_error = 0.01,
           .has_surface_speed = true,
           .has_threads = true,
           .has_lead_along_axis = true,
           .has_oriented_spindle = true},
    // HEIDENHAIN TNC 426/430, iTNC 530: their tools are in a table of the control. M89 and M90 on
    // are of the control, M1 has no code of an optional stop.
    Target{.name = "itnc",
           .dialect = "itnc",
           .form = Form::PlainLanguage,
           .axes = "XYZABC",
           .coordinate = {{{4, 1181.1024}, {4, 30'000}}},
           .feed = {{{4, 3937}, {3, 99'999.999}}},
           .speed = {3, 99'999.999},
           .dwell = {3, 19'999.999},
           .max_tool = 32'767,
           .max_m = 88,
           .max_name = 99'999'999,
           .max_radius_error = 0.016,
           .max_axes = 5,
           .has_all_helices = false,
           .radius = RadiusOf::Tool,
           .has_tool_table = true,
           .has_mist = false,
           .has_optional_stop = false},
    // Profile linuxcnc of rs274ngc.
    Target{.name = "linuxcnc",
           .dialect = "rs274ngc",
           .axes = "XYZABC",
           .coordinate = {{{5, 99'999}, {4, 999'999}}},
           .feed = {{{4, 99'999}, {3, 999'999}}},
           .feed_per_revolution = {{{5, 99}, {4, 999}}},
           .speed = {3, 99'999},
           .dwell = {3, 99'999},
           .max_tool = 99'999,
           .min_m = 100,
           .max_m = 199,
           .max_name = 99'999'999,
           .max_radius_error = 0.0127,
           .radius = RadiusOf::Offset,
           .has_surface_speed = true,
           .has_oriented_spindle = true,
           .stops_spindle_at_tool_change = true,
           .needs_speed_per_revolution = true},
    // ProtoTRAK Plus CAD/CAM Interface Manual: number formats, 255 events. Radii of an arc may
    // differ
    // by 0.02 mm (decided in the dialect's README).
    Target{.name = "prototrak-plus",
           .dialect = "prototrak-plus",
           .form = Form::Events,
           .axes = "XY",
           .has_operator_axis = true,
           .coordinate = {{{4, 99.9999}, {2, 9999.99}}},
           .feed = {{{1, 99.9, 0.1}, {0, 2535, 5}}},
           .max_tool = 99,
           .min_tool = 1,
           .max_m = 0,
           .max_name = 99'999'999,
           .max_blocks = 255,
           .max_radius_error = 0.02,
           .has_all_planes = false,
           .has_helix = false,
           .has_mist = false,
           .has_optional_stop = false},
    // NIST IR 6556: radii may differ by 0.002 mm or 0.0002 inch.
    Target{.name = "rs274ngc",
           .dialect = "rs274ngc",
           .axes = "XYZABC",
           .coordinate = {{{5, 99'999}, {4, 999'999}}},
           .feed = {{{4, 99'999}, {3, 999'999}}},
           .speed = {3, 99'999},
           .dwell = {3, 99'999},
           .max_tool = 128,
           .max_m = 0,
           .max_name = 99'999'999,
           .max_radius_error = 0.002,
           .radius = RadiusOf::Offset,
           .stops_spindle_at_tool_change = true},
    // HEIDENHAIN TNC 151/155: reading/ranges.hpp. Arcs lie in the plane across the tool axis Z.
    Target{.name = "tnc155",
           .dialect = "tnc155",
           .form = Form::PlainLanguage,
           .axes = "XYZC",
           .coordinate = {{{4, 1181.1024}, {3, 30'000}}},
           .feed = {{{1, 629.9}, {0, 15'999}}},
           .speed = {3, 30'000},
           .dwell = {3, 19'999.999},
           .max_tool = 254,
           .max_name = 99'999'999,
           .max_blocks = 65'534,
           .max_radius_error = 0.016,
           .max_axes = 3,
           .has_all_planes = false,
           .radius = RadiusOf::Tool,
           .defines_tools = true,
           .has_mist = false,
           .has_optional_stop = false,
           .has_comments = false},
    // Tektronix 1704: counts of 0.0001 inch or 0.001 mm, six digits; arcs within a quadrant.
    Target{.name = "tektronix-1704",
           .dialect = "tektronix-1704",
           .form = Form::Tape,
           .axes = "XYZ",
           .coordinate = {{{4, 99.9999}, {3, 999.999}}},
           .feed = {{{1, 200}, {0, 2000}}},
           .speed = {0, 0},
           .dwell = {1, 999.9},
           .max_tool = 0,
           .max_name = 0,
           .max_radius_error = 0.005,
           .max_sweep = 90,
           .has_helix = false,
           .has_comments = false},
};

}  // namespace

std::span<const Target> targets() {
  return kTargets;
}

std::string target_names() {
  std::string names;
  for (const Target& target : kTargets) {
    if (!names.empty()) names += ", ";
    names += target.name;
  }
  return names;
}

unsigned axes_of(const Target& target) {
  unsigned axes = 0;
  for (const auto axis : interpreter::kAllAxes) {
    if (target.axes.find(interpreter::letter(axis)) != std::string_view::npos)
      axes |= 1U << static_cast<unsigned>(axis);
  }
  return axes;
}

const std::vector<interpreter::ToolRecord>& tools_at(const Target& target,
                                                     const interpreter::Setup& target_setup,
                                                     const interpreter::Setup& source_setup) {
  const bool takes_source = target_setup.tools.empty() && !target.defines_tools;
  return takes_source ? source_setup.tools : target_setup.tools;
}

Result<const Target*> find_target(std::string_view name) {
  const auto found = std::ranges::find(kTargets, name, &Target::name);
  if (found != kTargets.end()) return &*found;
  return fail(Errc::NotFound, "unknown control {}; programs can be written for {}", name,
              target_names());
}

}  // namespace dripline::post
