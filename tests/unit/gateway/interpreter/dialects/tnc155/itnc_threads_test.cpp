#include <fmt/core.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "tests/unit/gateway/interpreter/dialects/tnc155/milled_path.hpp"

/// Cycle 262 with random words: the hand and the pitch of the thread, its length, the direction of
/// the milling. IT-053.
namespace dripline::interpreter {
namespace {

struct ThreadWords {
  double diameter = 20, tool = 6, pitch = 2, depth = 15, surface = 0;
  int threads = 1, climb = 1;
  bool is_left_hand = false, is_mirrored = false;
};

MilledPath run(const ThreadWords& words, PlaneVector at) {
  std::string text = fmt::format(
      "BEGIN PGM T MM\nTOOL DEF 1 L+0 R+{}\nTOOL CALL 1 Z S1000\nL X{:+} Y{:+} Z+60 R0 "
      "FMAX M3\n",
      words.tool, at.first, at.second);
  if (words.is_mirrored) text += "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 Y\n";
  text += fmt::format(
      "CYCL DEF 262 THREAD ~\nQ335={} ;~\nQ239={} ;~\nQ201={} ;~\nQ355={} ;~\nQ253=750 ;~\nQ351={} "
      ";~\nQ200=2 ;~\nQ203={} ;~\nQ204=20 ;~\nQ207=500\n",
      words.diameter, words.is_left_hand ? -words.pitch : words.pitch, -words.depth, words.threads,
      words.climb, words.surface);
  const auto lines = static_cast<unsigned>(std::count(text.begin(), text.end(), '\n'));
  return mill(text + "CYCL CALL\nEND PGM T MM\n", "", lines + 1);
}

double angle_of(PlaneVector by) {
  return std::atan2(by.second, by.first) * (180 / Angle::kPi);
}

TEST(ItncThreads, HaveTheirHandPitchAndLength) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    ThreadWords words;
    words.tool = tenths(between(random, 1, 8));
    words.diameter = 2 * words.tool + tenths(between(random, 1, 20));
    words.pitch = tenths(between(random, 0.5, 4));
    words.depth = tenths(between(random, 1, 30));
    words.surface = tenths(between(random, -5, 5));
    words.climb = one_of(random, 2) == 0 ? 1 : -1;
    words.is_left_hand = one_of(random, 2) == 0;
    words.is_mirrored = one_of(random, 3) == 0;
    const bool goes_up = (words.climb > 0) != words.is_left_hand;
    constexpr int kThreads[] = {0, 1, 4};
    words.threads = kThreads[one_of(random, goes_up ? 3 : 2)];
    const PlaneVector at{tenths(between(random, -20, 20)), tenths(between(random, -20, 20))};
    const MilledPath path = run(words, at);
    ASSERT_EQ(path.alarm, "");
    const double radius = words.diameter / 2 - words.tool;
    const double bottom = words.surface - words.depth;
    double low = 1e9, high = -1e9, turned = 0;
    const MilledPoint* before = nullptr;
    for (const MilledPoint& point : path.points) {
      const PlaneVector by = point.at - at;
      const double away = std::hypot(by.first, by.second);
      ASSERT_LE(away, radius + 1e-4) << "beyond the thread";
      ASSERT_GE(point.height, bottom - words.pitch / 2 - 1e-4);
      if (before != nullptr && point.is_rapid && point.height < words.surface + 2 - 1e-4) {
        ASSERT_GE(point.height, before->height) << "rapid down below the clearance";
      }
      const bool is_on = std::fabs(away - radius) < 1e-4;
      const bool was_on = before != nullptr && std::fabs(std::hypot(before->at.first - at.first,
                                                                    before->at.second - at.second) -
                                                         radius) < 1e-4;
      if (is_on && was_on && !point.is_rapid) {
        double step = angle_of(by) - angle_of(before->at - at);
        step -= 360 * std::round(step / 360);
        const double climb = point.height - before->height;
        EXPECT_EQ(step > 0, words.climb > 0) << "counterclockwise is climb milling inside";
        EXPECT_NEAR(climb, (words.is_left_hand ? -1 : 1) * words.pitch * step / 360, 1e-3);
        low = std::min({low, point.height, before->height});
        high = std::max({high, point.height, before->height});
        turned += std::fabs(step);
      }
      before = &point;
    }
    EXPECT_NEAR(low, bottom, 1e-3);
    if (words.threads == 0) {
      EXPECT_NEAR(turned, 360, 0.1);
    }
    if (words.threads == 1) {
      EXPECT_NEAR(high, words.surface, 1e-3);
      EXPECT_NEAR(turned, 360 * words.depth / words.pitch, 1);
    }
    if (words.threads > 1) {
      const double paths = std::ceil(words.depth / (words.pitch * words.threads) - 1e-9);
      EXPECT_NEAR(turned, 360 * paths, 0.1 * paths);
      EXPECT_NEAR(high, bottom + ((paths - 1) * words.threads + 1) * words.pitch, 1e-3);
    }
    EXPECT_NEAR(before->height, words.surface + 20, 1e-4);
    EXPECT_NEAR(before->at.first, at.first, 1e-4);
    EXPECT_NEAR(before->at.second, at.second, 1e-4);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace dripline::interpreter
