#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::paths {

/// How the tool comes to a point. The numbers are part of the format.
enum class PathMove : std::uint8_t { Rapid = 0, Line = 1, Arc = 2, Thread = 3, Probe = 4 };

/// A tool that the program called.
struct PathTool {
  int number = 0;
  std::uint64_t line = 0;   ///< of the program that was started
  std::uint64_t point = 0;  ///< the first one that it reaches
};

/// Writes the tool path of a program as points (README.md, "Points"): a sink for its events. One
/// thread; memory is what was written and not taken yet, bounded by the moves of a step.
class PathEncoder final : public interpreter::EventSink {
 public:
  /// `tolerance`, millimeters: points between which the path leaves a straight line by no more are
  /// left out; 0 leaves out none.
  PathEncoder(const interpreter::Position& start, double tolerance);

  /// The points since the last call, as bytes.
  std::string take();
  /// Writes the point that may still have been left out; after the last event.
  void finish();

  std::size_t size() const { return bytes_.size(); }  ///< bytes that were not taken
  std::uint64_t points() const { return points_; }
  const std::vector<PathTool>& tools() const { return tools_; }
  /// Moves in which an axis other than X, Y and Z took part, which the path does not show.
  std::uint64_t other_axes() const { return other_axes_; }

  static constexpr std::size_t kMaxTools = 1000;

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_block_end(const interpreter::Origin& origin) override;

 private:
  using Vector = std::array<double, 3>;
  /// The place of a block in the program that was started.
  struct Place {
    std::uint64_t line = 1, offset = 0;
  };
  struct Point {
    Vector at{};
    Place place;
    PathMove move = PathMove::Rapid;
  };

  void arrive(const interpreter::Origin& origin, const interpreter::Position& to, PathMove move);
  void follow(const interpreter::Arc& arc, PathMove move);
  Place place_of(const interpreter::Origin& origin);
  void add(const Point& point);
  bool may_leave_out(const Point& next) const;
  void write(const Point& point);

  double tolerance_;
  interpreter::Position at_;
  Place place_;  ///< of the latest block of the program that was started
  std::string bytes_;
  std::vector<Point> waiting_;  ///< points that may be left out, in order
  Point written_;               ///< the last one
  std::array<std::int64_t, 3> grid_{};
  std::uint64_t points_ = 0;
  std::uint64_t other_axes_ = 0;
  std::vector<PathTool> tools_;
};

}  // namespace dripline::paths
