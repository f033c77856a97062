#include "clients/tools/charts/pictures.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <string>

namespace dripline::charts {
namespace {

/// Remembers what was drawn.
class RecordingCanvas final : public Canvas {
 public:
  RecordingCanvas(double width, double height) : width_(width), height_(height) {}
  double width() const override { return width_; }
  double height() const override { return height_; }
  void polyline(std::span<const Point> points, const Pen& pen) override {
    for (const Point& point : points) note(point);
    if (pen.color.red == kLimit.red && pen.dash == Dash::Dashed) ++limit_lines;
  }
  void polygon(std::span<const Point> points, Color) override {
    for (const Point& point : points) note(point);
    ++areas;
  }
  void circle(Point center, double radius, Color fill, const Pen&) override {
    note(center);
    if (fill.red == kLimit.red && radius >= 3) ++marks;
    ++circles;
  }
  void text(Point at, std::string_view text, const TextStyle& style) override {
    note(at);
    texts.emplace_back(text);
    smallest = std::min(smallest, style.size);
  }
  bool shows(const std::string& words) const {
    return std::ranges::any_of(texts,
                               [&](const auto& t) { return t.find(words) != std::string::npos; });
  }

  std::vector<std::string> texts;
  int circles = 0, marks = 0, areas = 0, limit_lines = 0, outside = 0;
  double smallest = 100;

 private:
  void note(Point at) {
    if (!(at.x >= -0.01 && at.x <= width_ + 0.01 && at.y >= -0.01 && at.y <= height_ + 0.01))
      ++outside;
  }
  double width_, height_;
};

const Caption kCaption{"Diameter on lathe-1", "2026-11-02 to 2026-11-20", "mm"};

std::vector<double> drifting_values() {
  std::vector<double> values;
  for (int i = 0; i < 40; ++i)
    values.push_back(40 + 0.004 * std::sin(i * 2.4) + (i > 30 ? 0.002 * (i - 30) : 0));
  return values;
}

class Sizes : public testing::TestWithParam<Point> {};
INSTANTIATE_TEST_SUITE_P(
    , Sizes, testing::Values(Point{960, 600}, Point{kMinWidth, kMinHeight}, Point{2400, 1350}),
    [](const auto& i) { return "w" + std::to_string(static_cast<int>(i.param.x)); });

TEST_P(Sizes, AControlChartNamesItsUnitCountAndOriginOfLimits) {
  const auto values = drifting_values();
  const auto baseline = statistics::estimate_baseline(
      std::span(values).first(20), statistics::ChartKind::Individuals, 1, "runs 1f3a to 77b0");
  const auto chart =
      statistics::make_control_chart(values, *baseline, {.rules = statistics::RuleSet::Nelson});
  ASSERT_TRUE(chart);
  RecordingCanvas canvas(GetParam().x, GetParam().y);
  draw_control_chart(canvas, *chart, kCaption);
  EXPECT_TRUE(canvas.shows("X, mm"));
  EXPECT_TRUE(canvas.shows("MR, mm"));
  EXPECT_TRUE(canvas.shows("40 values"));
  EXPECT_TRUE(canvas.shows("UCL 40.0"));
  EXPECT_GT(canvas.marks, 0);
  EXPECT_EQ(canvas.outside, 0);
  EXPECT_GE(canvas.smallest, 9);
  EXPECT_TRUE(canvas.shows("limits computed from 20 values"));
  EXPECT_TRUE(canvas.shows("Nelson"));
}

TEST_P(Sizes, AHistogramShowsLimitsCurveAndIndices) {
  const auto values = drifting_values();
  HistogramPicture picture{.histogram = statistics::make_histogram(values).value(),
                           .summary = statistics::summarize(values),
                           .tolerance = {39.98, 40.03},
                           .nominal = 40,
                           .capability = {}};
  picture.capability = statistics::capability(values, picture.tolerance, {}).value();
  RecordingCanvas canvas(GetParam().x, GetParam().y);
  draw_histogram(canvas, picture, kCaption);
  EXPECT_TRUE(canvas.shows("lower 39.98"));
  EXPECT_TRUE(canvas.shows("upper 40.03"));
  EXPECT_TRUE(canvas.shows("nominal 40.0"));
  EXPECT_TRUE(canvas.shows("40 values"));
  EXPECT_TRUE(canvas.shows("Cpk"));
  EXPECT_GE(canvas.areas, 3);
  EXPECT_EQ(canvas.limit_lines, 2);
  EXPECT_EQ(canvas.outside, 0);
}

TEST_P(Sizes, ATrendStartsEveryToolAtZeroAndNamesItsSlope) {
  TrendPicture picture;
  picture.tolerance = {39.98, 40.02};
  picture.nominal = 40;
  for (int life = 0; life < 3; ++life) {
    ToolLife& of = picture.lives.emplace_back();
    of.tool = "T3 2026-11-0" + std::to_string(life + 1);
    for (int i = 0; i < 20; ++i) of.points.push_back({i + 1.0, 39.995 + 0.001 * i + 0.001 * life});
  }
  RecordingCanvas canvas(GetParam().x, GetParam().y);
  draw_trend(canvas, picture, kCaption);
  EXPECT_TRUE(canvas.shows("60 values of 3 tool lives"));
  EXPECT_TRUE(canvas.shows("slope +0.10"));
  EXPECT_TRUE(canvas.shows("T3 2026-11-01"));
  EXPECT_EQ(canvas.outside, 0);
}

TEST_P(Sizes, AProfileMarksWhatIsOutsideItsLimits) {
  ProfilePicture picture;
  for (int i = 0; i <= 100; ++i) {
    const double u = i * 0.5, v = 10 + 3 * std::sin(i * 0.06);
    picture.nominal.push_back({u, v});
    picture.actual.push_back({u + 0.01, v + 0.01 * std::cos(i * 0.3) + (i == 50 ? 0.04 : 0)});
  }
  picture.lower = -0.02;
  picture.upper = 0.02;
  RecordingCanvas canvas(GetParam().x, GetParam().y);
  ASSERT_TRUE(draw_profile(canvas, picture, kCaption));
  EXPECT_EQ(canvas.marks, 2);  // in both plots
  EXPECT_TRUE(canvas.shows("1 points outside the limits"));
  EXPECT_TRUE(canvas.shows("101 points, deviation"));
  EXPECT_TRUE(canvas.shows("times as large"));
  EXPECT_EQ(canvas.outside, 0);
}

TEST(Pictures, CusumAndEwmaDrawTheirOwnLimits) {
  const auto values = drifting_values();
  const auto baseline = statistics::fixed_baseline(40, 0.003, "");
  for (const auto kind : {statistics::ChartKind::Ewma, statistics::ChartKind::Cusum}) {
    const auto chart = statistics::make_control_chart(values, *baseline, {.kind = kind});
    ASSERT_TRUE(chart);
    RecordingCanvas canvas(800, 500);
    draw_control_chart(canvas, *chart, kCaption);
    if (kind == statistics::ChartKind::Cusum) {
      EXPECT_EQ(canvas.marks, static_cast<int>(chart->panels[0].violations.size()))
          << "one row each";
    }
    EXPECT_TRUE(canvas.shows("limits fixed"));
    EXPECT_EQ(canvas.limit_lines, 2);
    EXPECT_EQ(canvas.outside, 0);
  }
}

TEST(Pictures, OneValueAndEqualValuesAreDrawn) {
  RecordingCanvas canvas(800, 500);
  draw_trend(canvas, {.lives = {{"T1", {{1, 40}}}}, .tolerance = {}, .nominal = {}}, kCaption);
  draw_trend(canvas, {.lives = {}, .tolerance = {}, .nominal = {}}, kCaption);
  const std::vector<double> same(12, 40.0);
  draw_histogram(canvas,
                 {.histogram = statistics::make_histogram(same).value(),
                  .summary = statistics::summarize(same),
                  .tolerance = {},
                  .nominal = {},
                  .capability = {}},
                 kCaption);
  EXPECT_EQ(canvas.outside, 0);
}

}  // namespace
}  // namespace dripline::charts
