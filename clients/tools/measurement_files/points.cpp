#include "clients/tools/measurement_files/points.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>

#include "protocol/base/units.hpp"

namespace dripline::measurement_files {
namespace {

double distance(const DigitizedPoint& a, const DigitizedPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Of neighbors in the order of their measuring; 0: fewer than two points.
double median_distance(std::span<const DigitizedPoint> points) {
  std::vector<double> distances;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double between = distance(points[i - 1], points[i]);
    if (between > 0) distances.push_back(between);
  }
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return *middle;
}

/// Writes in pieces, so that no file is built in memory.
class Pieces {
 public:
  explicit Pieces(const Sink& sink) : sink_(sink) {}
  std::string text;
  Result<void> pass_on(std::size_t least = 64 * 1024) {
    if (text.size() < least) return {};
    auto done = sink_(text);
    text.clear();
    return done;
  }

 private:
  const Sink& sink_;
};

Result<void> check_place(const DigitizedPoint& point) {
  for (const double value : {point.x, point.y, point.z}) {
    if (std::abs(value) <= kMaxPlace) continue;
    return fail(Errc::LimitExceeded, "a digitized point at {:g} mm: {:g} to {:g} are possible",
                value, -kMaxPlace, kMaxPlace);
  }
  return {};
}

struct PendingPoint {
  measurement::RecordKey record;
  std::string machine;
  std::array<std::optional<double>, 3> at;
};

}  // namespace

Result<PointX> parse_point_x(std::string_view text) {
  if (text == "radius") return PointX::Radius;
  if (text == "diameter") return PointX::Diameter;
  return fail(Errc::Syntax, "x is '{}': radius or diameter", text);
}

void make_radii(std::vector<DigitizedPoint>& points, PointX x) {
  if (x == PointX::Radius) return;
  for (DigitizedPoint& point : points) point.x /= 2;
}

Result<std::vector<DigitizedPoint>> points_of(MeasurementSource& source, PointX x) {
  std::vector<DigitizedPoint> points;
  PendingPoint pending;
  const auto close = [&] {
    if (pending.at[0] && pending.at[1])
      points.push_back({*pending.at[0], *pending.at[1], pending.at[2].value_or(0)});
    if (pending.at[0] && !pending.at[1] && pending.at[2])
      points.push_back({*pending.at[0], *pending.at[2], 0});
    pending.at = {};
  };
  auto done = source.each([&](const measurement::Measurement& m) -> Result<void> {
    if (m.characteristic.name.empty() || !std::isfinite(m.actual)) return {};
    const std::size_t axis = std::string_view("XYZ").find(m.characteristic.name.back());
    if (axis == std::string_view::npos) return {};
    if (m.record != pending.record || m.machine != pending.machine || pending.at[axis]) close();
    pending.record = m.record;
    pending.machine = m.machine;
    pending.at[axis] = m.characteristic.unit == "inch" ? Length::inch(m.actual).mm() : m.actual;
    if (points.size() < kMaxPoints) return {};
    return fail(Errc::LimitExceeded, "over {} digitized points", kMaxPoints);
  });
  if (!done) return fail(done.error());
  close();
  make_radii(points, x);
  for (const DigitizedPoint& point : points) {
    if (auto good = check_place(point); !good) return fail(good.error());
  }
  if (!points.empty()) return points;
  return fail(Errc::NotFound,
              "no measurement is a point: their characteristics end with X, Y or Z");
}

Result<void> write_points_csv(std::span<const DigitizedPoint> points, const Sink& sink) {
  Pieces out(sink);
  out.text = "x,y,z\r\n";
  for (const DigitizedPoint& point : points) {
    out.text += decimal_text(point.x, 3) + ',' + decimal_text(point.y, 3) + ',' +
                decimal_text(point.z, 3) + "\r\n";
    if (auto done = out.pass_on(); !done) return done;
  }
  return out.pass_on(0);
}

Result<void> write_dxf(std::span<const DigitizedPoint> points, double gap, const Sink& sink) {
  if (!(gap > 0)) gap = 4 * median_distance(points);
  Pieces out(sink);
  out.text =
      "0\r\nSECTION\r\n2\r\nHEADER\r\n9\r\n$"
      "ACADVER\r\n1\r\nAC1009\r\n0\r\nENDSEC\r\n0\r\nSECTION\r\n2\r\nENTITIES\r\n";
  const auto place = [&](const DigitizedPoint& point) {
    fmt::format_to(std::back_inserter(out.text), "10\r\n{}\r\n20\r\n{}\r\n30\r\n{}\r\n",
                   decimal_text(point.x, 4), decimal_text(point.y, 4), decimal_text(point.z, 4));
  };
  for (const DigitizedPoint& point : points) {
    out.text += "0\r\nPOINT\r\n8\r\nPOINTS\r\n";
    place(point);
    if (auto done = out.pass_on(); !done) return done;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || distance(points[i - 1], points[i]) > gap) {
      if (i > 0) out.text += "0\r\nSEQEND\r\n8\r\nPASSES\r\n";
      out.text +=
          "0\r\nPOLYLINE\r\n8\r\nPASSES\r\n66\r\n1\r\n10\r\n0.0\r\n20\r\n0.0\r\n30\r\n0."
          "0\r\n70\r\n8\r\n";
    }
    out.text += "0\r\nVERTEX\r\n8\r\nPASSES\r\n";
    place(points[i]);
    out.text += "70\r\n32\r\n";
    if (auto done = out.pass_on(); !done) return done;
  }
  if (!points.empty()) out.text += "0\r\nSEQEND\r\n8\r\nPASSES\r\n";
  out.text += "0\r\nENDSEC\r\n0\r\nEOF\r\n";
  return out.pass_on(0);
}

namespace {

/// The cells beside one, as far as there are some.
template <class Visit>
void each_neighbor(const HeightGrid& grid, std::size_t cell, Visit visit) {
  const std::size_t column = cell % grid.columns, row = cell / grid.columns;
  if (column > 0) visit(cell - 1);
  if (column + 1 < grid.columns) visit(cell + 1);
  if (row > 0) visit(cell - grid.columns);
  if (row + 1 < grid.rows) visit(cell + grid.columns);
}

/// Cells without a point take the mean of neighbors that have a height, in rounds from the outside
/// of each hole. Only neighbors of what the round before filled can be filled: linear time.
std::size_t fill_holes(HeightGrid& grid, std::vector<std::uint32_t>& counts) {
  std::vector<std::size_t> edge;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) edge.push_back(i);
  }
  const std::size_t filled = counts.size() - edge.size();
  std::vector<bool> is_next(counts.size());
  while (!edge.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t i : edge) {
      each_neighbor(grid, i, [&](std::size_t at) {
        if (counts[at] > 0 || is_next[at]) return;
        is_next[at] = true;
        next.push_back(at);
      });
    }
    std::vector<double> heights;
    for (const std::size_t i : next) {
      double sum = 0;
      int neighbors = 0;
      each_neighbor(grid, i, [&](std::size_t at) {
        if (counts[at] == 0) return;
        sum += grid.heights[at];
        ++neighbors;
      });
      heights.push_back(sum / neighbors);
    }
    for (std::size_t n = 0; n < next.size(); ++n) {
      grid.heights[next[n]] = heights[n];
      counts[next[n]] = 1;
    }
    edge = std::move(next);
  }
  return filled;
}

/// Most of a field that rests on hardly any points would be invented.
Result<void> check_cover(const HeightGrid& grid, const std::vector<std::uint32_t>& counts) {
  constexpr std::size_t kLeastOf = 200, kSmall = 10'000;
  const auto known = static_cast<std::size_t>(
      std::ranges::count_if(counts, [](std::uint32_t count) { return count > 0; }));
  if (counts.size() <= kSmall || known * kLeastOf >= counts.size()) return {};
  return fail(Errc::LimitExceeded,
              "a height field of {} x {} cells, {} of them with a point: one of {} is needed, with "
              "larger cells it has more",
              grid.columns, grid.rows, known, kLeastOf);
}

}  // namespace

Result<HeightGrid> make_height_grid(std::span<const DigitizedPoint> points, double cell) {
  if (points.size() < 4)
    return fail(Errc::LimitExceeded, "a height field of {} points: 4 are needed", points.size());
  for (const DigitizedPoint& point : points) {
    if (auto good = check_place(point); !good) return fail(good.error());
  }
  if (!(cell > 0)) cell = median_distance(points);
  const auto [low_x, high_x] = std::ranges::minmax(points, {}, &DigitizedPoint::x);
  const auto [low_y, high_y] = std::ranges::minmax(points, {}, &DigitizedPoint::y);
  HeightGrid grid;
  grid.cell = cell;
  grid.x = low_x.x;
  grid.y = low_y.y;
  const double columns = std::floor((high_x.x - low_x.x) / cell + 0.5) + 1;
  const double rows = std::floor((high_y.y - low_y.y) / cell + 0.5) + 1;
  if (!(columns >= 2 && rows >= 2))
    return fail(Errc::LimitExceeded, "the points are on one line: no height field");
  if (!(columns * rows <= static_cast<double>(kMaxGridCells)))
    return fail(Errc::LimitExceeded, "a height field of {} x {} cells, at most {}", columns, rows,
                kMaxGridCells);
  grid.columns = static_cast<std::size_t>(columns);
  grid.rows = static_cast<std::size_t>(rows);
  grid.heights.resize(grid.columns * grid.rows);
  std::vector<std::uint32_t> counts(grid.heights.size());
  for (const DigitizedPoint& p : points) {
    const auto column = static_cast<std::size_t>(std::floor((p.x - grid.x) / cell + 0.5));
    const auto row = static_cast<std::size_t>(std::floor((p.y - grid.y) / cell + 0.5));
    const std::size_t at = row * grid.columns + column;
    ++counts[at];
    grid.heights[at] += (p.z - grid.heights[at]) / counts[at];  // a running mean
  }
  if (auto good = check_cover(grid, counts); !good) return fail(good.error());
  grid.filled = fill_holes(grid, counts);
  return grid;
}

namespace {

using Corner = std::array<float, 3>;

class StlWriter {
 public:
  explicit StlWriter(const Sink& sink) : out_(sink) {}

  void head(std::uint32_t triangles) {
    out_.text.assign(80, ' ');
    constexpr std::string_view kName =
        "height field of digitized points, mm";  // must not begin with "solid"
    out_.text.replace(0, kName.size(), kName);
    append(triangles);
  }
  /// Counterclockwise seen from outside.
  Result<void> triangle(const Corner& a, const Corner& b, const Corner& c) {
    Corner normal{(b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]),
                  (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]),
                  (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])};
    const float length = std::hypot(normal[0], normal[1], normal[2]);
    for (float& part : normal) part = length > 0 ? part / length : 0;
    for (const Corner& corner : {normal, a, b, c}) {
      for (const float part : corner) append(std::bit_cast<std::uint32_t>(part));
    }
    out_.text.append(2, '\0');
    return out_.pass_on();
  }
  Result<void> quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    if (auto done = triangle(a, b, c); !done) return done;
    return triangle(a, c, d);
  }
  Result<void> finish() { return out_.pass_on(0); }

 private:
  void append(std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
      out_.text += static_cast<char>((value >> shift) & 0xFFU);
  }
  Pieces out_;
};

}  // namespace

Result<void> write_stl(const HeightGrid& grid, double base, const Sink& sink) {
  if (grid.columns < 2 || grid.rows < 2 || grid.heights.size() != grid.columns * grid.rows ||
      !(base > 0))
    return fail(Errc::LimitExceeded, "an STL of {} x {} heights on a base of {}", grid.columns,
                grid.rows, base);
  const auto floor_z = static_cast<float>(*std::ranges::min_element(grid.heights) - base);
  const auto corner = [&](std::size_t column, std::size_t row, bool is_top) {
    return Corner{static_cast<float>(grid.x + grid.cell * static_cast<double>(column)),
                  static_cast<float>(grid.y + grid.cell * static_cast<double>(row)),
                  is_top ? static_cast<float>(grid.heights[row * grid.columns + column]) : floor_z};
  };
  const std::size_t last_column = grid.columns - 1, last_row = grid.rows - 1;
  StlWriter stl(sink);
  stl.head(static_cast<std::uint32_t>(4 * last_column * last_row + 4 * (last_column + last_row)));
  for (std::size_t row = 0; row < last_row; ++row) {
    for (std::size_t column = 0; column < last_column; ++column) {
      auto done = stl.quad(corner(column, row, true), corner(column + 1, row, true),
                           corner(column + 1, row + 1, true), corner(column, row + 1, true));
      if (!done) return done;
      done = stl.quad(corner(column, row, false), corner(column, row + 1, false),
                      corner(column + 1, row + 1, false), corner(column + 1, row, false));
      if (!done) return done;
    }
  }
  for (std::size_t column = 0; column < last_column; ++column) {
    auto done = stl.quad(corner(column, 0, false), corner(column + 1, 0, false),
                         corner(column + 1, 0, true), corner(column, 0, true));
    if (!done) return done;
    done = stl.quad(corner(column + 1, last_row, false), corner(column, last_row, false),
                    corner(column, last_row, true), corner(column + 1, last_row, true));
    if (!done) return done;
  }
  for (std::size_t row = 0; row < last_row; ++row) {
    auto done = stl.quad(corner(0, row + 1, false), corner(0, row, false), corner(0, row, true),
                         corner(0, row + 1, true));
    if (!done) return done;
    done = stl.quad(corner(last_column, row, false), corner(last_column, row + 1, false),
                    corner(last_column, row + 1, true), corner(last_column, row, true));
    if (!done) return done;
  }
  return stl.finish();
}

}  // namespace dripline::measurement_files
