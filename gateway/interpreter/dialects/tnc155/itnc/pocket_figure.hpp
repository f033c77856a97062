#pragma once

#include "gateway/interpreter/dialects/tnc155/itnc/milling.hpp"

/// What the words of cycles 251 to 254 come to.
namespace dripline::interpreter::tnc155::itnc {

inline constexpr int kRoughing = 1, kFinishing = 2;  ///< Q215
inline constexpr int kHelical = 1;                   ///< Q366; 2: to and fro
inline constexpr double kSameLength = 1e-6, kSliverOfStep = 1e-9;
/// Of the tool's radius: a helix with less around its center would drill.
inline constexpr double kLeastHelix = 0.1;

constexpr bool is_slot(int cycle) {
  return cycle == kSlot || cycle == kRoundSlot;
}
inline int whole_word(const Table& table, int q) {
  return static_cast<int>(table.of(q));
}
/// As far as the tool reaches with its center: without the allowance Q368. `repeat`: of round
/// slots.
PocketShape shape_of(const Table& table, int cycle, PlaneVector at, double tool, int repeat = 0);
/// Sideways from line to line, at most.
double stepover(const Table& table, int cycle, double tool);
/// How many lines beside the core there are.
int lines_to(double room, double step);
/// The helix into a pocket or slot: radius, 0 where there is no room for it.
double helix_radius(double room, double tool);
/// To and fro along the core; in a rectangle about its center, by up to two tool diameters.
double ramp_length(const PocketShape& shape, double room, double tool);
bool has_allowance(const Table& table);

}  // namespace dripline::interpreter::tnc155::itnc
