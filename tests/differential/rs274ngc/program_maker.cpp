#include "tests/differential/rs274ngc/program_maker.hpp"

#include <fmt/core.h>
#include <array>
#include <utility>

#include "tests/differential/rs274ngc/maker.hpp"

namespace dripline::differential {
namespace {

constexpr std::array kMistakes{"G1 X1 X2",
                               "G2 X1 Y1",
                               "G2 X1 Y1 I1 R2",
                               "G81 X1 Z-1",
                               "G1 X[1+",
                               "G0 X[2*]",
                               "#1=",
                               "#[5]3=1",
                               "X1..2",
                               "G17 G18",
                               "G53 X1",
                               "G91 G53 G0 X1",
                               "G41 D9",
                               "G43 H77",
                               "M3 M4",
                               "G4",
                               "G4 P-1",
                               "T99",
                               "G10 L2 P10 X1",
                               "F-1",
                               "S-5",
                               "o99 endif",
                               "o98 call",
                               "o97 endwhile",
                               "G0 X#<_missing>",
                               "G83 X1 Z-3 R1",
                               "G33 Z1",
                               "G92",
                               "G28 G1 X1",
                               "G80 X1",
                               "G123",
                               "M77",
                               "G1.2",
                               "X1 (open",
                               "G0 XABS[-1]",
                               "G0 X LN[0]",
                               "G0 X[1/0]",
                               "G0 XACOS[2]",
                               "#5420=1",
                               "#9999=1",
                               "G0 X1 K2",
                               "G0 Q1 X1",
                               "P1",
                               "G96 X1",
                               "G5.1 X1 Y1",
                               "G2 X5 Y5 I1",
                               "G93 G1 X1",
                               "G0 X--1",
                               "G0 X-[1]",
                               "G0 X-#1",
                               "N1.5 G0 X1",
                               "G0 X1 N5",
                               "M6",
                               "M2 M0",
                               "G40 G41 D1",
                               "G0 X1 ^20 Y1",
                               "G7 G8",
                               "M66 P0 L9",
                               "M62",
                               "G64 P-1",
                               "G0 U1",
                               "G0 B10",
                               "G1 F0 X1",
                               "G95 G1 X1",
                               "G10 L1 P9 Z1",
                               "G10 L1 P1",
                               "G10 L10 Z1",
                               "G10 L11 P0 Z1",
                               "G10 L2 P1 I2",
                               "G10 L20 P1 X1 J2",
                               "G10 L1 P1 Q12",
                               "G10 L1 P1 Q1.5",
                               "G10 L1 P1 Z1 G1",
                               "G17 G41.1 D.1 L3",
                               "G5.3",
                               "G5.2 X1 P1",
                               "G5.2 X1 Y1 P1 I1",
                               "G17.1 G2 X1 I1",
                               "G4 P2 G2 X1 I1",
                               "G10 L2 X1",
                               "G10 L20 Y2",
                               "G10 L2 P1.4 X1",
                               "G10 L2 P1.6 X1\nG54\nX2",
                               "G10 L2 P9.6 X1",
                               "G10 L1 P1.4 Z1",
                               "G10 L1 P0 Z1",
                               "M61 Q9",
                               "M61",
                               "M61 Q-0.2",
                               "M3 M70",
                               "M72 M5",
                               "G43.2 H1 X1",
                               "G28.1 G80 X1",
                               "G28.1 G92 X1",
                               "S0\nG95 F1\nG1 X1",
                               "S0\nG95 F1\nG2 X1 I3",
                               "G41 D1\nM70\nG40\nG98\nM72",
                               "G96 S90\nM70\nG97\nM72",
                               "G41 D1\nG2 I1 J1",
                               "G41.1 D0.1\nG1 X20 Y20\nG40\nG42 D2\nG3 X1 Y1 R50"};

}  // namespace

std::string text_of(Ticks ticks) {
  return fmt::format("{}{}.{:04}", ticks < 0 ? "-" : "", std::abs(ticks) / 10'000,
                     std::abs(ticks) % 10'000);
}

std::string Maker::make() {
  line(below(2) == 0 ? "G20 G17 G90 G40 G49 G80" : "g21g17g90 G40G49g80");
  line("F30 S500 M3");
  known_position();
  const std::uint64_t parts = 3 + below(5);
  for (std::uint64_t i = 0; i < parts; ++i) part();
  if (below(12) == 0) mistake();
  if (below(3) == 0) lines(3);
  line(below(4) == 0 ? "M30" : "M2");
  return text_ + later_;
}

void Maker::line(const std::string& words) {
  if (below(15) == 0) text_ += fmt::format("N{} ", below(5000));
  text_ += words;
  if (below(25) == 0) text_ += " (a comment)";
  if (below(40) == 0) text_ += " ; rest";
  text_ += '\n';
}

std::string Maker::value(Ticks ticks) {
  switch (below(12)) {
    case 0: {
      const Ticks part = between(-20'000, 20'000);
      return fmt::format("[{}+{}]", text_of(part), text_of(ticks - part));
    }
    case 1:
      return fmt::format("[{} - [{}*2]]", text_of(ticks * 3), text_of(ticks));
    case 2:
      return fmt::format("[0-{}]", text_of(-ticks));
    case 3: {
      const std::uint64_t number = 40 + below(40);
      settings_ += fmt::format("#{}={}\n", number, text_of(ticks));
      return fmt::format("#{}", number);
    }
    case 4:
      return fmt::format("{} ", text_of(ticks));
    default:
      return text_of(ticks);
  }
}

void Maker::line_with_values(const std::string& words) {
  text_ += std::exchange(settings_, {});
  line(words);
}

void Maker::known_position() {
  x_ = between(-30'000, 30'000);
  y_ = between(-30'000, 30'000);
  z_ = between(0, 20'000);
  line_with_values(fmt::format("G90 G0 X{} Y{} Z{}", value(x_), value(y_), value(z_)));
}

void Maker::part() {
  switch (below(25)) {
    case 0:
    case 1:
      return lines(2 + below(4));
    case 2:
    case 3:
      return arcs(1 + below(3));
    case 4:
      return radius_arc();
    case 5:
      return other_plane();
    case 6:
      return offsets();
    case 7:
      return lengths();
    case 8:
    case 9:
      return compensation();
    case 10:
    case 11:
      return cycles();
    case 12:
      return loop();
    case 13:
      return conditions();
    case 14:
      return subprogram();
    case 15:
      return expressions();
    case 16:
    case 17:
      return tool_rows();
    case 18:
      return splines();
    case 19:
    case 20:
      return polar_cycles();
    case 21:
    case 22:
      return later_subprogram();
    case 23:
      return turning();
    default:
      return small_things();
  }
}

/// What is saved and comes back, and what does not: the motion mode.
void Maker::saved_modes() {
  constexpr std::array kChanges{
      "G0 X2",   "G1 Y3 F20",    "G91",   "G18",    "G98",      "G59",   "G92 X5", "G92.1",
      "G92.2",   "G52 Y2",       "G49",   "G43 H2", "G7",       "G90.1", "M3 S80", "G64 P0.02",
      "M8 M48",  "S80.6",        "F7.25", "F0.04",  "G95 F.25", "G95",   "G93",    "G93 G1 Y4 F3",
      "G96 S90", "G96 S60 D500", "G97",   "G61",    "M5",       "G20",   "G21"};
  bool is_feed_compared = true;
  const auto change = [&] {
    const std::string code = one_of(kChanges);
    if (code == "G20" || code == "G21") is_feed_compared = false;
    line(code);
  };
  for (std::uint64_t i = below(3); i > 0; --i) change();
  line("M70");
  for (std::uint64_t i = 1 + below(4); i > 0; --i) change();
  line("M72");
  if (below(2) == 0) line(is_feed_compared ? "X[#<_feed>/8] Z[#<_rpm>/80]" : "Z[#<_rpm>/80]");
  line("X4 Z2");
  line("Y5");
  line("G8 G17 G90 G91.1 G99 G49 M3 G94 F25 S500 G97");
}

void Maker::shown_state() {
  constexpr std::array kShown{"#5161/4",
                              "#5162/4",
                              "#5163/4",
                              "#5164/40",
                              "#5181/4",
                              "#5182/4",
                              "#5183/4",
                              "#5210",
                              "#5211/4",
                              "#5212/4",
                              "#5213/4",
                              "#5220",
                              "#5221/4",
                              "#5222/4",
                              "#5223/4",
                              "#5230/90",
                              "#5241/4",
                              "#5262/4",
                              "#5383/4",
                              "#5420/2",
                              "#5421/2",
                              "#5422/2",
                              "#5423/90",
                              "#<_x>/2",
                              "#<_y>/3",
                              "#<_z>/2",
                              "#<_a>/90",
                              "#<_abs_x>/4",
                              "#<_abs_y>/4",
                              "#<_abs_z>/4",
                              "#<_abs_a>/90",
                              "#<_feed>/9",
                              "#<_rpm>/100",
                              "#<_coord_system>/100",
                              "#<_plane>/100",
                              "#<_motion_mode>/90",
                              "#<_ccomp>/300",
                              "#<_metric>",
                              "#<_imperial>",
                              "#<_absolute>",
                              "#<_incremental>",
                              "#<_inverse_time>",
                              "#<_units_per_minute>",
                              "#<_units_per_rev>",
                              "#<_tool_offset>",
                              "#<_retract_r_plane>",
                              "#<_retract_old_z>",
                              "#<_spindle_rpm_mode>",
                              "#<_spindle_css_mode>",
                              "#<_ijk_absolute_mode>",
                              "#<_lathe_diameter_mode>",
                              "#<_lathe_radius_mode>",
                              "#<_spindle_on>",
                              "#<_spindle_cw>",
                              "#<_mist>",
                              "#<_flood>",
                              "#<_current_tool>",
                              "#<_selected_tool>",
                              "#<_call_level>",
                              "#<_value>",
                              "#<_value_returned>"};
  line(fmt::format("G0 X[{}] Y[{}] Z[{}]", one_of(kShown), one_of(kShown), one_of(kShown)));
}

void Maker::small_things() {
  switch (below(18)) {
    case 0:
      line("G49");
      line(below(2) == 0 ? "G20" : "G21");
      line("F30");
      break;
    case 1:
      line("G93");
      line("G1 X1 Y1 F2");
      line("G3 X1.5 Y1.5 R0.6 F3");
      line("G94 F25");
      break;
    case 2:
      line("G90.1");
      line("G0 X1 Y1");
      line("G2 X3 Y1 I2 J1");
      line("G91.1");
      break;
    case 3:
      line(fmt::format("G0 @{} ^{}", text_of(between(1'000, 30'000)),
                       text_of(between(0, 3'000'000))));
      line("G91 G1 @0.5 ^10");
      line("G90");
      break;
    case 4:
      line("G7");
      line("G0 X3");
      line("G8");
      break;
    case 5:
      line("S300");
      line("G33 Z-0.5 K0.05");
      break;
    case 6:
      line(one_of(std::array{"M8", "M7 M9", "M48", "G61", "G64 P0.01", "G61.1", "M5 M9", "M3 S200",
                             "G4 P.5"}));
      line("M3");
      break;
    case 7:
      line("/G1 X0.5 Y0.25");
      break;
    case 8:
      line(one_of(std::array{"G80 G0 X1 Y2", "G1 G80 X1.5", "G80 G53 G0 X1", "G80 G0",
                             "G80 G2 X1 Y1 R9", "G80 G80"}));
      break;
    case 9:
      line("#21=5 #22=EXISTS[#21]");
      line("G0 X#22 Y[EXISTS[##21] + EXISTS[#9999] + EXISTS[#<_none>]]");
      break;
    case 10:
      // What M6 does not take over: no lengths, no comments
      line(fmt::format("G41 D{}", 1 + below(5)));
      line("G1 X8 Y9");
      line("G1 X9 Y-3");
      line("G40");
      line(fmt::format("T{} M6", 1 + below(5)));
      line(one_of(std::array{"G0 Z2.5", "G1 X3", "G91 G1 X0.5", "M8"}));
      line("G90 M3");
      break;
    case 11:
      saved_modes();
      break;
    case 12:
      line("G95 F0.05");
      line("G1 X2");
      line("G94 F30");
      break;
    case 13:
    case 14:
    case 15:
    case 16:
      shown_state();
      break;
    default:
      line("g 1 x 1 . 5 y- 0 . 2 5");
      break;
  }
  known_position();
}

void Maker::mistake() {
  line(one_of(kMistakes));
}

std::string make_program(std::uint64_t number) {
  return Maker(number).make();
}

}  // namespace dripline::differential
