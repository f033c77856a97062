#include <fmt/core.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/gateway/interpreter/dialects/fanuc/roughing_stock.hpp"

/// FANT-009, FANT-011, FANT-018: G71 and G72 of both types and G70 after them, in simulated stock,
/// with many contours: no rapid move in the stock, no cut below the contour with its allowance,
/// none deeper than its depth, and nothing left above it.
namespace dripline::interpreter::fanuc {
namespace {

constexpr double kStart = 25;  ///< the depth where the cycle begins

struct Cycle {
  CutDirections directions;
  bool has_pockets = false;   ///< type II
  bool begins_aside = false;  ///< the block of P leads along the cuts too
  double depth = 1, escape = 0.5;
  double allowance = 0;        ///< out of the work
  double allowance_along = 0;  ///< against the cuts
  Contour contour;             ///< after the block of P; with `begins_aside` from the start point
};

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

class ContourMaker {
 public:
  ContourMaker(std::mt19937& random, const Cycle& cycle) : random_(random), cycle_(cycle) {}

  Contour make() {
    Contour contour;
    depth_ = cycle_.begins_aside ? kStart : rounded(between(2, cycle_.has_pockets ? 22 : 12));
    along_ = 0;
    if (cycle_.begins_aside) add_line(contour, rounded(between(1, 6)), rounded(between(2, 20)));
    const int parts = 2 + static_cast<int>(random_() % 12);
    for (int n = 0; n < parts || along_ < 1; ++n) add(contour);
    return contour;
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double next_depth() {
    if (cycle_.has_pockets) return rounded(between(1, kStart));
    return rounded(std::min(kStart, depth_ + between(0, 4)));
  }
  void add(Contour& contour) {
    switch (random_() % 8) {
      case 0:
        return add_line(contour, 0, next_depth());
      case 1:
        return add_line(contour, rounded(between(0.2, 6)), depth_);
      case 2:
      case 3:
      case 4:
        if (add_arc(contour)) return;
        [[fallthrough]];
      default:
        return add_line(contour, rounded(between(0.05, 6)), next_depth());
    }
  }
  void add_line(Contour& contour, double length, double depth) {
    add_part(contour, {depth_, along_, depth, rounded(along_ + length)});
  }
  void add_part(Contour& contour, const ContourPart& part) {
    contour.push_back(part);
    depth_ = part.to_depth;
    along_ = part.to_along;
  }
  /// The radius is so many times half of the chord.
  static void place_center(ContourPart& arc, double factor) {
    const double along = arc.to_along - arc.from_along, depth = arc.to_depth - arc.from_depth;
    const double chord = std::hypot(depth, along);
    const double sense = arc.is_upper ? -1 : 1;
    const double away = sense * chord / 2 * std::sqrt(factor * factor - 1);
    arc.center_depth = rounded((arc.from_depth + arc.to_depth) / 2 + away * along / chord);
    arc.center_along = rounded((arc.from_along + arc.to_along) / 2 - away * depth / chord);
    arc.radius = std::hypot(arc.from_depth - arc.center_depth, arc.from_along - arc.center_along);
  }
  /// Within one half of its circle, and within the depths of the cycle.
  bool add_arc(Contour& contour) {
    ContourPart arc{depth_, along_, next_depth(), rounded(along_ + between(0.3, 8)), true};
    arc.is_upper = random_() % 2 == 0;
    // Half a circle begins and ends along the depth; its center is exact.
    const bool is_half = cycle_.has_pockets && random_() % 3 == 0;
    if (is_half) {
      arc.radius = rounded(between(0.3, 6));
      arc.to_depth = arc.center_depth = depth_;
      arc.center_along = rounded(along_ + arc.radius);
      arc.to_along = rounded(along_ + 2 * arc.radius);
    } else {
      place_center(arc, between(1.0001, 2));
    }
    // Elsewhere the rounding of the center must not change the depth by more than it.
    const auto on_side = [&](double depth) {
      const double off = depth - arc.center_depth;
      return is_half || (arc.is_upper ? off : -off) >= 0.2 * arc.radius;
    };
    const double lowest = arc.center_depth - arc.radius;
    if (!on_side(depth_) || !on_side(arc.to_depth) || arc.highest() > kStart) return false;
    if (!arc.is_upper && lowest < 0.5) return false;
    if (!cycle_.has_pockets) {
      const bool is_left = arc.to_along <= arc.center_along;
      const bool is_right = arc.from_along >= arc.center_along;
      if (arc.to_depth < depth_ || !(arc.is_upper ? is_left : is_right)) return false;
    }
    add_part(contour, arc);
    return true;
  }

  std::mt19937& random_;
  const Cycle& cycle_;
  double depth_ = 0;
  double along_ = 0;
};

std::string place(const CutDirections& directions, double depth, double along) {
  return fmt::format("X{:.3f} Z{:.3f}", 2 * directions.x_of(depth, along),
                     directions.z_of(depth, along));
}

/// One block of the contour.
std::string block(const CutDirections& directions, const ContourPart& part) {
  const std::string to = place(directions, part.to_depth, part.to_along);
  if (!part.is_arc) return "G01 " + to;
  // Over the top of a circle the path along it is clockwise.
  const bool is_counterclockwise = !part.is_upper == directions.keeps_rotation();
  const double i = directions.x_of(part.center_depth, part.center_along) -
                   directions.x_of(part.from_depth, part.from_along);
  const double k = directions.z_of(part.center_depth, part.center_along) -
                   directions.z_of(part.from_depth, part.from_along);
  return fmt::format("G0{} {} I{:.3f} K{:.3f}", is_counterclockwise ? 3 : 2, to, i, k);
}

std::string program_of(const Cycle& cycle, bool is_finished) {
  const CutDirections& d = cycle.directions;
  const char* code = d.is_facing ? "G72" : "G71";
  const double x = d.is_facing ? -d.forward() * cycle.allowance_along : d.out() * cycle.allowance;
  const double z = d.is_facing ? d.out() * cycle.allowance : -d.forward() * cycle.allowance_along;
  std::string text = "G00 " + place(d, kStart, 0) + "\n";
  text += fmt::format("{} {}{:.3f} R{:.3f}\n", code, d.is_facing ? "W" : "U", cycle.depth,
                      cycle.escape);
  text += fmt::format("{} P10 Q20 U{:.3f} W{:.3f} F0.2\n", code, 2 * x, z);
  std::size_t next = 0;
  if (cycle.begins_aside) {
    text += "N10 " + block(d, cycle.contour[next++]) + "\n";
  } else {
    const double depth = cycle.contour.front().from_depth;
    const char first = d.is_facing ? 'Z' : 'X';
    text += cycle.has_pockets ? "N10 G00 " + place(d, depth, 0) + "\n"
                              : fmt::format("N10 G00 {}{:.3f}\n", first,
                                            d.is_facing ? d.z_of(depth, 0) : 2 * d.x_of(depth, 0));
  }
  for (; next + 1 < cycle.contour.size(); ++next) text += block(d, cycle.contour[next]) + "\n";
  text += "N20 " + block(d, cycle.contour.back()) + "\n";
  if (is_finished) text += "G70 P10 Q20 F0.1\n";
  return text + "M30\n";
}

MachineLog run(const std::string& program) {
  const auto setup = parse_setup("[control]\nmodel = \"0i\"\n");
  MachineLog log;
  MemorySource source(program);
  auto made = kFanucLatheDialect.make(*setup, source, log);
  if (!made) {
    log.alarm = made.error().what;
    return log;
  }
  (*made)->step(100'000);
  return log;
}

Contour shifted(Contour contour, double depth, double along) {
  for (ContourPart& part : contour) {
    for (double* each : {&part.from_depth, &part.to_depth, &part.center_depth}) *each += depth;
    for (double* each : {&part.from_along, &part.to_along, &part.center_along}) *each += along;
  }
  return contour;
}

/// Whether the allowance along the cuts takes more than `most` from the part: its walls that go
/// down. `beside` a wall it may be a millionth wide.
bool takes_from_part(const Cycle& cycle, double most, double beside) {
  if (cycle.allowance_along == 0) return false;
  const Contour with = shifted(cycle.contour, cycle.allowance, -cycle.allowance_along);
  const double end = cycle.contour.back().to_along - cycle.allowance_along;
  const auto takes = [&](double along) {
    return along > 0 && along < end &&
           depth_of(with, along) < depth_of(cycle.contour, along) - most;
  };
  for (const Contour* contour : {&with, &cycle.contour}) {
    for (const ContourPart& part : *contour) {
      if (takes(part.from_along + beside) || takes(part.to_along - beside)) return true;
    }
  }
  for (double along = 0.00031; along < end; along += 0.00297) {
    if (takes(along)) return true;
  }
  return false;
}

void check(const Cycle& cycle) {
  const std::string text = program_of(cycle, true);
  const std::size_t rough_moves = run(program_of(cycle, false)).moves.size();
  const MachineLog log = run(text);
  SCOPED_TRACE(text);
  ASSERT_EQ(log.alarm, "");
  const double end = cycle.contour.back().to_along;
  const double end_of_rough = end - cycle.allowance_along;
  Stock stock(0, end, kStart);
  RoughingCheck check(cycle.directions, stock);
  check.limit(shifted(cycle.contour, cycle.allowance, -cycle.allowance_along), cycle.depth);
  for (std::size_t i = 1; i < rough_moves; ++i) check.make(log.moves[i]);
  ASSERT_EQ(check.fault, "");
  const Contour rough = shifted(cycle.contour, cycle.allowance, -cycle.allowance_along);
  for (std::size_t n = 0; n < stock.size(); ++n) {
    const double along = stock.center(n);
    if (along > end_of_rough - Stock::kWidth) break;
    ASSERT_LE(stock.height(n),
              std::min(kStart, depth_of(rough, along)) + RoughingCheck::kTolerance + 0.01)
        << "left at " << along;
  }
  EXPECT_NEAR(cycle.directions.depth_of(log.moves[rough_moves - 1].to), kStart, 1e-6);
  EXPECT_NEAR(cycle.directions.along_of(log.moves[rough_moves - 1].to), 0, 1e-6);
  // G70 may take what is left, a shoulder's whole height with an allowance along the cuts.
  check.limit(cycle.contour, kStart);
  for (std::size_t i = rough_moves; i < log.moves.size(); ++i) check.make(log.moves[i]);
  ASSERT_EQ(check.fault, "");
  EXPECT_NEAR(cycle.directions.depth_of(log.at()), kStart, 1e-6);
  EXPECT_NEAR(cycle.directions.along_of(log.at()), 0, 1e-6);
}

Cycle make_cycle(std::mt19937& random, bool has_pockets) {
  Cycle cycle;
  cycle.has_pockets = has_pockets;
  cycle.directions = {random() % 2 == 0, random() % 2 == 0, random() % 2 == 0};
  cycle.begins_aside = has_pockets && random() % 3 == 0;
  cycle.depth = rounded(std::uniform_real_distribution<double>(0.4, 6)(random));
  constexpr std::array kEscapes{0.0, 0.2, 0.5, 2.0, 9.0};
  cycle.escape = kEscapes[random() % kEscapes.size()];
  constexpr std::array kAllowances{0.0, 0.1, 0.4, 1.0};
  cycle.allowance = kAllowances[random() % kAllowances.size()];
  if (random() % (has_pockets ? 3 : 2) == 0) cycle.allowance_along = 0.1;
  cycle.contour = ContourMaker(random, cycle).make();
  return cycle;
}

TEST(RoughingCycles, TypeTwoCutsPocketsAndNothingElse) {
  std::mt19937 random(20261);
  int cut = 0, refused = 0;
  for (int n = 0; n < 800; ++n) {
    const Cycle cycle = make_cycle(random, true);
    const MachineLog log = run(program_of(cycle, false));
    if (log.alarm.find("finish allowance") != std::string::npos) {
      EXPECT_TRUE(takes_from_part(cycle, 0, 2e-6)) << program_of(cycle, false);
      ++refused;
      continue;
    }
    EXPECT_FALSE(takes_from_part(cycle, 1e-4, 1e-3)) << program_of(cycle, false);
    check(cycle);
    if (HasFailure()) return;
    ++cut;
  }
  EXPECT_GT(cut, 500);
  EXPECT_GT(refused, 25);
}

/// What follows the cycle's first block, from X50 Z2.
MachineLog run_contour(const std::string& cycle, const std::string& contour) {
  return run("G00 X50. Z2.\nG71 U4. R1.\nG72 W4. R1.\n" + cycle + " F0.2\n" + contour + "M30\n");
}

TEST(RoughingCycles, TypeTwoRefusesBeforeItMoves) {
  struct Refusal {
    const char *cycle, *contour, *why;
  };
  constexpr const char* kTurning = "G71 P10 Q20 U0 W0";
  for (const Refusal& each : {
           Refusal{kTurning, "N10 G00 X40. W0\nG01 Z-10.\nN20 G02 X40. Z-30. R12.\n", ""},
           // An arc over the start point, whose ends are below it.
           {kTurning, "N10 G00 X48. W0\nG01 Z-10.\nN20 G03 X48. Z-30. R12.\n", "beyond the start"},
           {kTurning, "N10 G00 X52. W0\nG01 X20. Z-10.\nN20 X48.\n", "beyond the start"},
           {kTurning, "N10 G00 X40. W0\nG01 X60. Z-10.\nN20 X48. Z-20.\n", "beyond the start"},
           // More than half a circle reverses.
           {kTurning, "N10 G00 X40. W0\nG01 Z-10.\nN20 G02 X40. Z-20. I-3. K-5.\n",
            "reverses along"},
           {kTurning, "N10 G01 X40. Z5.\nZ-10.\nN20 X48.\n", "reverses along"},
           {kTurning, "N10 G00 X50. W0\nG01 Z-5.\nN20 Z-10.\n", "does not leave"},
           {kTurning, "N10 G00 X40. W0\nG00 Z-10.\nN20 G01 X48.\n", "G00 within"},
           {"G71 P10 Q20 U-1. W0", "N10 G00 X40. W0\nG01 Z-10.\nN20 X48.\n", "leads into the part"},
           {"G71 P10 Q20 U1. W-0.1", "N10 G00 X40. W0\nG01 Z-10.\nN20 X48.\n",
            "leads into the part"},
           {"G71 P10 Q10 U0 W0", "N10 G00 X40. W0\nN20 G01 X48.\n", "no contour"},
           {"G72 P10 Q20 U0 W0", "N10 G00 U0 Z-10.\nG01 X30.\nX32. Z-12.\nN20 Z2.\n",
            "reverses along"},
           {"G72 P10 Q20 U-0.2 W0", "N10 G00 U0 Z0\nG01 X30.\nN20 Z2.\n", "leads into the part"},
           {"G72 P10 Q20 U0.2 W0.1", "N10 G00 U0 Z0\nG01 X40.\nZ-10.\nX30.\nN20 X20. Z0\n",
            "U leads into the part where the contour goes down"},
       }) {
    const MachineLog log = run_contour(each.cycle, each.contour);
    SCOPED_TRACE(each.contour);
    if (each.why[0] == 0) {
      EXPECT_EQ(log.alarm, "");
      continue;
    }
    EXPECT_NE(log.alarm.find(each.why), std::string::npos) << log.alarm;
    EXPECT_EQ(log.moves.size(), 1U);
  }
}

TEST(RoughingCycles, TypeTwoHasALimitOfCuts) {
  const MachineLog log =
      run("G00 X500. Z2.\nG71 U0.04 R1.\nG71 P10 Q20 U0 W0 F0.2\nN10 G00 X20. W0\nG01 Z-10.\n"
          "N20 X500.\nM30\n");
  EXPECT_NE(log.alarm.find("more than 5000 cuts"), std::string::npos) << log.alarm;
  EXPECT_EQ(log.moves.size(), 1U);
}

/// Another tool for the same contour, and the contour before its cycle.
TEST(RoughingCycles, TypeTwoCutsTheSameBlocksAgain) {
  const std::string contour = "N10 G00 X40. W0\nG01 Z-10.\nX20. Z-20.\nX40. Z-30.\nN20 Z-40.\n";
  const std::string begin = "G00 X50. Z2.\nG71 U3. R1.\n";
  const std::string cycle = "G71 P10 Q20 U0 W0 F0.2\n";
  const MachineLog once = run(begin + cycle + contour + "M30\n");
  const MachineLog twice = run(begin + cycle + contour + cycle + "M30\n");
  const MachineLog before = run("GOTO1\n" + contour + "N1" + begin + cycle + "M30\n");
  ASSERT_EQ(once.alarm + twice.alarm + before.alarm, "");
  ASSERT_EQ(twice.moves.size(), 2 * once.moves.size() - 1);
  ASSERT_EQ(before.moves.size(), once.moves.size());
  for (std::size_t i = 0; i < once.moves.size(); ++i) {
    EXPECT_TRUE(once.moves[i].to.same_point(before.moves[i].to));
    if (i == 0) continue;
    EXPECT_TRUE(once.moves[i].to.same_point(twice.moves[i + once.moves.size() - 1].to));
  }
}

TEST(RoughingCycles, TypeOneCutsToTheContour) {
  std::mt19937 random(20262);
  for (int n = 0; n < 500 && !HasFailure(); ++n) check(make_cycle(random, false));
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
