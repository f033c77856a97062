#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/graphics/cutting_simulation.hpp"
#include "clients/tools/graphics/picture.hpp"
#include "clients/tools/graphics/views.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// The request of `dnc graphics`. Lengths are in the user's units until they are read.
struct GraphicsCommand {
  OfflineCommand program;
  std::string output;   ///< .png
  std::string heights;  ///< .json
  std::string print;    ///< bytes for a printer
  std::string printer;  ///< empty: the setup's, or an EPSON
  std::string view;     ///< empty: the machine's usual one
  int shades = 17;
  std::string arrangement = "din";
  double rotation = -30, tilt = 35;
  std::string section;  ///< X40,Y20
  std::string blank, detail;
  std::string spindle = "Z";
  double tool_radius = 0;
  std::optional<std::size_t> size;
  bool is_inch = false, shows_helices = false;
  // of turned parts
  std::vector<std::string> tool_widths;  ///< 5=10
  double insert_degrees = 55;
  bool shows_path = false, shows_part_path = false;
  bool shows_limits = false, shows_zone = false, has_front_turret = false;
};

/// Low and high on each axis that was named, in millimeters.
struct AxisRanges {
  std::optional<double> low[3], high[3];
};

/// "X0:100,Y-20:20": ranges. Errors: Syntax, naming the part.
Result<AxisRanges> parse_ranges(std::string_view text, bool is_inch);

/// A cuboid from ranges, in the work frame; axes that are not named are those of `whole`, or an
/// error when there is none. Errors: Syntax (an axis is missing, a range without extent).
Result<graphics::Cuboid> cuboid_of(const AxisRanges& ranges, const graphics::WorkFrame& frame,
                                   const std::optional<graphics::Cuboid>& whole);

/// The picture as PNG, and for a printer, where the command asks for them. The printer is the one
/// that was named, else that of the setup's machine parameters 226 to 233, else an EPSON. Errors:
/// Io, NotFound (the printer), Syntax, LimitExceeded (a machine parameter); nothing is written
/// then.
Result<void> write_picture(const GraphicsCommand& command, const interpreter::Setup& setup,
                           const graphics::Picture& picture);

/// Which TNC 151/155 a setup file describes; of no file (an empty name) the newest, which has
/// everything. Errors: Io, Syntax; naming the file.
Result<interpreter::tnc155::ControlVersion> tnc_version_of(const std::string& setup_file);

/// Whether the TNC that the program's setup describes could show what the command asks for; other
/// controls have no graphics of their own. Errors: Unsupported.
Result<void> check_tnc_graphics(const GraphicsCommand& command, const OfflineProgram& program);

}  // namespace dripline::cli
