#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "clients/tools/graphics/turning_tool.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::graphics {

/// The bar, and what is not known from the program.
struct TurningSettings {
  /// Instead of the program's own bar; `z` in machine coordinates.
  std::optional<SectionExtent> bar;
  std::vector<interpreter::ToolRecord> tools;  ///< of the setup; number: the offset's
  std::map<int, double> widths;                ///< of drills and blades, by offset
  double insert_degrees = 55;
  interpreter::Position start;
  std::size_t cells_along = 1024;
  /// The program's part path in place of the tool's: nothing is cut, and rapid moves are left out.
  /// Asked at each piece: whether a roughing cycle follows its pattern.
  std::function<bool()> follows_pattern;
  /// Called now and then with the block that was just cut: for a progress bar.
  std::function<void(const interpreter::Origin&)> on_progress;
};

enum class PathKind : std::uint8_t {
  Feed,
  Rapid,
  Part,           ///< as programmed, without nose compensation
  FinishPattern,  ///< the same, in the pattern that a cycle roughs
};

/// One straight piece of a path.
struct PathPiece {
  SectionPoint from, to;  ///< of the imaginary tip; x may lie beyond the axis
  PathKind kind = PathKind::Feed;
};

/// Turns a bar with what a program does: a sink for its events. The tool path is kept too, between
/// M91 and M90 only (they turn a Centurion's graphics on and off). One thread.
class TurningSimulation final : public interpreter::EventSink {
 public:
  static constexpr std::size_t kMaxPieces = std::size_t{1} << 20;

  explicit TurningSimulation(TurningSettings settings);

  /// The section so far; absent before there is a bar.
  const std::optional<TurnedSection>& part() const { return part_; }
  /// After the run: rings between cuts fall off.
  void finish();
  const std::vector<PathPiece>& path() const { return path_; }
  /// Pieces beyond kMaxPieces.
  std::uint64_t left_out() const { return left_out_; }
  /// A bar that cannot be: absent, or why.
  const std::optional<Error>& failure() const { return failure_; }
  std::uint64_t cuts() const { return cuts_; }
  /// The spindle's axis: X of the machine. Radii in pictures count from it.
  double axis_x() const { return axis_x_; }
  double bar_volume() const { return bar_volume_; }

  void on_blank(const interpreter::Blank& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_block_end(const interpreter::Origin& event) override;

 private:
  enum class Travel { Rapid, Feed, Thread };
  void begin(const SectionExtent& bar);
  void go(const SectionPoint& to, Travel travel);
  void go_around(const interpreter::Arc& arc, Travel travel);
  void note(const SectionPoint& from, const SectionPoint& to, Travel travel);
  void cut(const SectionPoint& from, const SectionPoint& to, Travel travel);
  SectionPoint point(const interpreter::Position& position) const;
  const std::vector<ConvexOutline>& pieces(Travel travel, bool is_on_axis);

  TurningSettings settings_;
  std::optional<TurnedSection> part_;
  std::optional<Error> failure_;
  double bar_volume_ = 0;
  double axis_x_ = 0;  ///< the spindle's axis in machine coordinates
  TurningTool tool_;
  /// Shapes of the tool in use, for turning, threads and drilling; made when first wanted.
  std::vector<ConvexOutline> turning_, threading_, drilling_;
  interpreter::Position at_;
  std::vector<PathPiece> path_;
  std::uint64_t cuts_ = 0, left_out_ = 0;
  bool draws_ = true;
};

}  // namespace dripline::graphics
