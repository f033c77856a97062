#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {
namespace {

void walk_target(Form& form, Target& target) {
  form.toggle({.name = "coordinates", .help = "how the end is given"}, {"cartesian", "polar"},
              target.coordinates);
  const bool is_polar = target.coordinates == Coordinates::Polar;
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "end",
               .applies = !is_polar,
               .condition = "coordinates = cartesian"},
              target.x);
  form.number({.name = "z",
               .word = "Z",
               .help = "end",
               .applies = !is_polar,
               .condition = "coordinates = cartesian"},
              target.z);
  form.toggle({.name = "pole",
               .help = "the pole: the current point, or xc and zc",
               .applies = is_polar,
               .condition = "coordinates = polar"},
              {"current", "absolute"}, target.pole);
  const bool is_absolute = is_polar && target.pole == Pole::Absolute;
  form.number({.name = "xc",
               .word = "XC",
               .quantity = Quantity::Diameter,
               .help = "pole",
               .applies = is_absolute,
               .condition = "pole = absolute"},
              target.xc);
  form.number({.name = "zc",
               .word = "ZC",
               .help = "pole",
               .applies = is_absolute,
               .condition = "pole = absolute"},
              target.zc);
  form.number({.name = "length",
               .word = "R",
               .help = "from the pole; blank: the last one",
               .applies = is_polar,
               .condition = "coordinates = polar",
               .min = 0},
              target.length);
  form.number({.name = "angle",
               .word = "AB",
               .quantity = Quantity::Angle,
               .help = "from +Z; blank: the last one",
               .applies = is_polar,
               .condition = "coordinates = polar"},
              target.angle);
  form.demand(is_polar || target.x || target.z, "cartesian: x or z must be given");
  form.demand(!is_polar || target.length || target.angle, "polar: length or angle must be given");
}

void walk_feed(Form& form, Feedrate& feed) {
  form.feedrate({.name = "feed",
                 .word = "F",
                 .quantity = Quantity::Feed,
                 .help = "a feed or \"rapid\"; blank: the feed in force"},
                feed);
}

void walk_round(Form& form, Corner& corner) {
  const bool is_round = corner.kind == CornerKind::Round;
  form.number({.name = "corner_radius",
               .word = "R",
               .quantity = Quantity::Radius,
               .help = "radius of the rounding to the next element",
               .is_required = true,
               .applies = is_round,
               .condition = "corner = round",
               .min = 0},
              corner.radius);
}

/// How the end of an arc may be given, and which words then say it.
void walk_arc_end(Form& form, Arc& arc) {
  form.toggle({.name = "end", .help = "how the end is given"}, {"absolute", "incremental", "polar"},
              arc.end);
  const bool is_absolute = arc.end == ArcEnd::Absolute;
  const bool is_incremental = arc.end == ArcEnd::Incremental;
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "end",
               .applies = is_absolute,
               .condition = "end = absolute"},
              arc.x);
  form.number({.name = "z",
               .word = "Z",
               .help = "end",
               .applies = is_absolute,
               .condition = "end = absolute"},
              arc.z);
  form.number({.name = "u",
               .word = "U",
               .quantity = Quantity::Diameter,
               .help = "from the start",
               .applies = is_incremental,
               .condition = "end = incremental"},
              arc.u);
  form.number({.name = "w",
               .word = "W",
               .help = "from the start",
               .applies = is_incremental,
               .condition = "end = incremental"},
              arc.w);
  form.number({.name = "ab",
               .word = "AB",
               .quantity = Quantity::Angle,
               .help = "from the center to the end",
               .is_required = true,
               .applies = arc.end == ArcEnd::Polar,
               .condition = "end = polar"},
              arc.ab);
}

void walk_arc_center(Form& form, Arc& arc) {
  form.toggle({.name = "center", .help = "how the center is given"},
              {"incremental", "absolute", "polar", "radius only"}, arc.center);
  const bool is_incremental = arc.center == ArcCenter::Incremental;
  const bool is_absolute = arc.center == ArcCenter::Absolute;
  form.number({.name = "i",
               .word = "I",
               .quantity = Quantity::Radius,
               .help = "start to center in X",
               .applies = is_incremental,
               .condition = "center = incremental"},
              arc.i);
  form.number({.name = "k",
               .word = "K",
               .help = "start to center in Z",
               .applies = is_incremental,
               .condition = "center = incremental"},
              arc.k);
  form.number({.name = "xc",
               .word = "XC",
               .quantity = Quantity::Diameter,
               .help = "center",
               .applies = is_absolute,
               .condition = "center = absolute"},
              arc.xc);
  form.number({.name = "zc",
               .word = "ZC",
               .help = "center",
               .applies = is_absolute,
               .condition = "center = absolute"},
              arc.zc);
  form.number({.name = "aa",
               .word = "AA",
               .quantity = Quantity::Angle,
               .help = "from the center to the start",
               .is_required = true,
               .applies = arc.center == ArcCenter::Polar,
               .condition = "center = polar"},
              arc.aa);
  form.number({.name = "radius",
               .word = "R",
               .quantity = Quantity::Radius,
               .help = "blank with an absolute or polar center: the last one",
               .is_required = arc.center == ArcCenter::RadiusOnly,
               .applies = !is_incremental,
               .condition = "center not incremental",
               .min = 0},
              arc.radius);
  form.toggle({.name = "length",
               .help = "short: less than half a circle",
               .applies = arc.center == ArcCenter::RadiusOnly,
               .condition = "center = radius only"},
              {"short", "long"}, arc.length);
  form.demand(!is_incremental || arc.i || arc.k, "i or k must be given");
  form.demand(!is_absolute || arc.xc || arc.zc, "xc or zc must be given");
}

}  // namespace

void walk(Form& form, Position& event) {
  walk_feed(form, event.feed);
  walk_target(form, event.target);
}

void walk(Form& form, Line& event) {
  walk_feed(form, event.feed);
  walk_target(form, event.target);
  form.toggle({.name = "corner", .help = "between this line and the next element"},
              {"none", "round", "chamfer"}, event.corner.kind);
  walk_round(form, event.corner);
  form.number({.name = "chamfer_length",
               .word = "C",
               .help = "between two lines only",
               .is_required = true,
               .applies = event.corner.kind == CornerKind::Chamfer,
               .condition = "corner = chamfer",
               .min = 0},
              event.corner.length);
  walk_extend_back(form, event.back);
}

void walk_extend_back(Form& form, ExtendBack& back) {
  form.toggle({.name = "extend_back",
               .help = "back to the element before: the near (short) or far (long) intersection"},
              {"off", "short", "long"}, back.extension);
  form.number({.name = "extend_angle",
               .word = "W",
               .quantity = Quantity::Angle,
               .help = "angle of the line",
               .is_required = true,
               .applies = back.extension != Extension::Off,
               .condition = "extend_back = short or long"},
              back.angle);
}

void walk(Form& form, Arc& event) {
  walk_feed(form, event.feed);
  form.demand(!event.feed.is_rapid, "feed = \"rapid\" is for lines only");
  form.toggle({.name = "direction", .help = "seen with +X up and +Z to the right"}, {"cw", "ccw"},
              event.direction);
  walk_arc_center(form, event);
  walk_arc_end(form, event);
  form.toggle({.name = "corner", .help = "between this arc and the next element"},
              {"none", "round"}, event.corner.kind);
  walk_round(form, event.corner);
}

void walk(Form& form, Tangents& event) {
  const auto circle = [&](const Field& radius, Entry& r, const Field& x, Entry& xc, const Field& z,
                          Entry& zc) {
    form.number(radius, r);
    form.number(x, xc);
    form.number(z, zc);
  };
  form.toggle({.name = "direction", .help = "direction of the first arc"}, {"cw", "ccw"},
              event.direction);
  circle({.name = "r1",
          .word = "R1",
          .quantity = Quantity::Radius,
          .help = "radius of the first arc",
          .is_required = true,
          .min = 0},
         event.r1,
         {.name = "xc1",
          .word = "XC1",
          .quantity = Quantity::Diameter,
          .help = "center of the first arc",
          .is_required = true},
         event.xc1,
         {.name = "zc1", .word = "ZC1", .help = "center of the first arc", .is_required = true},
         event.zc1);
  circle({.name = "r2",
          .word = "R2",
          .quantity = Quantity::Radius,
          .help = "radius of the second arc",
          .is_required = true,
          .min = 0},
         event.r2,
         {.name = "xc2",
          .word = "XC2",
          .quantity = Quantity::Diameter,
          .help = "center of the second arc",
          .is_required = true},
         event.xc2,
         {.name = "zc2", .word = "ZC2", .help = "center of the second arc", .is_required = true},
         event.zc2);
  form.toggle({.name = "exit", .help = "side of the line between the centers, first arc"},
              {"left", "right"}, event.exit);
  form.toggle({.name = "enter", .help = "side of the line between the centers, second arc"},
              {"left", "right"}, event.enter);
  form.toggle({.name = "connect", .help = "with a line or an arc"}, {"line", "arc"},
              event.connection);
  const bool is_arc = event.connection == Connection::Arc;
  form.toggle({.name = "arc_center",
               .help = "side of its center, seen along the line between the centers",
               .applies = is_arc,
               .condition = "connect = arc"},
              {"left", "right"}, event.arc_center);
  form.number({.name = "arc_radius",
               .word = "R",
               .quantity = Quantity::Radius,
               .help = "radius of the connecting arc",
               .is_required = true,
               .applies = is_arc,
               .condition = "connect = arc",
               .min = 0},
              event.arc_radius);
  form.toggle({.name = "arc_direction",
               .help = "direction of the connecting arc",
               .applies = is_arc,
               .condition = "connect = arc"},
              {"cw", "ccw"}, event.arc_direction);
}

void walk(Form& form, ThreePointArc& event) {
  const auto point = [&](std::string_view x_name, std::string_view z_name, Entry& x, Entry& z) {
    form.number({.name = x_name,
                 .word = "X",
                 .quantity = Quantity::Diameter,
                 .help = "on the arc",
                 .is_required = true},
                x);
    form.number({.name = z_name, .word = "Z", .help = "on the arc", .is_required = true}, z);
  };
  point("x1", "z1", event.x1, event.z1);
  point("x2", "z2", event.x2, event.z2);
  point("x3", "z3", event.x3, event.z3);
  form.toggle(
      {.name = "end_at_point_3", .help = "yes: end at the third point; no: at the angle ab"},
      {"no", "yes"}, event.ends_at_third);
  form.number({.name = "ab",
               .word = "AB",
               .quantity = Quantity::Angle,
               .help = "from the center to the end",
               .is_required = true,
               .applies = !event.ends_at_third,
               .condition = "end_at_point_3 = no"},
              event.ab);
}

}  // namespace dripline::conversational
