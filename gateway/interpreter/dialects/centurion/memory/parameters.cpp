#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"

#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"

namespace dripline::interpreter::centurion {

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
  // zeroes, axis parameters; then centers of mirror, scaling and rotation, and clearances
  for (int number = kWorkOffsets; number <= kLastAxisParameter; ++number) (*this)[number] *= factor;
  for (const MachineParameter& row : machine_parameters()) {
    if (!row.is_length) continue;
    for (int i = 0; i < row.count(); ++i) (*this)[row.number + i] *= factor;
  }
  for (const int number : {139, 140, 172, 173, 180, 181, 196, 197}) (*this)[number] *= factor;
  for (int offset = 1; offset <= kOffsetCount; ++offset) {
    for (const ToolField field : {ToolField::LengthZ, ToolField::LengthX, ToolField::Radius,
                                  ToolField::WearZ, ToolField::WearX, ToolField::WearRadius}) {
      (*this)[tool_parameter(offset, field)] *= factor;
    }
  }
}

namespace {

/// Parameters that hold one value for each axis, Z first then X (manual: axes).
std::optional<double> axis_status(const ModalState& state, const Parameters& parameters,
                                  int number) {
  const bool is_x = (number & 7) == 1;
  if ((number & 7) > 1 || number > 255) return std::nullopt;
  const auto of = [is_x](const Point& point) { return is_x ? point.x : point.z; };
  const double length =
      state.tool.has_no_length
          ? 0
          : parameters.tool(state.tool.offset, is_x ? ToolField::LengthX : ToolField::LengthZ);
  switch (number & ~7) {
    case 200:
      return of(state.previous) - of(state.origin);
    case 208:
      return of(state.position) - of(state.origin);
    case 216:
      return of(state.previous) + length;
    case 224:
      return of(state.position) + length;
    case 232:
      return of(state.origin);
    case 240:
      return length;
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
