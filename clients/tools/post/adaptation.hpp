#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/tools/post/grid.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::post {

/// What a target does not have, with its value and its limit, at a place of the source.
struct Refusal {
  std::string what;
  interpreter::Origin origin;
};

struct AdaptationOptions {
  double tolerance = 0.001;  ///< mm between an arc and the one that is written
  /// mm: arcs that the target does not have become lines within it; absent: they are refused.
  std::optional<double> chord = {};
  double value_tolerance = 0.005;  ///< of feeds, speeds and dwells, as a part of them
  bool passes_messages = false;    ///< to the writer, which makes comments of them
  /// The path is that of a compensated contour, which no word of the target has to name.
  bool is_off_grid = false;
  std::string rotary_refusal = {};  ///< why a move of a rotary axis is refused; empty: it is not
};

/// What the adaptation changed, each a number of places.
struct AdaptationCounts {
  std::uint64_t short_moves = 0;        ///< left out: shorter than a step of the target
  std::uint64_t split_arcs = 0;         ///< written as several
  std::uint64_t straightened_arcs = 0;  ///< as their chord, which is within half a step of them
  std::uint64_t arcs_as_lines = 0;      ///< as lines within the chord tolerance
  std::uint64_t rounded_feeds = 0, rounded_speeds = 0, rounded_dwells = 0, rounded_leads = 0;
  std::uint64_t inverse_time = 0;       ///< feeds of a move that became feeds per minute
  std::uint64_t exact_stops = 0;        ///< not written
  std::uint64_t messages = 0;           ///< to the operator, at most comments now
  std::uint64_t prompts = 0;            ///< answered from the setup
  std::uint64_t tool_change_stops = 0;  ///< waits for a tool changed by hand
  std::uint64_t spindle_restarts = 0;   ///< after a tool change, which stops it at the target
  std::uint64_t operator_actions = 0;   ///< left to the operator, who is waited for
  std::uint64_t assumed_tools = 0;      ///< asked for by the target, called by no block
};

/// Makes a program's motion what the target can have: rounds feeds and speeds, splits arcs, leaves
/// out moves shorter than a step. Positions pass unrounded. What the target does not have closes it
/// with a refusal. The writer and the comparison with what was written both get their events
/// through one, so it is the only part of a conversion that the comparison cannot see: it is small,
/// and counts all that it changes.
class Adaptation final : public interpreter::EventGate {
 public:
  Adaptation(interpreter::EventSink& out, const Grid& grid, const AdaptationOptions& options,
             const interpreter::Position& start);

  /// Whose modes say which length is in force, and the tools of the target, which calls each with
  /// its own. Both must outlive the events; without them lengths are not looked at.
  void watch(const interpreter::Interpreter& source,
             const std::vector<interpreter::ToolRecord>& tools) {
    source_ = &source;
    tools_ = &tools;
  }
  const std::optional<Refusal>& refusal() const { return refusal_; }
  const AdaptationCounts& counts() const { return counts_; }

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_dwell(const interpreter::Dwell& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_pin(const interpreter::PinChange& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_output(const interpreter::Output& event) override;
  void on_open(const interpreter::Open& event) override;
  void on_close(const interpreter::Close& event) override;
  void on_message(const interpreter::Message& event) override;
  void on_prompt(const interpreter::Prompt& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_override_inhibit(const interpreter::OverrideInhibit& event) override;

 private:
  bool is_open() const override { return !refusal_; }
  void refuse(const interpreter::Origin& origin, std::string what);
  const Target& target() const { return grid_.target(); }
  bool is_short(const interpreter::Position& to) const;
  bool check_target(const interpreter::Origin& origin, const interpreter::Position& to);
  bool check_length(const interpreter::Origin& origin, const interpreter::Position& to);
  bool check_rotary(const interpreter::Origin& origin, const interpreter::Position& to);
  bool check_feed_axes(const interpreter::Origin& origin, const interpreter::Position& to);
  std::optional<double> rounded(const interpreter::Origin& origin, std::string_view name,
                                double value, const NumberRange& range, std::string_view unit,
                                std::uint64_t& count);
  std::optional<Feed> feed_of(const interpreter::Origin& origin, Feed feed, double length);
  void arc_piece(const interpreter::Arc& arc);
  bool can_be_arc(const interpreter::Arc& arc, std::string& reason) const;
  void lines_of(const interpreter::Arc& arc, std::string_view reason);
  void move_line(const interpreter::Line& line);

  Grid grid_;
  const interpreter::Interpreter* source_ = nullptr;
  const std::vector<interpreter::ToolRecord>* tools_ = nullptr;
  int tool_ = 0;
  AdaptationOptions options_;
  interpreter::Position start_;
  interpreter::Position at_;  ///< the last that passed
  interpreter::Spindle spindle_;
  bool has_coolant_ = false;
  AdaptationCounts counts_;
  bool has_waited_ = false;  ///< for the operator, since the last move
  std::optional<Refusal> refusal_;
};

/// The position with the axes that have not moved, or that the target does not have, where they
/// were at the start: not every control reports those that it does not have.
interpreter::Position of_target(const Target& target, interpreter::Position position,
                                const interpreter::Position& start);

/// What a program that was written does, without what belongs to the target and not to the program:
/// the wait for a tool changed by hand, an M function of the end, off where it is off already, a
/// second wait at one place. The
/// feed of a helix is the target's F, here and where Adaptation gives it out.
class TargetView final : public interpreter::EventFilter {
 public:
  TargetView(interpreter::EventSink& out, const Target& target, const interpreter::Position& start)
      : EventFilter(out), target_(target), start_(start), at_(start) {}
  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;

 private:
  const Target& target_;
  interpreter::Position start_;
  interpreter::Position at_;
  interpreter::SpindleState spindle_ = interpreter::SpindleState::Off;
  bool has_coolant_ = false;
  bool has_waited_ = false;  ///< as that of Adaptation
};

}  // namespace dripline::post
