#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/parameters.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/codes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/state.hpp"

namespace dripline::interpreter::rs274ngc {

/// A row of the tool table; millimeters.
struct Tool {
  int number = 0;
  Axes length{};
  double diameter = 0;
  double front_angle = 0, back_angle = 0;  ///< degrees, of a lathe tool
  int orientation = 0;                     ///< of its tip, 1 to 9; 0 = a mill's

  friend bool operator==(const Tool&, const Tool&) = default;
};

/// What a machine's builder and operator have set: the `[control]` options and the panel's
/// switches.
struct ControlOptions {
  Profile profile = Profile::Nist;
  bool block_skip = false;
  bool is_mdi = false;  ///< Setup::is_mdi
  bool optional_stop = false;
  AddressSet axes = 0;           ///< words of the axes the machine has
  bool has_tool_changer = true;  ///< false: M6 stops for the operator's hands
  bool ignores_missing_axes = false;
  int slots = 128;                       ///< of the tool changer
  std::uint64_t max_passes = 1'000'000;  ///< of loops and calls, together
  std::uint64_t max_restarts = 1000;     ///< of the main program by M99
  double spline_tolerance = 0.001;       ///< mm, of the pieces of G5 to G5.3
  std::string startup_code;              ///< startup_code.hpp
  double mm_per_machine_unit = 1;        ///< of stored parameters
  std::vector<std::int64_t> pins;
  bool answers_pins = false;  ///< `pins` was given: no operator need be asked
  /// `hal` was given: no machine need be asked.
  std::optional<std::map<std::string, double, std::less<>>> hal;

  bool is_linuxcnc() const { return profile == Profile::LinuxCnc; }
};

/// Errors: Syntax, Unsupported (an option this control does not have).
Result<ControlOptions> read_options(const Setup& setup);

/// The control's memory at the start: position, parameters, offsets, tools. Tools are those of the
/// setup. Errors: Unsupported, naming the record that this control does not have.
Result<void> load_memory(const Setup& setup, const ControlOptions& options, State& state,
                         Parameters& parameters, std::vector<Tool>& tools);

/// The rows of its options, for people.
std::vector<ListedOption> list_options();

}  // namespace dripline::interpreter::rs274ngc
