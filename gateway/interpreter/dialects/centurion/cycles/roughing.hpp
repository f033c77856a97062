#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/cycles/pass_writer.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/profile.hpp"

/// Rough turning and facing (manual: G71, G72): parallel cuts down to the pattern with
/// all its stock.
namespace dripline::interpreter::centurion {

struct Roughing {
  ProfileFrame frame;
  Profile profile;  ///< the pattern without its first move, and the shoulder; with all stock
  ProfilePoint start;
  double first_level = 0;
  double step = 0;
  double relief = 0;
  bool relief_is_45 = false;
  Feed feed;
};

/// Checks the contour of the cycle's moves: 582-587 when the pattern cannot be roughed.
bool check_roughing(Run& run);
/// From a cycle that passed the check.
Roughing roughing_of(const PatternCycle& cycle);

/// Cut `number` of 0, 1, ...; false when nothing is left at its level.
bool cut_level(PassWriter& writer, const Roughing& roughing, std::uint32_t number);
/// Along the pattern with the finish stock only, out to the start, and back to it.
void cut_contour(Run& run, PassWriter& writer);

}  // namespace dripline::interpreter::centurion
