#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

using enum Quantity;

namespace {

void walk_target(Form& form, Target& target) {
  form.toggle({.name = "coordinates", .help = "how the end is given"}, {"cartesian", "polar"},
              target.coordinates);
  const bool is_polar = target.coordinates == Coordinates::Polar;
  form.number(Field{"x", "X", Diameter, "end"}.only(!is_polar, "coordinates = cartesian"),
              target.x);
  form.number(Field{"z", "Z", Length, "end"}.only(!is_polar, "coordinates = cartesian"), target.z);
  form.toggle(Field{.name = "pole", .help = "the pole: the current point, or xc and zc"}.only(
                  is_polar, "coordinates = polar"),
              {"current", "absolute"}, target.pole);
  const bool is_absolute = is_polar && target.pole == Pole::Absolute;
  form.number(Field{"xc", "XC", Diameter, "pole"}.only(is_absolute, "pole = absolute"), target.xc);
  form.number(Field{"zc", "ZC", Length, "pole"}.only(is_absolute, "pole = absolute"), target.zc);
  form.number(Field{"length", "R", Length, "from the pole; blank: the last one"}
                  .only(is_polar, "coordinates = polar")
                  .at_least(0),
              target.length);
  form.number(Field{"angle", "AB", Angle, "from +Z; blank: the last one"}.only(
                  is_polar, "coordinates = polar"),
              target.angle);
  form.demand(is_polar || target.x || target.z, "cartesian: x or z must be given");
  form.demand(!is_polar || target.length || target.angle, "polar: length or angle must be given");
}

void walk_feed(Form& form, Feedrate& feed) {
  form.feedrate({"feed", "F", Feed, "a feed or \"rapid\"; blank: the feed in force"}, feed);
}

void walk_round(Form& form, Corner& corner) {
  const bool is_round = corner.kind == CornerKind::Round;
  form.number(Field{"corner_radius", "R", Radius, "radius of the rounding to the next element"}
                  .required()
                  .only(is_round, "corner = round")
                  .at_least(0),
              corner.radius);
}

/// How the end of an arc may be given, and which words then say it.
void walk_arc_end(Form& form, Arc& arc) {
  form.toggle({.name = "end", .help = "how the end is given"}, {"absolute", "incremental", "polar"},
              arc.end);
  const bool is_absolute = arc.end == ArcEnd::Absolute;
  const bool is_incremental = arc.end == ArcEnd::Incremental;
  form.number(Field{"x", "X", Diameter, "end"}.only(is_absolute, "end = absolute"), arc.x);
  form.number(Field{"z", "Z", Length, "end"}.only(is_absolute, "end = absolute"), arc.z);
  form.number(Field{"u", "U", Diameter, "from the start"}.only(is_incremental, "end = incremental"),
              arc.u);
  form.number(Field{"w", "W", Length, "from the start"}.only(is_incremental, "end = incremental"),
              arc.w);
  form.number(Field{"ab", "AB", Angle, "from the center to the end"}.required().only(
                  arc.end == ArcEnd::Polar, "end = polar"),
              arc.ab);
}

void walk_arc_center(Form& form, Arc& arc) {
  form.toggle({.name = "center", .help = "how the center is given"},
              {"incremental", "absolute", "polar", "radius only"}, arc.center);
  const bool is_incremental = arc.center == ArcCenter::Incremental;
  const bool is_absolute = arc.center == ArcCenter::Absolute;
  form.number(
      Field{"i", "I", Radius, "start to center in X"}.only(is_incremental, "center = incremental"),
      arc.i);
  form.number(
      Field{"k", "K", Length, "start to center in Z"}.only(is_incremental, "center = incremental"),
      arc.k);
  form.number(Field{"xc", "XC", Diameter, "center"}.only(is_absolute, "center = absolute"), arc.xc);
  form.number(Field{"zc", "ZC", Length, "center"}.only(is_absolute, "center = absolute"), arc.zc);
  form.number(Field{"aa", "AA", Angle, "from the center to the start"}.required().only(
                  arc.center == ArcCenter::Polar, "center = polar"),
              arc.aa);
  form.number(Field{"radius", "R", Radius, "blank with an absolute or polar center: the last one"}
                  .required(arc.center == ArcCenter::RadiusOnly)
                  .only(!is_incremental, "center not incremental")
                  .at_least(0),
              arc.radius);
  form.toggle(Field{.name = "length", .help = "short: less than half a circle"}.only(
                  arc.center == ArcCenter::RadiusOnly, "center = radius only"),
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
  form.number(Field{"chamfer_length", "C", Length, "between two lines only"}
                  .required()
                  .only(event.corner.kind == CornerKind::Chamfer, "corner = chamfer")
                  .at_least(0),
              event.corner.length);
  walk_extend_back(form, event.back);
}

void walk_extend_back(Form& form, ExtendBack& back) {
  form.toggle({.name = "extend_back",
               .help = "back to the element before: the near (short) or far (long) intersection"},
              {"off", "short", "long"}, back.extension);
  form.number(Field{"extend_angle", "W", Angle, "angle of the line"}.required().only(
                  back.extension != Extension::Off, "extend_back = short or long"),
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
  form.toggle({.name = "direction", .help = "direction of the first arc"}, {"cw", "ccw"},
              event.direction);
  form.number(Field{"r1", "R1", Radius, "radius of the first arc"}.required().at_least(0),
              event.r1);
  form.number(Field{"xc1", "XC1", Diameter, "center of the first arc"}.required(), event.xc1);
  form.number(Field{"zc1", "ZC1", Length, "center of the first arc"}.required(), event.zc1);
  form.number(Field{"r2", "R2", Radius, "radius of the second arc"}.required().at_least(0),
              event.r2);
  form.number(Field{"xc2", "XC2", Diameter, "center of the second arc"}.required(), event.xc2);
  form.number(Field{"zc2", "ZC2", Length, "center of the second arc"}.required(), event.zc2);
  form.toggle({.name = "exit", .help = "side of the line between the centers, first arc"},
              {"left", "right"}, event.exit);
  form.toggle({.name = "enter", .help = "side of the line between the centers, second arc"},
              {"left", "right"}, event.enter);
  form.toggle({.name = "connect", .help = "with a line or an arc"}, {"line", "arc"},
              event.connection);
  const bool is_arc = event.connection == Connection::Arc;
  form.toggle(Field{.name = "arc_center",
                    .help = "side of its center, seen along the line between the centers"}
                  .only(is_arc, "connect = arc"),
              {"left", "right"}, event.arc_center);
  form.number(Field{"arc_radius", "R", Radius, "radius of the connecting arc"}
                  .required()
                  .only(is_arc, "connect = arc")
                  .at_least(0),
              event.arc_radius);
  form.toggle(Field{.name = "arc_direction", .help = "direction of the connecting arc"}.only(
                  is_arc, "connect = arc"),
              {"cw", "ccw"}, event.arc_direction);
}

void walk(Form& form, ThreePointArc& event) {
  const auto point = [&](std::string_view x_name, std::string_view z_name, Entry& x, Entry& z) {
    form.number(Field{x_name, "X", Diameter, "on the arc"}.required(), x);
    form.number(Field{z_name, "Z", Length, "on the arc"}.required(), z);
  };
  point("x1", "z1", event.x1, event.z1);
  point("x2", "z2", event.x2, event.z2);
  point("x3", "z3", event.x3, event.z3);
  form.toggle(
      {.name = "end_at_point_3", .help = "yes: end at the third point; no: at the angle ab"},
      {"no", "yes"}, event.ends_at_third);
  form.number(Field{"ab", "AB", Angle, "from the center to the end"}.required().only(
                  !event.ends_at_third, "end_at_point_3 = no"),
              event.ab);
}

}  // namespace dripline::conversational
