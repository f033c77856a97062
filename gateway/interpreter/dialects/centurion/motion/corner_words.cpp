#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"
#include "gateway/interpreter/dialects/centurion/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"

namespace dripline::interpreter::centurion {
namespace {

using BlendFault = blending::FaultKind;

constexpr std::uint8_t kTrigHelpOff = 2;  ///< of the special flags

CornerWords& corner_words_of(Block& block) {
  if (!block.parts.has_corner_words) block.corner_words = {};
  block.parts.has_corner_words = true;
  return block.corner_words;
}

bool read_value(Run& run, const char*& at, double& value) {
  unsigned digits = 0;
  return read_word_value(run, at, value, digits);
}

/// BACK takes C0 or C2.
bool read_which(Run& run, const char*& at, blending::Back& which) {
  const std::uint32_t column = run.column(at);
  double value = 0;
  if (!read_value(run, at, value)) return false;
  if (value != 0 && value != 2) {
    return run.fail(ErrorCode::ParameterOutOfRange, column,
                    fmt::format("C{} of BACK is neither 0 nor 2", value));
  }
  which = value == 0 ? blending::Back::Nearest : blending::Back::Farthest;
  return true;
}

/// A length in any direction, after the transformations.
Length transformed(const Run& run, double value) {
  const Transformation& how = run.state.transformation;
  return run.length(how.is_on() ? value * how.length_factor() : value);
}

/// A slope in degrees, after the transformations.
Angle transformed_slope(const Run& run, double degrees) {
  if (!run.state.transformation.is_on()) return Angle::degrees(degrees);
  const Point from = machine_of(run, run.state.position);
  const Point to = machine_of(run, polar(run.state.position, 1, degrees));
  return Angle::radians(std::atan2(to.x - from.x, to.z - from.z));
}

void announce_corner(Run& run) {
  const CornerWords& words = run.block.corner_words;
  if (words.round) run.blender.round_next_corner(transformed(run, *words.round));
  if (words.chamfer)
    run.blender.chamfer_next_corner(transformed(run, *words.chamfer), run.options.chamfer);
}

}  // namespace

bool read_corner_word(Run& run, const char*& at) {
  const char* start = at;
  run.begin_item(start);
  ++at;
  if (!skip_gaps(run, at)) return false;
  const bool is_round = take_word(at, "R");
  if (!is_round && !take_word(at, "C")) {
    return run.fail(ErrorCode::IllegalStatement, run.column(start), "R or C belongs after \",\"");
  }
  CornerWords& words = corner_words_of(run.block);
  std::optional<double>& word = is_round ? words.round : words.chamfer;
  double value = 0;
  if (!read_value(run, at, value)) return false;
  if (word) return run.fail(ErrorCode::DuplicateAddress, run.column(start), is_round ? ",R" : ",C");
  if (value < 0) {
    return run.fail(is_round ? ErrorCode::NegativeArcRadius : ErrorCode::NegativeChamfer,
                    run.column(start), fmt::format("{}{}", is_round ? ",R" : ",C", value));
  }
  word = value;
  words.column = run.column(start);
  if (words.round && words.chamfer) {
    return run.fail(ErrorCode::ChamferAndRound, run.column(start));
  }
  run.item_done();
  return true;
}

bool read_back_words(Run& run, const char* start, const char*& at) {
  CornerWords& words = corner_words_of(run.block);
  if (words.back) return run.fail(ErrorCode::DuplicateAddress, run.column(start), "BACK");
  CornerWords::Back back;
  bool has_which = false, has_slope = false;
  for (;;) {
    if (!skip_gaps(run, at)) return false;
    if (!has_which && take_word(at, "C")) {
      has_which = true;
      if (!read_which(run, at, back.which)) return false;
    } else if (!has_slope && take_word(at, "W")) {
      has_slope = true;
      if (!read_value(run, at, back.slope)) return false;
    } else {
      break;
    }
  }
  if (!has_slope) {
    return run.fail(ErrorCode::IllegalStatement, run.column(start), "BACK needs its angle, W");
  }
  words.back = back;
  words.column = run.column(start);
  return true;
}

bool check_corner_words(Run& run) {
  const CornerWords& words = run.block.corner_words;
  const bool is_move = run.block.parts.axis_row == kNoRow &&
                       run.block.words.has_any(kEndWords | kPolarWords) && !run.block.parts.probe;
  if (run.block.parts.thread_code != 0 && (words.round || words.chamfer)) {
    return run.fail(ErrorCode::NotSupported, words.column, "a corner at the end of a thread");
  }
  const bool is_line = run.state.modes.motion == MotionMode::Line;
  if (is_move && (!words.back || is_line)) return true;
  return run.fail(ErrorCode::IllegalStatement, words.column,
                  words.back ? "BACK belongs to a line of G1" : "a corner belongs to a move");
}

bool has_trig_help(const Run& run) {
  const Transformation& how = run.state.transformation;
  if (how.scales && std::fabs(how.factor.x) != std::fabs(how.factor.z)) return false;
  return !run.options.is_dnc_fast && !run.block.parts.probe && run.block.parts.axis_row == kNoRow &&
         run.block.parts.thread_code == 0 && !run.state.modes.is_incremental &&
         !run.block.words.has_any(set_of(Address::U, Address::W)) &&
         (run.parameters.byte(kSpecialFlags) & kTrigHelpOff) == 0;
}

double arc_tolerance(const Run& run) {
  return run.state.units == Units::Inch ? 0.001 : 0.01;
}

void announce_line(Run& run) {
  if (has_trig_help(run)) run.blender.approximate_end(run.length(arc_tolerance(run)));
  if (!run.block.parts.has_corner_words) [[likely]]
    return;
  announce_corner(run);
  announce_back(run);
}

void announce_back(Run& run) {
  if (!run.block.is_back_line()) return;
  const CornerWords::Back& back = *run.block.corner_words.back;
  run.blender.back_solve_line(transformed_slope(run, back.slope), back.which);
}

void announce_arc(Run& run, std::optional<double> radius) {
  if (radius)
    run.blender.approximate_end(run.length(arc_tolerance(run)), transformed(run, *radius));
  if (run.block.parts.has_corner_words) announce_corner(run);
}

ErrorCode code_of(const blending::Fault& fault) {
  switch (fault.kind) {
    case BlendFault::ArcsApart:
      return ErrorCode::ArcsApart;
    case BlendFault::OffArc:
      return ErrorCode::OutOfPosition;
    case BlendFault::Straight:
      if (fault.first_is_arc)
        return fault.next_is_arc ? ErrorCode::StraightArcToArc : ErrorCode::StraightArcToLine;
      return fault.next_is_arc ? ErrorCode::StraightLineToArc : ErrorCode::StraightLineToLine;
    case BlendFault::DoesNotFit:
      return ErrorCode::CornerDoesNotFit;
    case BlendFault::ChamferAtArc:
      return ErrorCode::ChamferAtArc;
    case BlendFault::TooMuchBetween:
      return ErrorCode::TooMuchBetween;
    default:
      return ErrorCode::CompensatedLineArcApart;
  }
}

}  // namespace dripline::interpreter::centurion
