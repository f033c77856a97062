#include <fmt/format.h>

#include "clients/tools/conversational/impl/posting.hpp"

namespace dripline::conversational {
namespace {

void add_target(BlockText& block, const Target& target) {
  if (target.coordinates == Coordinates::Cartesian) {
    block.word("X", target.x).word("Z", target.z);
    return;
  }
  block.word("R", target.length)
      .word("XC", target.xc)
      .word("ZC", target.zc)
      .word("AB", target.angle);
}

void add_corner(BlockText& block, const Corner& corner) {
  if (corner.kind == CornerKind::Round && corner.radius) {
    block.code(fmt::format(", R {}", number_text(*corner.radius)));
  }
  if (corner.kind == CornerKind::Chamfer && corner.length) {
    block.code(fmt::format(", C {}", number_text(*corner.length)));
  }
}

std::string_view code_of(ArcDirection direction) {
  return direction == ArcDirection::Clockwise ? "G2" : "G3";
}

/// The code of a line: always when a feed is chosen, else only when another one is in force.
std::string_view line_code(const Posting& out, const Feedrate& feed) {
  if (feed.is_rapid) return "G0";
  return !feed.value && out.motion() == "G1" ? "" : "G1";
}

void add_arc_center(BlockText& block, const Arc& arc) {
  switch (arc.center) {
    case ArcCenter::Incremental:
      block.word("I", arc.i).word("K", arc.k);
      return;
    case ArcCenter::Absolute:
      block.word("R", arc.radius).word("XC", arc.xc).word("ZC", arc.zc);
      return;
    case ArcCenter::Polar:
      block.word("R", arc.radius).word("AA", arc.aa);
      return;
    case ArcCenter::RadiusOnly:
      block.word("R", arc.length == ArcLength::Long && arc.radius ? -*arc.radius : arc.radius);
      return;
  }
}

/// TANL and TANA: the sides of the tangent points, and of the connecting arc's center.
int case_number(const Tangents& event) {
  const bool exits_left = event.exit == Side::Left, enters_left = event.enter == Side::Left;
  const int sides = (exits_left ? 1 : 0) + (enters_left ? 2 : 0);
  const bool is_right_arc = event.connection == Connection::Arc && event.arc_center == Side::Right;
  return is_right_arc ? 7 - sides : sides;
}

}  // namespace

void add_extend_back(BlockText& block, const ExtendBack& back) {
  if (back.extension == Extension::Off) return;
  block.code(back.extension == Extension::Short ? "BACK C0" : "BACK C2").word("W", back.angle);
}

void post(Posting& out, const Position& event) {
  BlockText block(event.feed.is_rapid ? "G0" : "G1");
  block.word("F", event.feed.value);
  add_target(block, event.target);
  out.block(block);
}

void post(Posting& out, const Line& event) {
  const auto code = line_code(out, event.feed);
  BlockText block(code);
  block.word("F", event.feed.value);
  add_target(block, event.target);
  add_extend_back(block, event.back);
  add_corner(block, event.corner);
  out.block(block);
  if (!code.empty()) out.set_motion(code);
}

void post(Posting& out, const Arc& event) {
  BlockText block(code_of(event.direction));
  block.word("F", event.feed.value);
  add_arc_center(block, event);
  block.word("X", event.x).word("Z", event.z).word("U", event.u).word("W", event.w);
  block.word("AB", event.ab);
  add_corner(block, event.corner);
  out.block(block);
  out.set_motion(code_of(event.direction));
}

void post(Posting& out, const Tangents& event) {
  const bool is_arc = event.connection == Connection::Arc;
  out.parameter(90, event.zc1);
  out.parameter(91, event.xc1);
  out.parameter(92, event.r1);
  out.parameter(93, event.zc2);
  out.parameter(94, event.xc2);
  out.parameter(95, event.r2);
  if (is_arc) out.parameter(96, event.arc_radius);
  out.block(fmt::format("{} C{}", is_arc ? "TANA" : "TANL", case_number(event)));
  out.block(BlockText(code_of(event.direction)).code("XC[P91] ZC[P90] R[P92] X[P81] Z[P80]"));
  if (is_arc) {
    out.block(BlockText(code_of(event.arc_direction)).code("XC[P85] ZC[P84] R[P96] X[P83] Z[P82]"));
  } else {
    out.block("G1 X[P83] Z[P82]");
  }
}

void post(Posting& out, const ThreePointArc& event) {
  const Entry points[] = {event.z1, event.x1, event.z2, event.x2, event.z3, event.x3};
  int number = 90;
  for (const Entry& point : points) out.parameter(number++, point);
  out.block("CGEN");
  out.block("G2 IF P97=3 THEN G3");
  BlockText block("XC[P81] ZC[P80] R[P82]");
  if (event.ends_at_third) {
    block.code("X[P95] Z[P94]");
  } else {
    block.word("AB", event.ab);
  }
  out.block(block);
}

void post(Posting& out, const ThreadLine& event) {
  BlockText block("G32");
  block.word("F", event.lead).word("E", event.threads_per_unit).word("Q", event.start_angle);
  block.code("G1").word("X", event.x).word("Z", event.z);
  add_extend_back(block, event.back);
  out.block(block);
}

}  // namespace dripline::conversational
