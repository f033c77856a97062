#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/geometry/profile.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/pieces.hpp"

/// The cuts of G71 and G72, in the frame of the cuts. Pure; lengths in millimeters.
namespace dripline::interpreter::rs274ngc {

struct CutMove {
  enum class Kind : std::uint8_t { Rapid, Line, Arc };
  Kind kind = Kind::Line;
  PlaneVector to;
  PlaneVector center = {};
  bool is_counterclockwise = false;
};
using CutMoves = std::vector<CutMove>;

enum class Pockets : std::uint8_t {
  All,
  None,  ///< G71.1: straight over them
  Only,  ///< G71.2: from the first on
};

struct RoughingPlan {
  ContourPieces contour;  ///< as cut: with its distance
  PlaneVector start;
  double increment = 0;
  double retract = 0;
  Pockets pockets = Pockets::All;
};

inline constexpr std::size_t kMaxCutMoves = 20'000;

/// From the start on, where the tool is, to the end of the contour. Nothing: the reason.
std::optional<CutMoves> rough(const RoughingPlan& plan, const ContourLimits& limits,
                              std::string_view& why);

/// No straight move from `from` on leads below the contour. Arcs are its own.
bool is_clear(const CutMoves& moves, PlaneVector from, const ContourPieces& contour,
              const ContourLimits& limits);

}  // namespace dripline::interpreter::rs274ngc
