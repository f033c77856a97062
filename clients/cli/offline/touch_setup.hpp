#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/tnc_probing/probing_functions.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "protocol/base/result.hpp"

/// What `dnc touch` reads from a setup and writes into one.
namespace dripline::cli {

struct TouchSetup {
  interpreter::Workpiece workpiece;
  interpreter::tnc155::Transformation frame;  ///< datum and basic rotation
  interpreter::Position datum;                ///< as the setup names its axes
  interpreter::Units units = interpreter::Units::Millimeter;
  interpreter::Axis fourth_axis = interpreter::Axis::C;
  /// Where the basic rotation was touched, as a touch that begins there; empty: not kept.
  std::vector<tnc_probing::Touch> rotation_touches;
};
/// Errors: Io, Syntax; naming file and option.
Result<TouchSetup> read_touch_setup(const std::string& path);

/// How touches are written: the control's fourth axis, and how long a unit is.
struct TouchForm {
  interpreter::Axis fourth_axis = interpreter::Axis::C;
  double millimeters = 1;
};
/// "X+:10,20,-5": along +X from there; the position of the fourth axis may follow. Errors:
/// Syntax.
Result<tnc_probing::Touch> parse_touch(const std::string& text, const TouchForm& form);

/// A datum for the setup, in its units: the axes that it has already, and `named`.
std::string datum_toml(const TouchSetup& setup,
                       const interpreter::tnc155::Transformation::Values& datum,
                       std::span<const tnc_probing::NamedCoordinate> named);
/// A basic rotation for the setup, with the places that were touched.
std::string rotation_toml(const TouchSetup& setup, double degrees,
                          std::span<const tnc_probing::Touch> touched);

}  // namespace dripline::cli
