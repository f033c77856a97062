#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "clients/tools/offline/motion_clock.hpp"
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
  Length feed_length;             ///< feeds, arcs, threads and probe moves
  double seconds = 0;             ///< estimated, without stops and tool changes
  bool has_acceleration = false;  ///< in `seconds`, as the setup's [machine] states it
  std::array<std::optional<AxisExtent>, kAxisCount> extents;  ///< by Axis; of axes that were moved
  std::vector<Warning> warnings;                              ///< the first kMaxWarnings
  std::uint64_t warning_count = 0;
  std::optional<Alarm> alarm;
  bool ended = false;
  std::uint64_t programs = 0;  ///< ends that were reached: a tape can hold several

  static constexpr std::size_t kMaxWarnings = 1000;
};

/// Adds up a program's events to a Summary. One thread; bounded memory.
class CheckSummary final : public EventSink {
 public:
  /// `start`: position of the machine before the first move (Setup::start). With an acceleration in
  /// `machine` the time is that of a MotionClock.
  explicit CheckSummary(const Position& start = {}, CheckRates rates = {},
                        const MachineData& machine = {});
  CheckSummary(const CheckSummary&) = delete;
  CheckSummary& operator=(const CheckSummary&) = delete;

  /// After the last event. Before it, the time lacks the moves that the clock looks ahead over.
  const Summary& summary() const { return summary_; }
  /// At a place in the middle: as if the axes came to rest there.
  void rest();

  /// For an owner that wants the time of each block: every time goes there, in order, with the
  /// number of blocks that had ended when it came to be.
  void time_blocks(MotionClock::OnTimed on_timed) { on_timed_ = std::move(on_timed); }
  /// Blocks before this one have all of their times.
  std::uint64_t first_open() const;

  void on_program(const ProgramHeader&) override;
  void on_rapid(const Rapid&) override;
  void on_line(const Line&) override;
  void on_arc(const Arc&) override;
  void on_thread(const Thread&) override;
  void on_dwell(const Dwell&) override;
  void on_spindle(const Spindle&) override;
  void on_tool(const ToolChange&) override;
  void on_miscellaneous(const Miscellaneous&) override { rest(); }
  void on_stop(const Stop&) override { rest(); }
  void on_probe(const Probe&) override;
  void on_warning(const Warning&) override;
  void on_alarm(const Alarm&) override;
  void on_end(const End&) override;
  void on_block_end(const Origin&) override;

 private:
  void move_to(const Position& to);
  struct Stretch {
    const Position& to;
    Length length;
    const Arc* arc = nullptr;
    bool rests = false;
    bool is_rapid = false;
  };
  void cut(const Stretch& stretch, const Feed& feed);
  void pass(const Stretch& stretch, double nominal_seconds);
  TimedMove timed(const Stretch& stretch) const;
  void add_seconds(std::uint64_t block, double seconds);
  template <std::size_t... kIndexes>
  void extend_to(const Position& to, std::index_sequence<kIndexes...> axes);
  void extend(Axis axis, double value);
  Length radius_of(const Arc& arc) const;
  bool has_reached(const Arc& arc, Length radius) const;
  void extend_arc(const Arc& arc, Length radius);
  Length length_of(const Arc& arc, Length radius) const;
  double spindle_speed() const;

  Summary summary_;
  CheckRates rates_;
  Position last_;
  Spindle spindle_;
  std::uint64_t ended_blocks_ = 0;
  MotionClock::OnTimed on_timed_;
  std::unique_ptr<MotionClock> clock_;  ///< null: times without acceleration
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
