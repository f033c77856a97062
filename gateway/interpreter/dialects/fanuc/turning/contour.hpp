#pragma once

#include <cstdint>
#include <vector>

#include "gateway/interpreter/dialects/fanuc/reading/text_cursor.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

/// The contour of G70 to G73: the blocks from P to Q of the program.
namespace dripline::interpreter::fanuc {

/// A move of a recorded contour, in machine coordinates; X is a radius.
struct ContourMove {
  double x = 0;
  double z = 0;
  bool is_rapid = false;
  bool is_arc = false;
  bool is_clockwise = false;
  double center_x = 0;
  double center_z = 0;
  double sweep = 0;  ///< degrees
};

/// A cycle whose contour is being executed.
struct ContourCycle {
  std::uint8_t code = 0;     ///< G70 to G73 as 170 to 173; 0: none
  bool has_place = false;    ///< `back` is known
  bool has_begun = false;    ///< the block of P has been executed
  bool is_type_two = false;  ///< and it names both axes
  std::uint32_t last = 0;    ///< N of the last block
  TextPosition back;         ///< after the block of the cycle
  double allowance_x = 0;    ///< a radius
  double allowance_z = 0;
  std::vector<ContourMove> moves;  ///< of G70: where its blocks end
};

/// What earlier blocks have set for the cycles: the first blocks of G71 to G76. Radii.
struct TurningData {
  double depth = 0;     ///< G71, G72: of a cut
  double escape = 0;    ///< G71, G72
  double relief_x = 0;  ///< G73
  double relief_z = 0;
  double repeats = 0;      ///< G73
  double peck_return = 0;  ///< G74, G75
  double thread_finishes = 0;
  double thread_chamfer = 0;  ///< in leads
  double thread_angle = 0;    ///< degrees
  double thread_least = 0;
  double thread_finish = 0;
  bool has_faced = false;  ///< the last contour with pockets was one of G72
};

/// Keeps the moves and drops what else the blocks would do; warnings and alarms go on.
class ContourRecorder final : public EventGate {
 public:
  static constexpr std::size_t kMaxMoves = 2000;

  ContourRecorder(std::vector<ContourMove>& moves, EventSink& out)
      : EventGate(out), moves_(moves) {}

  bool is_full() const { return moves_.size() > kMaxMoves; }

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_warning(const Warning& event) override { out().on_warning(event); }
  void on_alarm(const Alarm& event) override { out().on_alarm(event); }

 private:
  bool is_open() const override { return false; }
  void add(const ContourMove& move);

  std::vector<ContourMove>& moves_;
};

}  // namespace dripline::interpreter::fanuc
