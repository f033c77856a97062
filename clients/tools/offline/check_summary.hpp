#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

struct CheckRates {
  Length rapid_per_minute = Length::mm(10'000);
  double spindle_speed =
      1000;  ///< revolutions per minute, where the program needs one and has none
};

/// The smallest and largest coordinate an axis was moved to, on arcs between their ends as well.
/// Millimeters or degrees, as Position::raw.
struct AxisExtent {
  double least = 0;
  double most = 0;
};

/// The report of `dnc check` about a program. Value type.
struct Summary {
  std::string control;
  std::optional<std::string> program;
  Units units = Units::Millimeter;  ///< of the header, for printing
  bool x_is_diameter = false;       ///< extents hold radii all the same
  std::uint64_t blocks = 0;
  std::uint64_t moves = 0;
  Length rapid_length;
  Length feed_length;  ///< feeds, arcs, threads and probe moves
  double seconds = 0;  ///< estimated, without acceleration, stops and tool changes
  std::array<std::optional<AxisExtent>, kAxisCount> extents;  ///< by Axis; of axes that were moved
  std::vector<Warning> warnings;                              ///< the first kMaxWarnings
  std::uint64_t warning_count = 0;
  std::optional<Alarm> alarm;
  bool ended = false;

  static constexpr std::size_t kMaxWarnings = 1000;
};

/// Adds up a program's events to a Summary. One thread; bounded memory.
class CheckSummary final : public EventSink {
 public:
  /// `start`: position of the machine before the first move (Setup::start).
  explicit CheckSummary(const Position& start = {}, CheckRates rates = {});

  const Summary& summary() const { return summary_; }

  void on_program(const ProgramHeader&) override;
  void on_rapid(const Rapid&) override;
  void on_line(const Line&) override;
  void on_arc(const Arc&) override;
  void on_thread(const Thread&) override;
  void on_dwell(const Dwell&) override;
  void on_spindle(const Spindle&) override;
  void on_probe(const Probe&) override;
  void on_warning(const Warning&) override;
  void on_alarm(const Alarm&) override;
  void on_end(const End&) override;
  void on_block_end(const Origin&) override;

 private:
  void move_to(const Position& to);
  void cut(Length length, const Feed& feed);
  void extend(Axis axis, double value);
  void extend_arc(const Arc& arc);
  Length length_of(const Arc& arc) const;
  double spindle_speed() const;

  Summary summary_;
  CheckRates rates_;
  Position last_;
  Spindle spindle_;
};

/// The state of the machine after the last event: what a program has set so far. One thread.
class MachineState final : public EventSink {
 public:
  explicit MachineState(const Position& start = {}) : position_(start) {}

  const Position& position() const { return position_; }
  const std::optional<int>& tool() const { return tool_; }
  const std::optional<Feed>& feed() const { return feed_; }  ///< of the last move at feed
  const Spindle& spindle() const { return spindle_; }
  const Coolant& coolant() const { return coolant_; }
  const Origin& block() const { return block_; }  ///< finished last

  void on_rapid(const Rapid& event) override { position_ = event.to; }
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override { position_ = event.to; }
  void on_spindle(const Spindle& event) override { spindle_ = event; }
  void on_coolant(const Coolant& event) override { coolant_ = event; }
  void on_tool(const ToolChange& event) override;
  void on_probe(const Probe& event) override;
  void on_block_end(const Origin& event) override { block_ = event; }

 private:
  Position position_;
  std::optional<int> tool_;
  std::optional<Feed> feed_;
  Spindle spindle_;
  Coolant coolant_;
  Origin block_;
};

/// The places at which a program stops and waits for the operator, in the order they are met. A
/// place that is met again, in a repeat or a subprogram, is counted. The end of a program is no
/// stop. One thread; memory bounded by kMaxPlaces.
class StopList final : public EventSink {
 public:
  struct Place {
    Stop stop;  ///< when it was met first
    std::uint64_t times = 0;
  };
  static constexpr std::size_t kMaxPlaces = 1000;

  const std::vector<Place>& places() const { return places_; }
  /// Number of all places, those beyond the first kMaxPlaces included.
  std::uint64_t count() const { return count_; }

  void on_stop(const Stop& event) override;

 private:
  std::vector<Place> places_;
  /// Where in `places_` a stop of that program, offset and kind is.
  std::map<std::tuple<ProgramIndex, std::uint64_t, StopKind>, std::size_t> known_;
  std::uint64_t count_ = 0;
};

}  // namespace dripline::interpreter
