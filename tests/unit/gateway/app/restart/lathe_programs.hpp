#pragma once

#include <fmt/format.h>
#include <cmath>
#include <random>
#include <string>

namespace dripline::gateway {

/// Programs of a lathe, each of one kind with sizes by chance: roughing outside and inside, facing,
/// grooves, threads, pecking and passes in a pocket. They begin and end at X200 Z150.
class LathePrograms {
 public:
  explicit LathePrograms(std::mt19937& random) : random_(random) {}

  struct Made {
    std::string text;
    bool is_bored = false;
  };
  Made make() {
    const std::string begin = "O1\nG40 G00 T0101\nG97 S500 M03\n";
    switch (random_() % 8) {
      case 0:
      case 1:
        return {begin + roughing(false), false};
      case 2:
        return {begin + roughing(true), true};
      case 3:
        return {begin + facing(), false};
      case 4:
        return {begin + grooves(), false};
      case 5:
        return {begin + thread(), false};
      case 6:
        return {begin + pecking(), false};
      default:
        return {begin + tapers(), false};
    }
  }

 private:
  double between(double low, double high) {
    return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 100) / 100;
  }
  static std::string home() { return "G00 X200. Z150.\nM30\n"; }
  /// Diameters that rise and fall: pockets. X is 52 or, inside, 10 at the start.
  std::string contour(bool is_inside, double first) {
    std::string text = fmt::format("N10 G00 X{:.2f} Z2.\n", first);
    double z = 0, x = first;
    text += "G01 Z0\n";
    for (int i = 0; i < 5; ++i) {
      z -= between(2, 8);
      x = is_inside ? between(12, 38) : between(20, 48);
      text += random_() % 3 == 0 ? fmt::format("G01 X{:.2f}\nZ{:.2f}\n", x, z)
                                 : fmt::format("G01 X{:.2f} Z{:.2f}\n", x, z);
    }
    return text + fmt::format("N20 G01 X{}\n", is_inside ? "10." : "52.");
  }
  std::string roughing(bool is_inside) {
    std::string text =
        fmt::format("G00 X{} Z2.\nG71 U{:.2f} R0.5\n", is_inside ? "10." : "52.", between(1, 4));
    text += fmt::format("G71 P10 Q20 U{} W0 F0.2\n", is_inside ? "-0.4" : "0.4");
    text += contour(is_inside, is_inside ? 30 : 24);
    text += "G70 P10 Q20 F0.1\n";
    if (is_inside) text += "G00 Z100.\n";
    return text + home();
  }
  std::string facing() {
    std::string text = fmt::format("G00 X52. Z2.\nG72 W{:.2f} R0.5\n", between(1, 3));
    text += "G72 P10 Q20 U0.2 W0.1 F0.2\nN10 G00 Z-20.\nG01 X40. Z-14.\nX30.\nX24. Z-8.\n";
    return text + "N20 G01 X10. Z2.\nG70 P10 Q20\n" + home();
  }
  std::string grooves() {
    std::string text;
    for (int i = 0; i < 3; ++i) {
      const double z = -5 - 12 * i - between(0, 3);
      text += fmt::format("G00 X52. Z{:.2f}\nG75 R0.5\nG75 X{:.2f} Z{:.2f} P{} Q{} F0.1\n", z,
                          between(20, 44), z - between(2, 8), 2000 + random_() % 3000,
                          1000 + random_() % 2000);
    }
    return text + home();
  }
  std::string thread() {
    std::string text = "G00 X52. Z5.\nG90 X49. Z-40. F0.2\nX46.\n";
    text += "G76 P010060 Q100 R0.05\nG76 X43. Z-30. P1500 Q500 F2.\n";
    text += "G92 X45. Z-30. F2.\nX44.\nX43.5\n";
    text += "G00 X44.\nG32 Z-20. F2.\nG32 X45. Z-25.\nG00 X52.\nZ5.\n";
    return text + home();
  }
  std::string pecking() {
    return fmt::format(
               "G00 X0 Z5.\nG74 R1.\nG74 Z-{:.2f} Q5000 F0.1\nG00 X52. Z1.\nG01 X-1. F0.1\nG00 "
               "X52. Z2.\n",
               between(10, 40)) +
           home();
  }
  /// Passes of its own, each in and out of a pocket.
  std::string tapers() {
    std::string text;
    const double z = -between(5, 20), width = between(6, 20);
    for (int pass = 1; pass <= 4; ++pass) {
      const double deep = 50 - pass * between(2, 5);
      text += fmt::format("G00 X54. Z{:.2f}\nG01 X50.\nX{:.2f} Z{:.2f} F0.2\nZ{:.2f}\n", z, deep,
                          z - width / 4, z - width / 2);
      text += fmt::format("G02 X{:.2f} Z{:.2f} R{:.2f}\nG01 X50. Z{:.2f}\nG00 X54.\n", deep + 2,
                          z - width / 2 - 1, 1.0, z - width);
    }
    return text + home();
  }

  std::mt19937& random_;
};

}  // namespace dripline::gateway
