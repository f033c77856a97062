#include "tests/differential/rs274ngc/maker.hpp"

#include <fmt/core.h>
#include <array>
#include <cmath>

namespace dripline::differential {
namespace {

constexpr std::array kStraight{"G0", "G1", "G01", "g1", "G00"};
constexpr std::array kSystems{"G54", "G55", "G57", "G59", "G59.1", "G59.3"};
constexpr std::array kCycles{"G81", "G82", "G83", "G73", "G84", "G74",
                             "G85", "G86", "G87", "G88", "G89"};

}  // namespace

void Maker::lines(std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const bool is_incremental = below(5) == 0;
    if (is_incremental) {
      const Ticks dx = between(-9'000, 9'000);
      const Ticks dz = between(-9'000, 9'000);
      x_ += dx;
      z_ += dz;
      line_with_values(fmt::format("G91 {} Z{} X{}", one_of(kStraight), value(dz), value(dx)));
      line("G90");
      continue;
    }
    x_ = between(-40'000, 40'000);
    y_ = between(-40'000, 40'000);
    std::string words = fmt::format("{} X{}", one_of(kStraight), value(x_));
    words += fmt::format("Y{}", value(y_));
    if (below(3) == 0) {
      z_ = between(-10'000, 20'000);
      words.insert(0, fmt::format("Z{} ", value(z_)));
    }
    if (below(6) == 0) words += fmt::format(" A{}", text_of(between(-900'000, 900'000)));
    line_with_values(words);
  }
}

/// A quarter, half or full turn: the end is exact in ten-thousandths.
void Maker::arcs(std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const Ticks i_word = between(-20'000, 20'000);
    const Ticks j_word = between(2'000, 20'000);
    std::string words = below(2) == 0 ? "G2" : "G3";
    switch (below(4)) {
      case 0:
        x_ += i_word + j_word;
        y_ += j_word - i_word;
        break;
      case 1:
        x_ += i_word - j_word;
        y_ += j_word + i_word;
        break;
      case 2:
        x_ += 2 * i_word;
        y_ += 2 * j_word;
        break;
      default:
        break;
    }
    words += fmt::format(" X{} Y{} I{} J{}", value(x_), value(y_), value(i_word), value(j_word));
    if (below(4) == 0) {
      z_ += between(-5'000, 5'000);
      words += fmt::format(" Z{}", value(z_));
    }
    if (below(6) == 0) words += fmt::format(" P{}", 1 + below(3));
    line_with_values(words);
  }
}

void Maker::radius_arc() {
  const Ticks dx = between(-15'000, 15'000);
  const Ticks dy = between(1'000, 15'000);
  x_ += dx;
  y_ += dy;
  const Ticks least = static_cast<Ticks>(std::hypot(dx, dy) / 2) + 2;
  const Ticks radius = least + between(0, 20'000) - (below(30) == 0 ? 500 : 0);
  line_with_values(fmt::format("{} X{} Y{} R{}{}", below(2) == 0 ? "G2" : "G3", value(x_),
                               value(y_), below(3) == 0 ? "-" : "", text_of(radius)));
}

void Maker::other_plane() {
  const bool is_zx = below(2) == 0;
  line("G10 L2 P0 R0");  // a turned arc of these planes is none of ours
  known_position();
  line(is_zx ? "G18" : "G19");
  const Ticks first = between(-9'000, 9'000);
  const Ticks second = between(1'000, 9'000);
  z_ += is_zx ? 2 * first : 2 * second;
  (is_zx ? x_ : y_) += is_zx ? 2 * second : 2 * first;
  line_with_values(fmt::format("{} {}{} Z{} {}{} K{}", below(2) == 0 ? "G2" : "G3",
                               is_zx ? 'X' : 'Y', value(is_zx ? x_ : y_), value(z_),
                               is_zx ? 'I' : 'J', value(is_zx ? second : first),
                               value(is_zx ? first : second)));
  if (below(3) == 0) {
    line_with_values(is_zx ? fmt::format("G81 X{} Y-1.5 Z{} R3.1 L2", value(x_), value(z_))
                           : fmt::format("G82 Y{} X-4.2 Z{} R3.9 P.1", value(y_), value(z_)));
    line("G80");
  }
  line("G17");
  known_position();
}

void Maker::offsets() {
  const std::uint64_t choice = below(9);
  if (choice == 0) {
    line(fmt::format("G10 L2 P{} X{} Y{} Z{}", 1 + below(9), value(between(-9'000, 9'000)),
                     value(between(-9'000, 9'000)), value(between(-9'000, 9'000))));
  } else if (choice == 1) {
    line(one_of(kSystems));
  } else if (choice == 2) {
    line(fmt::format("G92 X{} Y{}", value(between(-9'000, 9'000)), value(between(-9'000, 9'000))));
  } else if (choice == 3) {
    line(one_of(std::array{"G92.1", "G92.2", "G92.3"}));
  } else if (choice == 4) {
    line(fmt::format("G52 X{} Z{}", text_of(between(-9'000, 9'000)), text_of(between(0, 9'000))));
  } else if (choice == 5) {
    line(fmt::format("G10 L2 P{} R{}", below(3), text_of(between(-600'000, 600'000))));
  } else if (choice == 6) {
    line(fmt::format("G10 L20 P{} X{} Y{}", below(4), text_of(between(-9'000, 9'000)),
                     text_of(between(-9'000, 9'000))));
  } else if (choice == 7) {
    line(one_of(std::array{"G28.1", "G30.1", "G28", "G30 X1", "G28 Z2 Y1", "G30", "G28.1 X2 A4",
                           "G30.1 G1 Y3", "G28.1 G3 X3 I1"}));
  } else {
    line(
        fmt::format("G53 G0 X{} Z{}", text_of(between(-9'000, 9'000)), text_of(between(0, 9'000))));
  }
  settings_.clear();
  if (below(3) == 0) line_with_values(fmt::format("G1 X{} Y1", value(between(-9'000, 9'000))));
  known_position();
}

void Maker::lengths() {
  switch (below(5)) {
    case 0:
      line(fmt::format("G43 H{}", tool_or_spindle()));
      break;
    case 1:
      line("G49");
      break;
    case 2:
      line(fmt::format("G43.1 Z{}", text_of(between(-9'000, 9'000))));
      break;
    case 3:
      line(fmt::format("T{} M6", 1 + below(4)));
      line("M3");
      line("G43");
      break;
    default:
      line(fmt::format("G43.2 H{}", tool_or_spindle()));
      break;
  }
  if (below(2) == 0) line("G0 X1");
  known_position();
}

/// Rows of the tool table, written; what they are shows when a length or a radius is taken.
void Maker::tool_rows() {
  const std::uint64_t tool = 1 + below(4);
  const bool loads = below(2) == 0;  // the peer begins with a tool of its own making
  if (loads) {
    line(fmt::format("T{} M6", 1 + below(4)));
    line("M3");
    line("G43");
  }
  if (below(3) == 0) {
    line(fmt::format("G10 L2 P{} R{}", 9 * below(2), text_of(between(-600'000, 600'000))));
    known_position();  // with G92 the peer is wrong about where a turned system puts the tool
  }
  const std::string z = text_of(between(-9'000, 30'000));
  switch (below(4)) {
    case 0:
      line(fmt::format("G10 L1 P{} Z{} R{}", tool, z, text_of(between(100, 1'000))));
      break;
    case 1:
      line(fmt::format("G10 L10 P{} Z{}", tool, z));
      break;
    case 2:
      line(fmt::format("G10 L11 P{} Z{} X{}", tool, z, text_of(between(-9'000, 9'000))));
      break;
    default:
      line(fmt::format("G10 L10 P{} X{} Y{}", tool, text_of(between(-9'000, 9'000)), z));
      break;
  }
  line(below(2) == 0 ? fmt::format("G43 H{}", tool) : fmt::format("G43.2 H{}", tool));
  line(loads ? "G1 X#5421 Y[#5401/4 + 1] Z[#5422/8 + #5403/16 + #5410]"
             : "G1 X#5421 Y1.5 Z[#5422/8]");
  if (below(2) == 0) line("G49");
  known_position();
}

/// Of curves the peer prints no points: where they end shows in the move after them.
void Maker::splines() {
  known_position();
  const auto some = [&] { return text_of(between(-20'000, 20'000)); };
  switch (below(3)) {
    case 0:
      line(fmt::format("G5 X{} Y{} I{} J{} P{} Q{}", some(), some(), some(), some(), some(),
                       some()));
      if (below(2) == 0) line(fmt::format("G5 X{} Y{} P{} Q{}", some(), some(), some(), some()));
      break;
    case 1:
      line(fmt::format("G5.1 X{} Y{} I{} J{}", some(), some(), some(), some()));
      break;
    default:
      nurbs();
      break;
  }
  line(fmt::format("G1 Z{}", text_of(z_ + 1'000)));
  known_position();
}

/// Now and then with too few points.
void Maker::nurbs() {
  const auto point = [&] {
    return fmt::format("X{} Y{} P{}", text_of(between(-20'000, 20'000)),
                       text_of(between(-20'000, 20'000)), text_of(between(1'000, 40'000)));
  };
  const std::uint64_t order = 3 + below(3);
  line(below(3) == 0 ? fmt::format("G5.2 P{} L{}", text_of(between(1'000, 40'000)), order)
                     : fmt::format("G5.2 {} L{}", point(), order));
  const std::uint64_t count = order - 2 + below(5);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (below(8) == 0) line(one_of(std::array{"M8", "#1=2", "F20", "(on)"}));
    line(point());
  }
  line("G5.3");
}

std::uint64_t Maker::tool_or_spindle() {
  if (below(5) != 0) return 1 + below(5);
  line(fmt::format("T{} M6", 1 + below(4)));
  line("M3");
  return 0;
}

std::string Maker::rotary() {
  if (below(5) != 0) return "";
  const std::string angle = text_of(between(-900'000, 900'000));
  return below(3) == 0 ? " B" + angle + " C3.5" : " A" + angle;
}

/// A closed path, mostly with room for the tool.
void Maker::compensation() {
  known_position();
  const bool is_left = below(2) == 0;
  const Ticks diameter = below(4) == 0 ? 0 : between(200, 2'500) * (below(4) == 0 ? -1 : 1);
  line(below(3) == 0 ? fmt::format("{} D{}", is_left ? "G41.1" : "G42.1", text_of(diameter))
                     : fmt::format("{} D{}", is_left ? "G41" : "G42", tool_or_spindle()));
  const std::uint64_t count = 3 + below(5);
  double heading = static_cast<double>(below(628)) / 100;
  for (std::uint64_t i = 0; i < count; ++i) {
    heading += (static_cast<double>(below(360)) - 180) / 100;
    const auto length = static_cast<double>(between(8'000, 30'000));
    const Ticks dx = static_cast<Ticks>(length * std::cos(heading));
    const Ticks dy = static_cast<Ticks>(length * std::sin(heading));
    x_ += dx;
    y_ += dy;
    if (i > 0 && below(3) == 0) {
      const Ticks radius = static_cast<Ticks>(length * 0.55) + between(100, 20'000);
      line(fmt::format("{} X{} Y{} R{}{}", below(2) == 0 ? "G2" : "G3", text_of(x_), text_of(y_),
                       text_of(radius), rotary()));
    } else {
      line(fmt::format("{} X{} Y{}{}", below(8) == 0 ? "G0" : "G1", text_of(x_), text_of(y_),
                       rotary()));
    }
    if (below(8) == 0) line(fmt::format("G1 Z{}", text_of(z_ = between(-5'000, 9'000))));
    if (below(10) == 0) line(one_of(std::array{"M8", "G4 P.1", "M9", "#1=3"}));
    if (below(60) == 0) {
      line(one_of(std::array{"G53 G0 X1", "@2 ^45", "G81 X1 Z-1 R1", "G28", "G17", "G98", "G18",
                             "G28.1", "M48", "M50 P0", "M64 P1", "M68 E1 Q2", "M66 P0 L0"}));
    }
  }
  line("G40");
  known_position();
}

void Maker::cycles() {
  known_position();
  const std::string code = one_of(kCycles);
  const Ticks bottom = z_ - between(6'000, 20'000);
  const Ticks r = bottom + between(2'000, 18'000);
  std::string words = fmt::format("{} {} X{} Y{} Z{} R{}", below(2) == 0 ? "G98" : "G99", code,
                                  value(x_), value(y_), value(bottom), value(r));
  if (code == "G73" || code == "G83") words += fmt::format(" Q{}", text_of(between(1'500, 9'000)));
  if (code == "G82" || code == "G86" || code == "G88" || code == "G89") words += " P0.2";
  if (code == "G87") {
    words += fmt::format(" I{} J{} K{}", text_of(between(100, 900)), text_of(between(100, 900)),
                         text_of(bottom + between(500, 1'500)));
  }
  if (code == "G74") line("M4");
  line_with_values(words);
  const std::uint64_t more = below(4);
  for (std::uint64_t i = 0; i < more; ++i) {
    std::string next = fmt::format("X{}", value(between(-20'000, 20'000)));
    if (below(3) == 0) next += fmt::format(" Y{}", value(between(-20'000, 20'000)));
    if (below(4) == 0) next += fmt::format(" R{}", value(r + between(0, 9'000)));
    if (below(5) == 0) next += below(2) == 0 ? " G98" : " G99";
    if (below(6) == 0) next += fmt::format(" Z{}", value(bottom - between(0, 3'000)));
    line_with_values(next);
  }
  if (below(2) == 0) {
    line_with_values(fmt::format("G91 {} X{} Y0.1 Z-0.5 R-0.2 L{}{}", below(2) == 0 ? "G81" : "G85",
                                 value(between(-9'000, 9'000)), 1 + below(3), ""));
    if (below(2) == 0) line("X0.3 L2");
    line("G90");
  }
  line(code == "G74" ? "G80 M3" : "G80");
  known_position();
}

/// Bolt circles and spirals: each repeat continues from the hole before.
void Maker::polar_cycles() {
  known_position();
  line(below(3) == 0 ? "G90" : "G91");
  std::string words = below(2) == 0 ? "G98 " : "G99 ";
  words += one_of(std::array{"G81", "G82 P.1", "G83 Q.2", "G73 Q.17", "G85", "G89 P.1"});
  words += " R-0.2 Z-0.9";
  const std::uint64_t lines_of_cycle = 1 + below(3);
  for (std::uint64_t i = 0; i < lines_of_cycle; ++i) {
    const std::uint64_t polar = below(3);
    if (polar != 0) words += fmt::format(" ^{}", text_of(between(-900'000, 900'000)));
    if (polar != 1) words += fmt::format(" @{}", text_of(between(-9'000, 9'000)));
    if (below(4) != 0) words += fmt::format(" L{}", 1 + below(6));
    if (below(60) == 0) words += " X1";
    line(words);
    words.clear();
    if (below(50) == 0) line("G18");
    if (below(4) == 0) line("X0.3 Y0.2 L2");
  }
  line("G90 G80 G17");
  known_position();
}

}  // namespace dripline::differential
