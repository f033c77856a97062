#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "protocol/base/result.hpp"

namespace dripline::post {

/// Where a control finds the radius of its cutter compensation: in the offset of the word D, or in
/// the tool that was called.
enum class RadiusOf : std::uint8_t { Offset, Tool };

/// How the text of a target is made.
enum class Form : std::uint8_t {
  Words,          ///< blocks of G and M words, with decimal points
  PlainLanguage,  ///< the dialog of a HEIDENHAIN control
  Tape,           ///< blocks of whole counts
  Events,         ///< those of a ProtoTRAK
};

/// Decimals of a number and the largest and smallest one that the control takes, in a program's
/// units.
struct NumberRange {
  int decimals = 3;
  double max = 0;
  double min = 0;
};

/// By Units: inch, millimeter.
using ByUnits = std::array<NumberRange, 2>;

/// A control that programs are written for: what it has, and the form of its numbers. What is not
/// in the row is refused.
struct Target {
  std::string_view name;     ///< as users name it
  std::string_view dialect;  ///< the registry's
  Form form = Form::Words;
  std::string_view axes = "XYZ";
  bool is_lathe = false;           ///< only programs of lathes; X is a diameter
  bool has_operator_axis = false;  ///< Z, spindle and coolant are the operator's (OperatorStage)
  ByUnits coordinate{};
  ByUnits feed{};                 ///< per minute
  ByUnits feed_per_revolution{};  ///< max 0: it has none
  NumberRange speed{0, 20'000};   ///< revolutions per minute
  NumberRange dwell{3, 9999};     ///< seconds
  int max_tool = 99;              ///< 0: no tool numbers
  int min_tool = 0;
  int min_m = 10, max_m = 99;                      ///< M functions of the machine; max 0: none
  std::int64_t max_name = 9999;                    ///< of a program's number
  std::uint64_t max_blocks = 0;                    ///< 0: no limit
  double max_radius_error = 0;                     ///< mm: of the radii at start and end of an arc
  std::size_t max_axes = interpreter::kAxisCount;  ///< in one move
  double max_sweep = 360;      ///< degrees of one arc; 90: an arc stays in a quadrant
  bool has_all_planes = true;  ///< else arcs in XY alone
  bool has_helix = true;
  bool has_all_helices = true;          ///< else those in XY alone
  bool feeds_along_circle = false;      ///< F of a helix is the speed along its circle
  std::optional<RadiusOf> radius = {};  ///< of cutter compensation; absent: it is not written
  bool defines_tools = false;           ///< in its programs: TOOL DEF
  bool has_tool_table = false;          ///< a tool that is not in it is an alarm
  bool has_surface_speed = false;
  bool has_threads = false;  ///< straight and tapered ones, G32
  bool has_lead_along_axis =
      false;  ///< F of a thread is the lead of the longer axis, else of the path
  bool has_mist = true;
  bool has_optional_stop = true;
  bool has_oriented_spindle = false;  ///< M19
  bool stops_spindle_at_tool_change = false;
  bool needs_speed_per_revolution = false;  ///< feeds per revolution without one are an alarm
  bool has_comments = true;
  bool has_inch = true, has_millimeter = true;
};

/// All of them, in the order in which they are listed.
std::span<const Target> targets();
/// "centurion, fanuc, ...": their names.
std::string target_names();
/// Errors: NotFound, naming them.
Result<const Target*> find_target(std::string_view name);
/// Its axes as bits; bit 0 is X.
unsigned axes_of(const Target& target);
/// The tools that a written program runs with: those of its setup; without any those of the
/// source's, but where the program defines them itself. A reference into one of the setups.
const std::vector<interpreter::ToolRecord>& tools_at(const Target& target,
                                                     const interpreter::Setup& target_setup,
                                                     const interpreter::Setup& source_setup);

constexpr const NumberRange& range_of(const ByUnits& ranges, interpreter::Units units) {
  return ranges[static_cast<std::size_t>(units)];
}
constexpr std::string_view unit_name(interpreter::Units units) {
  return units == interpreter::Units::Inch ? "in" : "mm";
}

}  // namespace dripline::post
