#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"

#include <algorithm>

#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr int kFirstControlParameter = 100;
constexpr int kLastControlParameter = 199;

enum class Quantity : std::uint8_t { Length, Feed, Angle, Time, Factor, Number };
struct ControlParameters {
  int first;
  int last;
  Quantity quantity;
};
/// Those that are not here mean nothing to the control.
constexpr std::array kControlParameters{
    ControlParameters{100, 101, Quantity::Length},  // change of a lead, lead: per revolution
    ControlParameters{102, 102, Quantity::Angle},   // start of a thread
    ControlParameters{103, 103, Quantity::Length},  // chamfer of a thread
    ControlParameters{104, 104, Quantity::Angle},
    ControlParameters{105, 105, Quantity::Number},  // method
    ControlParameters{106, 107, Quantity::Length},  // height, first cut
    ControlParameters{108, 108, Quantity::Angle},   // nose angle
    ControlParameters{110, 111, Quantity::Number},  // first and last block of a pattern
    ControlParameters{112, 116, Quantity::Length},  // stocks, increment
    ControlParameters{117, 117, Quantity::Number},  // kind of relief
    ControlParameters{118, 119, Quantity::Length},  // relief, first depth
    ControlParameters{121, 126, Quantity::Length},  // length, depth, end of a cut, tapers
    ControlParameters{130, 130, Quantity::Length},  // least cut of a thread
    ControlParameters{131, 131, Quantity::Number},  // finish passes
    ControlParameters{136, 136, Quantity::Length},  // radius of the probe
    ControlParameters{139, 144, Quantity::Length},  // clearances, depths, increment
    ControlParameters{145, 145, Quantity::Feed},
    ControlParameters{146, 147, Quantity::Length},  // peckup, clearance of a peck
    ControlParameters{148, 149, Quantity::Time},
    ControlParameters{156, 157, Quantity::Length},  // material
    ControlParameters{172, 173, Quantity::Length},  // mirror
    ControlParameters{180, 181, Quantity::Length},  // center of scaling
    ControlParameters{188, 189, Quantity::Factor},
    ControlParameters{196, 197, Quantity::Length},  // center of rotation
    ControlParameters{198, 198, Quantity::Angle},
    ControlParameters{199, 199, Quantity::Number},  // incremental data of cycles
};

}  // namespace

bool is_length_parameter(int number) {
  return std::ranges::any_of(kControlParameters, [number](const ControlParameters& row) {
    return number >= row.first && number <= row.last &&
           (row.quantity == Quantity::Length || row.quantity == Quantity::Feed);
  });
}

Point Parameters::work_offset(int system) const {
  return point(kWorkOffsets + 2 * system);
}

int Parameters::tool_parameter(int offset, ToolField field) {
  return kToolOffsets + kFieldsPerTool * (offset - 1) + static_cast<int>(field);
}

double Parameters::tool(int offset, ToolField field) const {
  if (offset <= 0 || offset > kOffsetCount) return 0;
  const double value = (*this)[tool_parameter(offset, field)];
  switch (field) {
    case ToolField::LengthZ:
      return value + (*this)[tool_parameter(offset, ToolField::WearZ)];
    case ToolField::LengthX:
      return value + (*this)[tool_parameter(offset, ToolField::WearX)];
    case ToolField::Radius:
      return value + (*this)[tool_parameter(offset, ToolField::WearRadius)];
    default:
      return value;
  }
}

void Parameters::convert_tables(double factor) {
  for (int number = kWorkOffsets; number <= kLastAxisParameter; ++number) (*this)[number] *= factor;
  for (const MachineParameter& row : machine_parameters()) {
    if (!row.is_length) continue;
    for (int i = 0; i < row.count(); ++i) (*this)[row.number + i] *= factor;
  }
  for (int number = kFirstControlParameter; number <= kLastControlParameter; ++number) {
    if (is_length_parameter(number)) (*this)[number] *= factor;
  }
  for (int offset = 1; offset <= kOffsetCount; ++offset) {
    for (const ToolField field : {ToolField::LengthZ, ToolField::LengthX, ToolField::Radius,
                                  ToolField::WearZ, ToolField::WearX, ToolField::WearRadius}) {
      (*this)[tool_parameter(offset, field)] *= factor;
    }
  }
}

Point tool_length(const ModalState& state, const Parameters& parameters) {
  if (state.tool.has_no_length) return {};
  const int offset = state.tool.offset;
  return {parameters.tool(offset, ToolField::LengthX), parameters.tool(offset, ToolField::LengthZ)};
}

Point machine_position(const ModalState& state) {
  const Point at = machine_of(state, state.position);
  return {at.x + state.length_taken.x, at.z + state.length_taken.z};
}

namespace {

/// Parameters that hold one value for each axis, Z first then X (manual: axes).
std::optional<double> axis_status(const ModalState& state, const Parameters& parameters,
                                  int number) {
  const bool is_x = (number & 7) == 1;
  if ((number & 7) > 1 || number > 255) return std::nullopt;
  const auto of = [is_x](const Point& point) { return is_x ? point.x : point.z; };
  switch (number & ~7) {
    case 200:
      return of(state.previous) - of(state.origin);
    case 208:
      return of(state.position) - of(state.origin);
    case 216:
      return of(state.previous_machine);
    case 224:
      return of(machine_position(state));
    case 232:
      return of(state.origin);
    case 240:
      return of(tool_length(state, parameters));
    default:
      return std::nullopt;
  }
}

/// Feedback pulses of both axes.
constexpr double kPulsesPerInch = 10000;

std::optional<double> mode_status(const ModalState& state, int number) {
  const auto flag = [](bool is_other) { return is_other ? 1.0 : 0.0; };
  switch (number) {
    case 304:
      return flag(state.modes.takes_data);
    case 306:
      return static_cast<double>(state.modes.motion);
    case 309:
      return state.modes.compensation;
    case 310:
      return 0;  // a cycle ends with its block
    case 267:
      return state.units == Units::Inch ? kPulsesPerInch
                                        : kPulsesPerInch / Length::kMillimetersPerInch;
    case 370:
      return state.tool.active;
    case 311:
      return flag(state.modes.is_incremental);
    case 312:
      return flag(state.modes.is_feed_per_revolution);
    case 313:
      return flag(state.modes.is_surface_speed);
    case 315:
      return flag(state.units == Units::Millimeter);
    case 316:
      return flag(state.transformation.scales);
    case 317:
      return flag(state.transformation.rotates);
    case 318:
      return flag(state.transformation.mirrors());
    case 319:
      return state.modes.work_system + 1;
    case 323:
      return flag(state.modes.returns_to_clearance);
    case 324:
      return flag(state.modes.path == PathMode::Tapping);
    case 365:
      return state.feed[0];
    case 366:
      return state.feed[1];
    case 367:
      return state.spindle.revolutions;
    case 368:
      return state.spindle.surface;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<double> status_parameter(const ModalState& state, const Parameters& parameters,
                                       int number) {
  if (number < 248) return axis_status(state, parameters, number);
  switch (number) {
    case 248:
      return state.last_arc_radius;
    case 249:
    case 270:
      return state.retained.center_z;
    case 250:
    case 271:
      return state.retained.center_x;
    case 251:
      return state.active_feed();
    case 252:
      return state.dwell_seconds;
    case 253:
      return state.modes.is_surface_speed ? state.spindle.surface : state.spindle.revolutions;
    case 254:
      return state.position.z - state.origin.z;
    case 255:
      return state.position.x - state.origin.x;
    case 260:
      return state.tool.active;
    case 266:
      return state.modes.checks_zone ? 1 : 0;
    case 268:
      return state.tool.pending;
    case 298:
      return state.spindle.limit;
    default:
      return mode_status(state, number);
  }
}

}  // namespace dripline::interpreter::centurion
