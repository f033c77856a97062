#include <fmt/core.h>
#include <array>
#include <cmath>
#include <vector>

#include "tests/differential/rs274ngc/maker.hpp"

/// Contours for the lathe cycles G70 to G72: monotonic along the cut, with pockets, arcs, fillets
/// and chamfers, in all four quarters.
namespace dripline::differential {

/// A quarter of a circle, or less of it by R: within the upper or the lower half.
std::string Maker::contour_arc(Ticks run, Ticks rise, Ticks& along, Ticks& depth) {
  const Lie& lie = turning_;
  const bool is_valley = below(2) == 0;
  const Ticks from_along = along, from_depth = depth;
  const auto end = [&](Ticks to_along, Ticks to_depth) {
    along = to_along;
    depth = to_depth;
    return fmt::format("{} X{} Z{}", lie.arc(is_valley), text_of(lie.x(along, depth)),
                       text_of(lie.z(along, depth)));
  };
  if (below(2) == 0) {  // a quarter
    const Ticks radius = std::abs(rise);
    const std::string words = end(along + radius, depth + rise);
    // A rising valley and a falling hill begin level with their center.
    const bool begins_level = is_valley == (rise > 0);
    const Ticks center_along = begins_level ? from_along : along;
    const Ticks center_depth = begins_level ? depth : from_depth;
    return fmt::format("{} I{} K{}", words,
                       text_of(lie.x(center_along, center_depth) - lie.x(from_along, from_depth)),
                       text_of(lie.z(center_along, center_depth) - lie.z(from_along, from_depth)));
  }
  // With a radius that large no part of it is beside the center.
  const double chord = std::hypot(run, rise);
  const Ticks least = static_cast<Ticks>(chord * chord / (2.0 * static_cast<double>(run))) + 20;
  const std::string words = end(along + run, depth + rise);
  return fmt::format("{} R{}", words, text_of(least + between(0, 20'000)));
}

/// The lines of the contour, from its first point; none of them runs on in the line before.
std::vector<std::string> Maker::contour(Ticks along, Ticks depth) {
  const Lie& lie = turning_;
  std::vector<std::string> lines{fmt::format("{} X{} Z{}", below(2) == 0 ? "G0" : "G1",
                                             text_of(lie.x(along, depth)),
                                             text_of(lie.z(along, depth)))};
  const auto line_to = [&](Ticks to_along, Ticks to_depth) {
    return fmt::format("G1 X{} Z{}", text_of(lie.x(to_along, to_depth)),
                       text_of(lie.z(to_along, to_depth)));
  };
  const std::uint64_t count = 2 + below(7);
  Ticks highest = depth;
  bool has_corner = false, has_fillet = false, is_wall = false;
  std::vector<int> headings;  // falls, level, rises
  for (std::uint64_t i = 0; i < count; ++i) {
    const int before = headings.empty() ? -1 : headings.back();
    const bool may_fall = before != -1 && depth >= 4'000;
    int heading = static_cast<int>(below(3)) - 1;
    if (heading < 0 && !may_fall) heading = 1;
    if (heading == before) heading = before == 0 ? 1 : 0;
    headings.push_back(heading);
    const Ticks run = between(1'500, 4'000);
    const Ticks rise =
        heading * between(2'000, heading < 0 ? std::min<Ticks>(depth, 6'000) : 6'000);
    if (heading != 0 && below(3) == 0 && !has_corner && !is_wall) {
      is_wall = true;  // it may end upright
      lines.push_back(contour_arc(run, rise, along, depth));
      highest = std::max(highest, depth);
      continue;
    }
    is_wall = heading != 0 && !is_wall && below(3) == 0;
    // Rounding decides whether the peer takes a fillet at the foot of a wall.
    if (has_fillet && heading > 0) is_wall = false;
    if (!is_wall) along += run;
    depth += rise;
    highest = std::max(highest, depth);
    lines.push_back(line_to(along, depth));
    // The peer finds the side of a corner by a gap of a hundredth.
    has_corner = i + 1 < count && below(4) == 0;
    has_fillet = has_corner && below(2) == 0 && !(is_wall && heading < 0);
    if (has_corner)
      lines.back() += fmt::format(" {}{}", has_fillet ? 'A' : 'C', text_of(between(400, 700)));
  }
  // The peer plunges where the end is not above the first point.
  if (headings.back() == 1) lines.push_back(line_to(along += 2'000, depth));
  lines.push_back(line_to(along += between(0, 2'000), highest + between(2'000, 5'000)));
  return lines;
}

void Maker::turning() {
  constexpr std::array kRoughing{"G71", "G71.1", "G71.2", "G72", "G72.1", "G72.2"};
  const std::string code = one_of(kRoughing);
  turning_.is_facing = code[2] == '2';
  turning_.along_sign = below(2) == 0 ? -1 : 1;
  turning_.depth_sign = below(2) == 0 ? -1 : 1;
  const Lie& lie = turning_;
  line("G10 L2 P0 R0");
  known_position();
  line("G18 G90 G40");
  const Ticks depth = between(0, 6'000), top = depth + between(3'000, 25'000);
  const Ticks along = between(-9'000, 9'000);
  const std::string o = label();
  const auto lines = contour(along, depth);
  line(o + " sub");
  for (const std::string& words : lines) line(words);
  line(o + " endsub");
  const Ticks start = along - between(800, 3'000);
  const std::string begin =
      fmt::format("X{} Z{}", text_of(lie.x(start, top)), text_of(lie.z(start, top)));
  line(fmt::format("F30 G0 {}", begin));
  std::string words = fmt::format("{} Q{}", code, o.substr(1));
  if (below(3) == 0) words += " " + begin;
  if (below(2) == 0) words += fmt::format(" D{}", text_of(between(110, 700)));
  words += fmt::format(" I{}", text_of(between(700, 5'000)));
  if (below(3) != 0) words += fmt::format(" R{}", text_of(between(0, 3'000)));
  line(words);
  if (!turning_.is_facing && below(3) == 0) {
    line(fmt::format("G0 {}", begin));
    line(fmt::format("G70 Q{} {}", o.substr(1),
                     one_of(std::array{"", "D.03 P2", "D.05 E.012", "E.02", "D.06 P3"})));
  }
  line(fmt::format("G0 {}", begin));
  line("G17");
  known_position();
}

}  // namespace dripline::differential
