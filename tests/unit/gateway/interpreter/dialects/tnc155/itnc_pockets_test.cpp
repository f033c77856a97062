#include <fmt/core.h>
#include <gtest/gtest.h>
#include <cmath>

#include "tests/unit/gateway/interpreter/dialects/tnc155/milled_path.hpp"

/// Cycles 251 to 254 with random words: the region between surface and bottom, and how it is cut.
/// IT-052.
namespace dripline::interpreter {
namespace {

const std::string kAngle = "[control]\nplunge_angle = 8\n";

struct Words {
  int extent = 0, climb = 1, plunge = 0;
  double tool = 3, side = 0, floor = 0, depth = 10, infeed = 3, finish = 0, overlap = 1;
  double surface = 0, clearance = 2, second = 20;
};

Words random_words(std::mt19937& random, int cycle) {
  Words words;
  words.extent = one_of(random, 2);
  words.climb = one_of(random, 2) == 0 ? 1 : -1;
  words.plunge = one_of(random, cycle == 252 ? 2 : 3);
  words.tool = tenths(between(random, 1, 4));
  words.side = one_of(random, 2) * tenths(between(random, 0.1, 0.6));
  words.floor = one_of(random, 2) * tenths(between(random, 0.1, 0.6));
  words.depth = tenths(between(random, 1, 12));
  words.infeed = tenths(between(random, 0.8, 6));
  words.finish = one_of(random, 2) * tenths(between(random, 1, 6));
  words.overlap = tenths(between(random, 0.3, 1.9));
  words.surface = tenths(between(random, -5, 5));
  return words;
}

std::string common(const Words& words, bool overlaps) {
  std::string text = fmt::format(
      "Q215={} ;~\nQ368={} ;~\nQ207=500 ;~\nQ351={} ;~\nQ201={} ;~\nQ202={} ;~\nQ369={} ;~\n"
      "Q206=150 ;~\nQ338={} ;~\nQ200={} ;~\nQ203={} ;~\nQ204={} ;~\nQ366={} ;~\nQ385=400",
      words.extent, words.side, words.climb, -words.depth, words.infeed, words.floor, words.finish,
      words.clearance, words.surface, words.second, words.plunge);
  if (overlaps) text += fmt::format(" ;~\nQ370={}", words.overlap);
  return text;
}

struct Place {
  double x = 0, y = 0;
  bool is_mirrored = false;
};

MilledPath run(const Words& words, const std::string& definition, bool overlaps, Place at) {
  std::string text =
      fmt::format("BEGIN PGM P MM\nTOOL DEF 1 L+0 R+{}\nTOOL CALL 1 Z S1000\n", words.tool);
  text += fmt::format("L X{:+} Y{:+} Z+60 R0 FMAX M3\n", at.is_mirrored ? -at.x : at.x, at.y);
  if (at.is_mirrored) text += "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n";
  text += "CYCL DEF " + definition + " ~\n" + common(words, overlaps) + "\n";
  const auto lines = static_cast<unsigned>(std::count(text.begin(), text.end(), '\n'));
  return mill(text + "CYCL CALL\nEND PGM P MM\n", kAngle, lines + 1);
}

MilledRegion region_of(const Words& words) {
  MilledRegion region;
  region.tool = words.tool;
  region.surface = words.surface;
  const bool finishes = words.extent != 1;
  region.bottom = words.surface - words.depth + (finishes ? 0 : words.floor);
  region.allowance = finishes ? 0 : words.side;
  region.clearance = words.surface + words.clearance;
  if (words.extent == 1) region.infeed = words.infeed;
  region.is_counterclockwise = words.climb > 0;
  return region;
}

/// In a mirror image the machine mills in the direction that Q351 states; the region is mirrored.
WallDistance mirrored(const WallDistance& wall, bool is_mirrored) {
  if (!is_mirrored) return wall;
  return [wall](PlaneVector at) { return wall({-at.first, at.second}); };
}

void expect_end(const MilledPath& path, const Words& words, PlaneVector at) {
  const MilledPoint& last = path.points.back();
  EXPECT_NEAR(last.height, words.surface + words.second, 1e-4);
  EXPECT_NEAR(last.at.first, at.first, 1e-4);
  EXPECT_NEAR(last.at.second, at.second, 1e-4);
}

TEST(ItncPockets, RectanglesAreCutToTheirWall) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Words words = random_words(random, 251);
    const double least = 2 * (words.tool + words.side) + 0.4;
    const PlaneVector sides{tenths(between(random, least, least + 30)),
                            tenths(between(random, least, least + 30))};
    const double most = std::min(sides.first, sides.second) / 2;
    const double corner = one_of(random, 2) * std::floor(between(random, 0, most) * 10) / 10;
    const double angle = tenths(between(random, -180, 180));
    const int place = one_of(random, 5);
    const Place at{tenths(between(random, -20, 20)), tenths(between(random, -20, 20)),
                   one_of(random, 3) == 0};
    const MilledPath path =
        run(words,
            fmt::format("251 POCKET ~\nQ218={} ;~\nQ219={} ;~\nQ220={} ;~\nQ224={} ;~\nQ367={} ;",
                        sides.first, sides.second, corner, angle, place),
            true, at);
    const double radians = angle * (Angle::kPi / 180);
    const PlaneVector u{std::cos(radians), std::sin(radians)}, v{-u.second, u.first};
    constexpr double kFirst[] = {0, 1, -1, -1, 1}, kSecond[] = {0, 1, 1, -1, -1};
    const PlaneVector center = PlaneVector{at.x, at.y} + (kFirst[place] * sides.first / 2) * u +
                               (kSecond[place] * sides.second / 2) * v;
    MilledRegion region = region_of(words);
    region.figures = {mirrored(rectangle_wall(center, angle, sides, std::max(corner, words.tool)),
                               at.is_mirrored)};
    region.middle = {at.is_mirrored ? -center.first : center.first, center.second};
    region.width = std::hypot(sides.first, sides.second);
    if (words.plunge != 0 && path.alarm.find("Q366") != std::string::npos) continue;
    expect_region(path, region, random);
    if (HasFatalFailure()) return;
    expect_end(path, words, {at.is_mirrored ? -at.x : at.x, at.y});
  }
}

TEST(ItncPockets, CirclesAreCutToTheirWall) {
  int milled = 0;
  for (unsigned seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Words words = random_words(random, 252);
    const double least = 2 * (words.tool + words.side) + 0.2;
    const double diameter = tenths(between(random, least, least + 30));
    const Place at{tenths(between(random, -20, 20)), tenths(between(random, -20, 20)), false};
    const MilledPath path = run(words, fmt::format("252 POCKET ~\nQ223={} ;", diameter), true, at);
    if (words.plunge != 0 && path.alarm.find("Q366") != std::string::npos) continue;
    MilledRegion region = region_of(words);
    region.figures = {round_wall({at.x, at.y}, diameter)};
    region.middle = {at.x, at.y};
    region.width = diameter;
    expect_region(path, region, random);
    if (HasFatalFailure()) return;
    expect_end(path, words, {at.x, at.y});
    ++milled;
  }
  EXPECT_GT(milled, 60);
}

TEST(ItncPockets, SlotsAreCutToTheirWall) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Words words = random_words(random, 253);
    const double least = 2 * (words.tool + words.side);
    const double width = one_of(random, 4) == 0 ? least : tenths(between(random, least, 6 * least));
    const double length = tenths(between(random, width + 2, width + 40));
    const double angle = tenths(between(random, -180, 180));
    const int place = one_of(random, 5);
    const Place at{tenths(between(random, -20, 20)), tenths(between(random, -20, 20)), false};
    const MilledPath path = run(words,
                                fmt::format("253 SLOT ~\nQ218={} ;~\nQ219={} ;~\nQ374={} ;~\n"
                                            "Q367={} ;",
                                            length, width, angle, place),
                                false, at);
    const double radians = angle * (Angle::kPi / 180);
    const double by[] = {0, length / 2, (length - width) / 2, (width - length) / 2, -length / 2};
    const PlaneVector center{at.x + by[place] * std::cos(radians),
                             at.y + by[place] * std::sin(radians)};
    MilledRegion region = region_of(words);
    region.figures = {slot_wall(center, angle, length, width)};
    region.middle = center;
    region.width = length;
    region.is_as_wide_as_tool = width < least + 0.01;
    expect_region(path, region, random);
    if (HasFatalFailure()) return;
    if (place == 0) expect_end(path, words, {at.x, at.y});
  }
}

TEST(ItncPockets, RoundSlotsAreCutToTheirWall) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Words words = random_words(random, 254);
    const double least = 2 * (words.tool + words.side);
    const double width = one_of(random, 4) == 0 ? least : tenths(between(random, least, 4 * least));
    const double diameter = tenths(between(random, width + 10, width + 60));
    const double angle = tenths(between(random, -180, 180));
    const double span = one_of(random, 6) == 0 ? 360 : tenths(between(random, 30, 300));
    const int count = 1 + one_of(random, 3);
    const double step = tenths(between(random, -90, 90));
    const Place at{tenths(between(random, -20, 20)), tenths(between(random, -20, 20)), false};
    const PlaneVector center{tenths(between(random, -20, 20)), tenths(between(random, -20, 20))};
    const MilledPath path =
        run(words,
            fmt::format("254 SLOT ~\nQ219={} ;~\nQ375={} ;~\nQ367=0 ;~\nQ216={} ;~\nQ217={} ;~\n"
                        "Q376={} ;~\nQ248={} ;~\nQ378={} ;~\nQ377={} ;",
                        width, diameter, center.first, center.second, angle, span, step, count),
            false, at);
    // One after the other: their regions may overlap.
    MilledRegion region = region_of(words);
    if (count > 1) region.infeed = 0;
    for (int n = 0; n < count; ++n)
      region.figures.push_back(
          round_slot_wall(center, diameter / 2, angle + n * step, span, width));
    region.middle = center;
    region.width = diameter + width;
    region.is_as_wide_as_tool = width < least + 0.01;
    expect_region(path, region, random);
    if (HasFatalFailure()) return;
    expect_end(path, words, center);
  }
}

// The tool keeps its radius where a scaling halves the slot; an inch program states all of it in
// inches.
TEST(ItncPockets, FollowRotationScalingAndInches) {
  struct Case {
    const char* units;
    const char* before;
    double scale, rotation;
  };
  for (const Case& with :
       {Case{"MM",
             "CYCL DEF 10.0 A\nCYCL DEF 10.1 ROT+30\nCYCL DEF 11.0 A\nCYCL DEF 11.1 SCL 0.5\n", 0.5,
             30},
        Case{"INCH", "", 25.4, 0}}) {
    SCOPED_TRACE(with.units);
    const bool is_inch = with.scale > 1;
    const double tool = is_inch ? 0.2 * with.scale : 2;
    std::string text = fmt::format(
        "BEGIN PGM P {0}\nTOOL DEF 1 L+0 R+{1}\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+6 R0 FMAX M3\n{2}"
        "L X+1 Y+2 FMAX\nCYCL DEF 253 SLOT ~\nQ218={3} ;~\nQ219={4} ;~\nQ374=20 ;~\nQ367=0 ;~\n",
        with.units, is_inch ? 0.2 : 2, with.before, is_inch ? 3 : 40, is_inch ? 1.5 : 20);
    text +=
        "Q215=0 ;~\nQ368=0.1 ;~\nQ207=50 ;~\nQ351=1 ;~\nQ201=-2 ;~\nQ202=0.7 ;~\nQ369=0.1 ;~\n"
        "Q206=15 ;~\nQ338=0 ;~\nQ200=0.5 ;~\nQ203=0 ;~\nQ204=3 ;~\nQ366=1 ;~\nQ385=40\n";
    const auto lines = static_cast<unsigned>(std::count(text.begin(), text.end(), '\n'));
    const MilledPath path =
        mill(text + fmt::format("CYCL CALL\nEND PGM P {}\n", with.units), kAngle, lines + 1);
    const double radians = with.rotation * (Angle::kPi / 180);
    const PlaneVector center = with.scale * PlaneVector{std::cos(radians) - 2 * std::sin(radians),
                                                        std::sin(radians) + 2 * std::cos(radians)};
    MilledRegion region;
    region.tool = tool;
    region.figures = {slot_wall(center, 20 + with.rotation, (is_inch ? 3 : 40) * with.scale,
                                (is_inch ? 1.5 : 20) * with.scale)};
    region.middle = center;
    region.width = (is_inch ? 3 : 40) * with.scale;
    region.bottom = -2 * with.scale;
    region.clearance = 0.5 * with.scale;
    std::mt19937 random(1);
    expect_region(path, region, random);
    if (HasFatalFailure()) return;
    EXPECT_NEAR(path.points.back().height, 3 * with.scale, 1e-4);
  }
}

}  // namespace
}  // namespace dripline::interpreter
