#include "clients/tools/measurement_files/points.hpp"

#include <gtest/gtest.h>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "tests/unit/clients/tools/measurement_files/sample.hpp"

namespace dripline::measurement_files {
namespace {

/// Passes in x over a dome, as a digitizing cycle makes them.
std::vector<DigitizedPoint> dome() {
  std::vector<DigitizedPoint> points;
  for (int row = 0; row <= 10; ++row)
    for (int column = 0; column <= 20; ++column) {
      const double x = column, y = row;
      points.push_back({x, y, 5 - 0.02 * ((x - 10) * (x - 10) + (y - 5) * (y - 5))});
    }
  return points;
}

TEST(Points, ComeFromTheMeasurementsOfOneRecord) {
  std::vector<measurement::Measurement> all;
  for (int record = 0; record < 3; ++record) {
    for (const char* axis : {"X", "Z"}) {
      measurement::Measurement m;
      m.record = {1, static_cast<std::uint64_t>(record + 1)};
      m.characteristic.name = std::string("Point ") + axis;
      m.actual = record + (*axis == 'Z' ? 10 : 0);
      all.push_back(m);
    }
  }
  all[0].characteristic.unit = "inch";
  all[0].actual = 1;
  ListSource source(all);
  const auto points = points_of(source);
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), 3U);
  EXPECT_DOUBLE_EQ((*points)[0].x, 25.4);
  EXPECT_EQ((*points)[2].x, 2);
  EXPECT_EQ((*points)[2].y, 12);  // a contour in X and Z lies in the plane
}

/// A program of a lathe prints X as it is programmed; a contour of diameters is no shape.
TEST(Points, OfDiametersAreRadii) {
  std::vector<measurement::Measurement> all;
  for (const auto& [axis, value] : {std::pair("X", 40.0), std::pair("Z", -5.0)}) {
    measurement::Measurement m;
    m.record = {1, 1};
    m.characteristic.name = axis;
    m.actual = value;
    all.push_back(m);
  }
  ListSource diameters(all);
  const auto radii = points_of(diameters, PointX::Diameter);
  ASSERT_TRUE(radii);
  EXPECT_EQ(radii->front().x, 20);
  EXPECT_EQ(radii->front().y, -5);
  ListSource as_they_are(all);
  EXPECT_EQ(points_of(as_they_are)->front().x, 40);
  EXPECT_EQ(parse_point_x("diameter").value(), PointX::Diameter);
  EXPECT_EQ(parse_point_x("both").error().what, "x is 'both': radius or diameter");
}

TEST(Points, CsvComesBack) {
  const std::string file =
      written([&](const Sink& sink) { return write_points_csv(dome(), sink); });
  EXPECT_TRUE(file.starts_with("x,y,z\r\n0.000,0.000,2.5"));
  const auto points = read_points(file);
  ASSERT_TRUE(points) << points.error().what;
  ASSERT_EQ(points->size(), dome().size());
  for (std::size_t i = 0; i < points->size(); ++i) EXPECT_EQ((*points)[i].z, dome()[i].z);
  EXPECT_EQ(read_points("1 2\n3;4\n")->size(), 2U);
  EXPECT_EQ(read_points("1 2\n3\n").error().what, "line 2: two or three numbers are expected");
  EXPECT_FALSE(read_points("1 2\n1 2 3 4\n"));
}

TEST(Points, DxfHasAPolylineForEachPass) {
  const std::string file = written([&](const Sink& sink) { return write_dxf(dome(), 0, sink); });
  const auto count = [&](std::string_view what) {
    std::size_t found = 0;
    for (auto at = file.find(what); at != std::string::npos; at = file.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("\r\nPOINT\r\n"), 231U);
  EXPECT_EQ(count("\r\nPOLYLINE\r\n"), 11U);
  EXPECT_EQ(count("\r\nSEQEND\r\n"), 11U);
  EXPECT_EQ(count("\r\nVERTEX\r\n"), 231U);
  EXPECT_TRUE(file.ends_with("0\r\nENDSEC\r\n0\r\nEOF\r\n"));
  EXPECT_NE(file.find("AC1009"), std::string::npos);
}

TEST(HeightGrid, HoldsThePointsAndFillsHoles) {
  auto points = dome();
  points.erase(points.begin() + 115);  // the middle
  const auto grid = make_height_grid(points, 1);
  ASSERT_TRUE(grid) << grid.error().what;
  EXPECT_EQ(grid->columns, 21U);
  EXPECT_EQ(grid->rows, 11U);
  EXPECT_EQ(grid->filled, 1U);
  EXPECT_NEAR(grid->heights[5 * 21 + 10], 4.98, 1e-9);  // of its four neighbors
  EXPECT_NEAR(grid->heights[0], 2.5, 1e-9);
  EXPECT_FALSE(
      make_height_grid(std::vector<DigitizedPoint>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 0));
  EXPECT_FALSE(make_height_grid(points, 1e-6));
}

using Corner = std::array<float, 3>;

// Closed: each edge belongs to two triangles, in opposite directions. Its volume is that of base
// and dome.
TEST(Stl, IsAClosedSolid) {
  const auto grid = make_height_grid(dome(), 1);
  ASSERT_TRUE(grid);
  const std::string stl = written([&](const Sink& sink) { return write_stl(*grid, 2, sink); });
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, stl.data() + 80, 4);
  ASSERT_EQ(stl.size(), 84 + 50 * static_cast<std::size_t>(triangles));
  EXPECT_FALSE(stl.starts_with("solid"));
  std::map<std::pair<Corner, Corner>, int> edges;
  double volume = 0, surface = 0;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    std::array<Corner, 4> t{};
    std::memcpy(t.data(), stl.data() + 84 + 50 * static_cast<std::size_t>(i), 48);
    for (int side = 0; side < 3; ++side) ++edges[{t[1 + side], t[1 + (side + 1) % 3]}];
    const auto& [a, b, c] = std::tie(t[1], t[2], t[3]);
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0])) /
              6.0;
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  const double floor_z = 2.5 - 2;
  for (std::size_t row = 0; row < 10; ++row)
    for (std::size_t column = 0; column < 20; ++column) {
      const auto z = [&](std::size_t c, std::size_t r) {
        return grid->heights[r * 21 + c] - floor_z;
      };
      const double diagonal = z(column, row) + z(column + 1, row + 1);
      surface += (2 * diagonal + z(column + 1, row) + z(column, row + 1)) / 6;
    }
  EXPECT_NEAR(volume, surface, 0.01);
  EXPECT_EQ(written([&](const Sink& sink) { return write_stl({}, 1, sink); }),
            "error: an STL of 0 x 0 heights on a base of 1");
}

TEST(HeightGrid, FillsALongHoleFromItsEdges) {
  // Two rows of points, 40 cells apart: the middle is between them.
  std::vector<DigitizedPoint> points;
  for (int x = 0; x <= 20; ++x) {
    points.push_back({double(x), 0, 1});
    points.push_back({double(x), 40, 3});
  }
  const auto grid = make_height_grid(points, 1);
  ASSERT_TRUE(grid) << grid.error().what;
  EXPECT_EQ(grid->filled, 39U * 21U);
  EXPECT_NEAR(grid->heights[10], 1, 1e-9);
  EXPECT_NEAR(grid->heights[19 * 21 + 10], 1, 1e-9) << "nearer to the first row";
  EXPECT_NEAR(grid->heights[20 * 21 + 10], 2, 1e-9);
  EXPECT_NEAR(grid->heights[21 * 21 + 10], 3, 1e-9);
}

TEST(HeightGrid, RestsOnPoints) {
  const std::vector<DigitizedPoint> far{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {150, 150, 1}};
  EXPECT_EQ(make_height_grid(far, 0.1).error().what,
            "a height field of 1501 x 1501 cells, 4 of them with a point: one of 200 is needed, "
            "with larger cells it has more");
  EXPECT_TRUE(make_height_grid(far, 10)) << "a small one is filled";
}

TEST(Points, BeyondAMachineAreRefusedByTheirValue) {
  std::vector<measurement::Measurement> all;
  for (const auto& [name, value] :
       {std::pair("X", 1.0), std::pair("Y", 2.0), std::pair("Z", 1e308)}) {
    auto& one = all.emplace_back();
    one.characteristic.name = name;
    one.actual = value;
  }
  ListSource source(all);
  EXPECT_EQ(points_of(source).error().what,
            "a digitized point at 1e+308 mm: -1e+09 to 1e+09 are possible");
  EXPECT_FALSE(make_height_grid(
      std::vector<DigitizedPoint>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e10}}, 1));
}

// 200,000 points: a pass through each output takes well under a second.
TEST(Points, ManyOfThemAreWrittenInLinearTime) {
  std::vector<DigitizedPoint> points;
  for (int i = 0; i < 200'000; ++i)
    points.push_back({i % 500 * 0.1, i / 500 * 0.1, 0.001 * (i % 7)});
  std::size_t bytes = 0, pieces = 0;
  const Sink sink = [&](std::string_view piece) -> Result<void> {
    bytes += piece.size();
    ++pieces;
    return {};
  };
  ASSERT_TRUE(write_dxf(points, 0, sink));
  EXPECT_GT(bytes, 20'000'000U);
  EXPECT_GT(pieces, 100U) << "memory does not grow with the file";
  const auto grid = make_height_grid(points, 0);
  ASSERT_TRUE(grid) << grid.error().what;
  EXPECT_EQ(grid->filled, 0U);
  bytes = 0;
  ASSERT_TRUE(write_stl(*grid, 5, sink));
  EXPECT_EQ(bytes, 84 + 50U * (4U * 499 * 399 + 4U * (499 + 399)));
}

}  // namespace
}  // namespace dripline::measurement_files
