#pragma once

#include <optional>
#include <span>

#include "clients/tools/graphics/picture.hpp"
#include "clients/tools/graphics/turning_simulation.hpp"

/// Pictures of a turned part, seen with +Z to the right and +X up.
namespace dripline::graphics {

enum class TurnedSide { Outside, Section, Nothing };

/// A rectangle of the machine in the plane of Z and X (radii), drawn as four lines.
struct Frame {
  SectionPoint low, high;
};

struct TurnedView {
  TurnedSide above = TurnedSide::Section;  ///< the axis; below it is `below`
  TurnedSide below = TurnedSide::Outside;
  /// The part shown, radii positive above the axis; absent: all that is drawn.
  std::optional<Frame> window{};
  bool shows_path = false;                ///< the tool's, and what a cycle roughs towards
  bool shows_part_path = false;           ///< all of the part's
  std::optional<Frame> limits{}, zone{};  ///< software limits, safe zone
  bool has_front_turret = false;          ///< +X down
  std::size_t width = 1024;               ///< pixels; the height follows, up to twice as much
};

/// The part (absent: the paths alone) and the paths in the colors of the Centurion's screen: feeds
/// green, rapid moves red and dashed, the part's path and the finish pattern of cycles yellow.
/// Errors: LimitExceeded (there is nothing to show, or a window without extent).
Result<Picture> draw_turned(const TurnedSection* part, std::span<const PathPiece> path,
                            const TurnedView& view);

}  // namespace dripline::graphics
