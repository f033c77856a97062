#pragma once

#include <array>
#include <string>
#include <vector>

namespace dripline::differential {

/// One move, as both sides can tell it: machine coordinates in millimeters and degrees.
struct Move {
  enum class Kind { Rapid, Feed, Arc } kind = Kind::Rapid;
  std::array<double, 6> to{};      ///< X Y Z A B C
  std::array<double, 2> center{};  ///< of an arc, in the plane's axes
  int plane = 0;                   ///< 0 XY, 1 ZX, 2 YZ
  int circles = 0;                 ///< of an arc: 1, 2.. counterclockwise, -1, -2.. clockwise
};
std::string text_of(const Move& move);
bool is_near(const std::array<double, 6>& a, const std::array<double, 6>& b, double within);

/// What a program did, and whether it was taken to its end.
struct Behavior {
  bool is_accepted = false;
  bool is_hung = false;  ///< did not end in time, or crashed
  std::string complaint;
  std::vector<Move> moves;
};

/// Drops moves of no length: one side shows them, the other does not.
void drop_standing_moves(Behavior& behavior);
/// Joins feeds along one axis, in its direction: one side makes two of them, the other one.
void join_feeds(Behavior& behavior);

/// Empty when both did the same within `tolerance` millimeters; else what differs first.
std::string difference(const Behavior& ours, const Behavior& peer, double tolerance);

}  // namespace dripline::differential
