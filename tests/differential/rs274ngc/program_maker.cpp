#include "tests/differential/rs274ngc/program_maker.hpp"

#include <fmt/core.h>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace dripline::differential {
namespace {

/// Ten-thousandths of a unit: what a program says exactly.
using Ticks = std::int64_t;

std::string text_of(Ticks ticks) {
  return fmt::format("{}{}.{:04}", ticks < 0 ? "-" : "", std::abs(ticks) / 10'000,
                     std::abs(ticks) % 10'000);
}

class Maker {
 public:
  explicit Maker(std::uint64_t number) : random_(number * 7919 + 13) {}

  std::string make() {
    line(below(2) == 0 ? "G20 G17 G90 G40 G49 G80" : "g21g17g90 G40G49g80");
    line("F30 S500 M3");
    known_position();
    const std::uint64_t parts = 3 + below(5);
    for (std::uint64_t i = 0; i < parts; ++i) part();
    if (below(12) == 0) mistake();
    if (below(3) == 0) lines(3);
    line(below(4) == 0 ? "M30" : "M2");
    return text_;
  }

 private:
  // Small choices.
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  Ticks between(Ticks low, Ticks high) {
    return low + static_cast<Ticks>(below(static_cast<std::uint64_t>(high - low + 1)));
  }
  template <std::size_t kSize>
  const char* one_of(const std::array<const char*, kSize>& words) {
    return words[below(kSize)];
  }

  void line(const std::string& words) {
    if (below(15) == 0) text_ += fmt::format("N{} ", below(5000));
    text_ += words;
    if (below(25) == 0) text_ += " (a comment)";
    if (below(40) == 0) text_ += " ; rest";
    text_ += '\n';
  }

  /// The value, written plainly or as something that computes it.
  std::string value(Ticks ticks) {
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
  /// Settings that values asked for come before the line that uses them.
  void line_with_values(const std::string& words) {
    text_ += std::exchange(settings_, {});
    line(words);
  }

  void known_position() {
    x_ = between(-30'000, 30'000);
    y_ = between(-30'000, 30'000);
    z_ = between(0, 20'000);
    line_with_values(fmt::format("G90 G0 X{} Y{} Z{}", value(x_), value(y_), value(z_)));
  }

  void part() {
    switch (below(17)) {
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
      default:
        return small_things();
    }
  }

  void lines(std::uint64_t count) {
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
        words = fmt::format("Z{} ", value(z_)) + words;
      }
      if (below(6) == 0) words += fmt::format(" A{}", text_of(between(-900'000, 900'000)));
      line_with_values(words);
    }
  }

  /// A quarter, half or full turn: the end is exact in ten-thousandths.
  void arcs(std::uint64_t count) {
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

  void radius_arc() {
    const Ticks dx = between(-15'000, 15'000);
    const Ticks dy = between(1'000, 15'000);
    x_ += dx;
    y_ += dy;
    const Ticks least = static_cast<Ticks>(std::hypot(dx, dy) / 2) + 2;
    const Ticks radius = least + between(0, 20'000) - (below(30) == 0 ? 500 : 0);
    line_with_values(fmt::format("{} X{} Y{} R{}{}", below(2) == 0 ? "G2" : "G3", value(x_),
                                 value(y_), below(3) == 0 ? "-" : "", text_of(radius)));
  }

  void other_plane() {
    const bool is_zx = below(2) == 0;
    line("G10 L2 P0 R0");  // a turned arc of these planes is none of ours
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

  void offsets() {
    const std::uint64_t choice = below(9);
    if (choice == 0) {
      line(fmt::format("G10 L2 P{} X{} Y{} Z{}", 1 + below(9), value(between(-9'000, 9'000)),
                       value(between(-9'000, 9'000)), value(between(-9'000, 9'000))));
    } else if (choice == 1) {
      line(one_of(kSystems));
    } else if (choice == 2) {
      line(
          fmt::format("G92 X{} Y{}", value(between(-9'000, 9'000)), value(between(-9'000, 9'000))));
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
      line(one_of(std::array{"G28.1", "G30.1", "G28", "G30 X1", "G28 Z2 Y1", "G30"}));
    } else {
      line(fmt::format("G53 G0 X{} Z{}", text_of(between(-9'000, 9'000)),
                       text_of(between(0, 9'000))));
    }
    settings_.clear();
    if (below(3) == 0) line_with_values(fmt::format("G1 X{} Y1", value(between(-9'000, 9'000))));
    known_position();
  }

  void lengths() {
    switch (below(5)) {
      case 0:
        line(fmt::format("G43 H{}", 1 + below(4)));
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
        line(fmt::format("G43.2 H{}", 1 + below(4)));
        break;
    }
    if (below(2) == 0) line("G0 X1");
    known_position();
  }

  /// A way around with room for the tool, mostly.
  void compensation() {
    known_position();
    const bool is_left = below(2) == 0;
    line(below(3) == 0
             ? fmt::format("{} D{}", is_left ? "G41.1" : "G42.1", text_of(between(200, 2'500)))
             : fmt::format("{} D{}", is_left ? "G41" : "G42", 1 + below(4)));
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
        line(fmt::format("{} X{} Y{} R{}", below(2) == 0 ? "G2" : "G3", text_of(x_), text_of(y_),
                         text_of(radius)));
      } else {
        line(fmt::format("{} X{} Y{}", below(8) == 0 ? "G0" : "G1", text_of(x_), text_of(y_)));
      }
      if (below(8) == 0) line(fmt::format("G1 Z{}", text_of(z_ = between(-5'000, 9'000))));
      if (below(10) == 0) line(one_of(std::array{"M8", "G4 P.1", "M9", "#1=3"}));
    }
    line("G40");
    known_position();
  }

  void cycles() {
    known_position();
    const std::string code = one_of(kCycles);
    const Ticks bottom = z_ - between(6'000, 20'000);
    const Ticks r = bottom + between(2'000, 18'000);
    std::string words = fmt::format("{} {} X{} Y{} Z{} R{}", below(2) == 0 ? "G98" : "G99", code,
                                    value(x_), value(y_), value(bottom), value(r));
    if (code == "G73" || code == "G83")
      words += fmt::format(" Q{}", text_of(between(1'500, 9'000)));
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
      line_with_values(fmt::format("G91 {} X{} Y0.1 Z-0.5 R-0.2 L{}{}",
                                   below(2) == 0 ? "G81" : "G85", value(between(-9'000, 9'000)),
                                   1 + below(3), ""));
      if (below(2) == 0) line("X0.3 L2");
      line("G90");
    }
    line(code == "G74" ? "G80 M3" : "G80");
    known_position();
  }

  std::string label() { return fmt::format("o{}", ++label_); }

  void loop() {
    const std::string o = label();
    const std::uint64_t counter = 1 + below(20);
    line(fmt::format("#{}={}", counter, below(3)));
    // Once it has passed over a break, the peer ends a do after its first pass.
    switch (has_break_ ? 2 * below(2) : below(4)) {
      case 0:
        line(fmt::format("{} while [#{} lt {}]", o, counter, 2 + below(5)));
        body(counter, o);
        line(fmt::format("{} endwhile", o));
        break;
      case 1:
        line(fmt::format("{} do", o));
        body(counter, o);
        line(fmt::format("{} while [#{} le {}]", o, counter, 1 + below(4)));
        break;
      case 2:
        line(fmt::format("{} repeat [{}]", o, below(4)));
        body(counter, "");
        line(fmt::format("{} endrepeat", o));
        break;
      default:
        line(fmt::format("{} while [#{} ne 5 and #{} lt 9]", o, counter, counter));
        body(counter, o);
        line(fmt::format("{} endwhile", o));
        break;
    }
    known_position();
  }

  void body(std::uint64_t counter, const std::string& loop_label) {
    line(fmt::format("#{}=[#{}+1]", counter, counter));
    line(fmt::format("G1 X[#{}/4] Y[SIN[#{}*15]]", counter, counter));
    if (!loop_label.empty() && below(3) == 0) {
      const std::string o = label();
      has_break_ = true;
      line(fmt::format("{} if [#{} eq {}]", o, counter, 2 + below(3)));
      line(fmt::format("{} {}", loop_label, below(2) == 0 ? "break" : "continue"));
      line(fmt::format("{} endif", o));
    }
    line(fmt::format("G0 Z[#{} mod 3]", counter));
  }

  void conditions() {
    const std::string o = label();
    line(fmt::format("#5={}", between(0, 4)));
    line(fmt::format("{} if [#5 {} {}]", o, one_of(kComparisons), below(4)));
    line("G0 X1.25");
    if (below(2) == 0) {
      line(fmt::format("{} elseif [#5 {} {}]", o, one_of(kComparisons), below(4)));
      line("G0 X1.5 Y2");
    }
    if (below(2) == 0) {
      line(fmt::format("{} else", o));
      line("G0 Y1.75");
    }
    line(fmt::format("{} endif", o));
    known_position();
  }

  void subprogram() {
    const std::string o = below(3) == 0 ? fmt::format("o<part{}>", ++label_) : label();
    line(o + " sub");
    line("#<depth>=[#1+#2/2]");
    line("G1 X#1 Y#2");
    if (below(2) == 0) {
      const std::string inner = label();
      line(inner + " if [#3 gt 1]");
      line(o + " return [#3*2]");
      line(inner + " endif");
    }
    line("G1 Z[0-#<depth>/8]");
    line(o + (below(2) == 0 ? " endsub [#1]" : " endsub"));
    const std::uint64_t calls = 1 + below(3);
    for (std::uint64_t i = 0; i < calls; ++i) {
      std::string words = o + " call";
      const std::uint64_t arguments = below(4);
      for (std::uint64_t k = 0; k < arguments; ++k)
        words += fmt::format(" [{}]", text_of(between(0, 30'000)));
      line(words);
      if (below(2) == 0) line("G0 X[#<_value>/4] Y#1");
    }
    known_position();
  }

  std::string term(int depth) {
    if (depth == 0 || below(3) == 0) return text_of(between(1'000, 40'000));
    switch (below(9)) {
      case 0:
        return fmt::format("SIN[{}]", term(depth - 1));
      case 1:
        return fmt::format("ATAN[{}]/[{}]", term(depth - 1), term(depth - 1));
      case 2:
        return fmt::format("SQRT[ABS[{}]]", term(depth - 1));
      case 3:
        return fmt::format("{}[{}]", one_of(std::array{"FIX", "FUP", "ROUND"}), term(depth - 1));
      case 4:
        return fmt::format("-{}", text_of(between(1, 30'000)));
      case 5:
        return fmt::format("#<_local{}>", 1 + below(2));
      default:
        return fmt::format("[{} {} {}]", term(depth - 1), one_of(kOperators), term(depth - 1));
    }
  }

  void expressions() {
    line("#<_local1>=1.5 #<_local2>=-2.25");
    line(fmt::format("#31=[{} {} {}]", term(2), one_of(kOperators), term(2)));
    line("#32=[[#31 gt 2.5]*3] #31=2");
    line("G1 X#31 Y#32");
    const std::string o = label();
    line(fmt::format("#34=[{}]", term(3)));
    line(o + " if [ABS[#34] lt 100]");
    line("G1 Y#34");
    line(o + " endif");
    line("#33=5420 G0 Z[#33 MOD 3 + #5422/9]");
    known_position();
  }

  void small_things() {
    switch (below(10)) {
      case 0:
        line(below(2) == 0 ? "G20" : "G21");
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
        line(one_of(std::array{"M8", "M7 M9", "M48", "G61", "G64 P0.01", "G61.1", "M5 M9",
                               "M3 S200", "G4 P.5"}));
        line("M3");
        break;
      case 7:
        line("/G1 X0.5 Y0.25");
        break;
      case 8:
        line("G95 F0.05");
        line("G1 X2");
        line("G94 F30");
        break;
      default:
        line("g 1 x 1 . 5 y- 0 . 2 5");
        break;
    }
    known_position();
  }

  /// One thing that is wrong, or looks so.
  void mistake() { line(one_of(kMistakes)); }

  static constexpr std::array kStraight{"G0", "G1", "G01", "g1", "G00"};
  static constexpr std::array kSystems{"G54", "G55", "G57", "G59", "G59.1", "G59.3"};
  static constexpr std::array kCycles{"G81", "G82", "G83", "G73", "G84", "G74",
                                      "G85", "G86", "G87", "G88", "G89"};
  static constexpr std::array kComparisons{"eq", "ne", "gt", "GE", "lt", "le"};
  static constexpr std::array kOperators{"+",  "-",   "*",  "/",  "mod", "and",
                                         "or", "xor", "gt", "le", "eq",  "**"};
  static constexpr std::array kMistakes{"G1 X1 X2",
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
                                        "G95 G1 X1"};

  std::mt19937_64 random_;
  std::string text_;
  std::string settings_;
  Ticks x_ = 0, y_ = 0, z_ = 0;
  int label_ = 100;
  bool has_break_ = false;
};

}  // namespace

std::string make_program(std::uint64_t number) {
  return Maker(number).make();
}

}  // namespace dripline::differential
