#include <gtest/gtest.h>
#include <set>

#include "clients/tools/graphics/picture.hpp"
#include "clients/tools/graphics/views.hpp"

// Rows: HD-200 (3D view), HD-201 (three planes), HD-202 (plan views), HD-206 (hardcopy).
namespace dripline::graphics {
namespace {

/// 100 x 50 cells of 1 mm; a slot 6 deep from the left edge to the middle, a hole through.
HeightField part() {
  HeightField field = *HeightField::make({{0, 0, -20}, {100, 50, 0}}, 100);
  field.cut({-10, 25, -6}, {45, 25, -6}, 5);
  field.cut({80, 25, 1}, {80, 25, -25}, 8);
  return field;
}

TEST(PlanView, IsDarkerTheDeeperItIs) {
  const Picture plan = draw_plan(part(), {17});
  ASSERT_EQ(plan.width(), 100u);
  ASSERT_EQ(plan.height(), 50u);
  const Shade top = plan.at(60, 5), slot = plan.at(20, 25), hole = plan.at(80, 25);
  EXPECT_EQ(top, kWhite);
  EXPECT_LT(slot, top);
  EXPECT_EQ(hole, kBlack);
}

TEST(PlanView, HasAsManyStepsAsItsName) {
  HeightField field = *HeightField::make({{0, 0, -34}, {340, 10, 0}}, 340);
  for (int i = 0; i < 34; ++i) {
    const double u = 5 + 10 * i;
    field.cut({u, -20, -i - 0.5}, {u, 30, -i - 0.5}, 5);
  }
  for (const int shades : {5, 17}) {
    const Picture plan = draw_plan(field, {shades});
    std::set<Shade> seen;
    for (std::size_t x = 0; x < plan.width(); ++x) seen.insert(plan.at(x, 5));
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(shades));
  }
}

TEST(PlanesView, CutsWhereItIsTold) {
  const HeightField field = part();
  const auto front_top = [&](Arrangement arrangement) {
    PlanesView view;
    view.arrangement = arrangement;
    return draw_planes(field, view);
  };
  // 12 pixels between the parts; the sections are 20 high, the side 50 wide.
  const Picture din = front_top(Arrangement::Din);
  EXPECT_EQ(din.width(), 100u + 50 + 3 * 12);
  EXPECT_EQ(din.height(), 50u + 20 + 3 * 12);
  const Shade material = din.at(12 + 60, 12 + 1);
  EXPECT_NE(din.at(12 + 20, 12 + 1), material) << "the slot opens upwards";
  EXPECT_EQ(din.at(12 + 20, 12 + 8), material) << "below 6 mm the slot has its floor";
  EXPECT_NE(din.at(12 + 80, 12 + 19), material) << "the hole goes through";
  const Picture us = front_top(Arrangement::Us);
  EXPECT_EQ(us.at(12 + 60, 12 + 50 + 12 + 1), material) << "third angle: the front is below";
}

TEST(PlanesView, MirrorsTheSideBetweenTheArrangements) {
  HeightField field = *HeightField::make({{0, 0, -20}, {100, 50, 0}}, 100);
  field.cut({-10, 10, -6}, {110, 10, -6}, 5);  // near the front
  PlanesView view;
  const Picture din = draw_planes(field, view);
  view.arrangement = Arrangement::Us;
  const Picture us = draw_planes(field, view);
  const std::size_t side = 12 + 100 + 12, below = 12 + 50 + 12;
  EXPECT_NE(din.at(side + 39, 13), din.at(side + 10, 13));
  EXPECT_EQ(us.at(side + 10, below + 1), din.at(side + 39, 13));
}

TEST(SolidView, FromAboveIsThePlan) {
  SolidView view{Angle::degrees(0), Angle::degrees(90), 400, 300};
  const Picture above = draw_solid(part(), view);
  const Shade top = above.at(200, 60 + 60), background = above.at(200, 295);
  EXPECT_NE(top, background);
  // The hole, right of the middle: through it the background is seen.
  const double scale = 0.94 * 400 / 100;
  EXPECT_EQ(above.at(static_cast<std::size_t>(200 + 30 * scale), 150), background);
  EXPECT_LT(above.at(static_cast<std::size_t>(200 - 30 * scale), 150), top) << "deeper is darker";
}

TEST(SolidView, ShowsAnotherSideWhenTurned) {
  const HeightField field = part();
  const auto drawn = [&](double rotation) {
    return draw_solid(field, {Angle::degrees(rotation), Angle::degrees(30), 160, 120})
        .png()
        .value();
  };
  EXPECT_NE(drawn(0), drawn(90));
  EXPECT_EQ(drawn(20), drawn(380));
}

TEST(Pictures, ArePngFiles) {
  const std::string bytes = Picture(300, 200, 128).png().value();
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\1\x2c\0\0\0\xc8", 8)) << "300 x 200";
  EXPECT_EQ(bytes[24], 8) << "bits";
  EXPECT_EQ(bytes[25], 0) << "gray";
}

TEST(Printers, KnowTheBytesOfTheirParameters) {
  using Bytes = std::vector<std::uint8_t>;
  const Printer epson = find_printer("epson").value();
  EXPECT_EQ(epson.before_picture, (Bytes{0x1b, 0x43, 0x41, 0x1b, 0x33, 0x16, 0x0a}));
  EXPECT_EQ(epson.before_line, (Bytes{0x0a, 0x1b, 0x4b, 0x00, 0x02}));
  const Printer ti = find_printer("ti-850").value();
  EXPECT_EQ(ti.before_picture, (Bytes{0x1b, 0x43, 0x30, 0x1b, 0x41, 0x08, 0x0c}));
  EXPECT_EQ(ti.before_line, (Bytes{0x0a, 0x1b, 0x4e, 0x00, 0x02}));
  EXPECT_EQ(find_printer("laser").error().code, Errc::NotFound);
  const std::uint16_t too_many[4] = {8 << 8, 0, 0, 0};
  EXPECT_EQ(printer_bytes(too_many).error().code, Errc::LimitExceeded);
  const auto own = printer_of_parameters({1819, 17200, 6977, 2060, 1290, 6990, 2, 0});
  ASSERT_TRUE(own) << own.error().what;
  EXPECT_EQ(own->before_picture, ti.before_picture);
  EXPECT_EQ(own->before_line, ti.before_line);
  EXPECT_EQ(printer_of_parameters({0, 0, 0, 0, 2048, 0, 0, 0}).error().what,
            "MP230: 8 bytes: a group of four words holds 7");
}

TEST(Hardcopies, HaveEightRowsALineAndTheUpperInTheHighestBit) {
  Picture picture(512, 16, kWhite);
  for (std::size_t x = 0; x < 512; ++x) picture.set(x, 8, kBlack);
  picture.set(3, 0, kBlack);
  const Printer printer = find_printer("epson").value();
  const std::string bytes = hardcopy(picture, printer);
  const std::size_t head = 7, line = 5 + 512;
  ASSERT_EQ(bytes.size(), head + 2 * line);
  EXPECT_EQ(static_cast<unsigned char>(bytes[head + 5 + 3]), 0x80);
  EXPECT_EQ(bytes[head + 5 + 4], 0);
  EXPECT_EQ(static_cast<unsigned char>(bytes[head + line + 5 + 200]), 0x80);
}

TEST(Hardcopies, PrintGrayAsAPatternAndWidePicturesSmaller) {
  const Printer printer = find_printer("epson").value();
  const std::string gray = hardcopy(Picture(1024, 16, 128), printer);
  ASSERT_EQ(gray.size(), 7u + 5 + 512) << "half as wide and as high";
  int dots = 0;
  for (std::size_t i = 12; i < gray.size(); ++i) {
    dots += __builtin_popcount(static_cast<unsigned char>(gray[i]));
  }
  EXPECT_NEAR(dots, 512 * 8 * 0.5, 512 * 8 * 0.1);
}

}  // namespace
}  // namespace dripline::graphics
