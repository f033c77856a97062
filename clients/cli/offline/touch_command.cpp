#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/touch_setup.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

namespace probing = tnc_probing;
using interpreter::Axis;
using interpreter::is_rotary;
using interpreter::Plane;
using interpreter::PlaneAxes;
using interpreter::Position;
using probing::NamedCoordinate;
using probing::ProbingFunction;

struct TouchCommand {
  std::string function, setup;
  std::vector<std::string> touches;
  double ball = 0;
  std::optional<double> travel;
  std::string tool_axis = "Z";
  double ring = 0, nominal = 0;
  std::vector<double> values;  ///< what the touched place is to be called
  bool is_boss = false, is_inch = false, takes_rotation_touches = false;

  double unit() const { return is_inch ? Length::kMillimetersPerInch : 1; }
  Axis tool() const { return *interpreter::axis_of(tool_axis.front()); }
  Plane plane() const { return interpreter::plane_across(tool()); }
  probing::Stylus stylus() const {
    probing::Stylus made;
    made.radius = ball * unit();
    if (travel) made.travel = *travel * unit();
    return made;
  }
};

/// The probe strokes, and where the stylus was at contact.
struct Touched {
  std::vector<probing::Touch> touches;
  std::vector<Position> at;
};

struct MeasuredValue {
  std::string name;
  double value = 0;  ///< millimeters, degrees
  bool is_angle = false;
};
/// The measured values in order, and what the control keeps of them.
struct Measured {
  std::vector<MeasuredValue> values;
  std::string keeps;  ///< TOML for a setup
};

struct Function {
  std::string_view name;
  ProbingFunction function;
  std::size_t values;  ///< of --datum, at most
};
constexpr Function kFunctions[] = {
    {"length", ProbingFunction::Length, 1},     {"radius", ProbingFunction::Radius, 0},
    {"rotation", ProbingFunction::Rotation, 0}, {"surface", ProbingFunction::Surface, 1},
    {"corner", ProbingFunction::Corner, 2},     {"circle", ProbingFunction::Circle, 2}};

const Function& function_of(const TouchCommand& command) {
  for (const Function& row : kFunctions) {
    if (row.name == command.function) return row;
  }
  return kFunctions[0];
}

/// The coordinate the operator gives this axis of the point: 0 by default.
NamedCoordinate named(const TouchCommand& command, Axis axis, std::size_t i) {
  const double value = i < command.values.size() ? command.values[i] : 0;
  return {axis, value * (is_rotary(axis) ? 1 : command.unit())};
}

/// The datum that makes `point` be called so.
std::string datum_text(const TouchSetup& setup, const Position& point,
                       std::span<const NamedCoordinate> names) {
  return datum_toml(setup, probing::datum_for(setup.frame, point, names), names);
}

Measured measure_surface(const TouchCommand& command, const TouchSetup& setup,
                         const Touched& touched) {
  const probing::Touch& touch = touched.touches[0];
  const Position point =
      probing::touched_point(touched.at[0], touch, command.stylus(), command.tool(), setup.frame);
  const NamedCoordinate names[] = {named(command, touch.axis, 0)};
  return {{{std::string(1, letter(touch.axis)), point.raw(touch.axis), is_rotary(touch.axis)}},
          datum_text(setup, point, names)};
}

/// A place in the plane, which becomes the datum; the touches say how deep it is.
Measured place_in_plane(const TouchCommand& command, const TouchSetup& setup, Position depth,
                        interpreter::PlaneVector place) {
  const PlaneAxes axes = axes_of(command.plane());
  depth.set_raw(axes.first, place.first);
  depth.set_raw(axes.second, place.second);
  const NamedCoordinate names[] = {named(command, axes.first, 0), named(command, axes.second, 1)};
  return {{{std::string(1, letter(axes.first)), place.first},
           {std::string(1, letter(axes.second)), place.second}},
          datum_text(setup, depth, names)};
}

Result<Measured> measure_corner(const TouchCommand& command, const TouchSetup& setup,
                                const Touched& touched) {
  const auto& [touches, at] = touched;
  const auto corner =
      probing::corner({touches[0], touches[1], at[0], at[1]},
                      {touches[2], touches[3], at[2], at[3]}, command.stylus(), command.plane());
  if (!corner) return fail(corner.error());
  Measured measured = place_in_plane(command, setup, at[3], corner->at);
  measured.values.push_back({"PA of side 1", corner->first_angle, true});
  measured.values.push_back({"PA of side 2", corner->second_angle, true});
  return measured;
}

Measured measure_circle(const TouchCommand& command, const TouchSetup& setup,
                        const Touched& touched) {
  const std::span<const Position, 4> four(touched.at.data(), 4);
  const auto circle =
      probing::circle_center(four, command.plane(), !command.is_boss, command.stylus());
  Measured measured = place_in_plane(command, setup, touched.at[3], circle.center);
  measured.values.push_back({"PR", circle.radius});
  return measured;
}

Result<Measured> measure_rotation(const TouchCommand& command, const TouchSetup& setup,
                                  const Touched& touched) {
  const auto angle =
      probing::basic_rotation(touched.at[0], touched.at[1], command.plane(), command.nominal);
  if (!angle) return fail(angle.error());
  std::vector<probing::Touch> places = touched.touches;
  for (std::size_t i = 0; i < places.size(); ++i) places[i].from = touched.at[i];
  return Measured{{{"basic rotation", *angle, true}}, rotation_toml(setup, *angle, places)};
}

Result<Measured> measure(const TouchCommand& command, const TouchSetup& setup,
                         const Touched& touched) {
  switch (function_of(command).function) {
    case ProbingFunction::Length: {
      const double plane = named(command, command.tool(), 0).value;
      return Measured{
          {{"effective length", probing::calibrated_length(touched.at[0], command.tool(), plane)}},
          ""};
    }
    case ProbingFunction::Surface:
      return measure_surface(command, setup, touched);
    case ProbingFunction::Rotation:
      return measure_rotation(command, setup, touched);
    case ProbingFunction::Corner:
      return measure_corner(command, setup, touched);
    case ProbingFunction::Circle:
      return measure_circle(command, setup, touched);
    default:
      break;
  }
  const std::span<const Position, 4> four(touched.at.data(), 4);
  const auto radius =
      probing::calibrated_radius(four, command.plane(), command.ring * command.unit());
  if (!radius) return fail(radius.error());
  return Measured{{{"effective radius", *radius}}, ""};
}

void report(Context& context, const TouchCommand& command, const Touched& touched,
            const Measured& measured) {
  const auto value_of = [&](const MeasuredValue& one) {
    return one.is_angle ? one.value : one.value / command.unit();
  };
  std::string text;
  auto places = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < touched.at.size(); ++i) {
    nlohmann::ordered_json json;
    text += fmt::format("touch {}:", i + 1);
    for (const Axis axis : interpreter::kAllAxes) {
      if (axis > Axis::Z && axis != touched.touches[i].axis) continue;
      const double place = touched.at[i].raw(axis) / (is_rotary(axis) ? 1 : command.unit());
      json[std::string(1, letter(axis))] = place;
      text += fmt::format("{} {} {:+.3f}", axis == Axis::X ? "" : " ", letter(axis), place);
    }
    places.push_back(std::move(json));
    text += '\n';
  }
  if (context.wants_json) {
    nlohmann::ordered_json values;
    for (const auto& one : measured.values) values[one.name] = value_of(one);
    context.print(json_text({{"units", command.is_inch ? "in" : "mm"},
                             {"touched", places},
                             {"measured", values},
                             {"setup", measured.keeps}}));
    return;
  }
  for (const auto& one : measured.values) {
    text += fmt::format("{} {:+.4f}\n", one.name, value_of(one));
  }
  if (!measured.keeps.empty()) text += "\n# for the machine's setup\n" + measured.keeps;
  context.print(text);
}

/// Checks what can be checked before anything is probed. Errors: Syntax.
Result<void> check(const TouchCommand& command, const TouchSetup& setup) {
  const Function& row = function_of(command);
  if (command.values.size() > row.values) {
    return fail(Errc::Syntax, "--datum has {} values, {} takes {}", command.values.size(), row.name,
                row.values);
  }
  if (row.function == ProbingFunction::Rotation && command.tool() != Axis::Z) {
    return fail(Errc::Syntax,
                "--tool-axis {}: a basic rotation rotates coordinates of the plane XY, across Z",
                command.tool_axis);
  }
  std::size_t kept = 0;
  if (command.takes_rotation_touches) {
    if (row.function != ProbingFunction::Corner) {
      return fail(Errc::Syntax, "--rotation-touches is for corner");
    }
    if (setup.rotation_touches.empty()) {
      return fail(Errc::Syntax, "{} has no touch points of a basic rotation", command.setup);
    }
    kept = setup.rotation_touches.size();
  }
  const std::size_t needed = probing::touches_of(row.function) - kept;
  if (command.touches.size() == needed) return {};
  return fail(Errc::Syntax, "{} takes {} touches{}, {} are given", row.name, needed,
              kept != 0 ? " besides those of the basic rotation" : "", command.touches.size());
}

/// All probe strokes; first those of the basic rotation, where they are taken.
Result<std::vector<probing::Touch>> read_touches(const TouchCommand& command,
                                                 const TouchSetup& setup) {
  std::vector<probing::Touch> touches;
  if (command.takes_rotation_touches) touches = setup.rotation_touches;
  for (const std::string& text : command.touches) {
    const auto touch = parse_touch(text, {setup.fourth_axis, command.unit()});
    if (!touch) return fail(touch.error());
    touches.push_back(*touch);
  }
  auto checked = probing::check_touches(function_of(command).function, touches, command.tool());
  if (!checked) return fail(checked.error());
  return touches;
}

/// The places of a basic rotation are known, the others are touched.
Result<Touched> touch_all(const TouchCommand& command, const TouchSetup& setup,
                          std::vector<probing::Touch> touches) {
  Touched touched{std::move(touches), {}};
  for (const probing::Touch& touch : touched.touches) {
    const bool is_known =
        command.takes_rotation_touches && touched.at.size() < setup.rotation_touches.size();
    auto at = is_known ? Result<Position>(touch.from)
                       : probing::touch(setup.workpiece, command.stylus(), touch);
    if (!at) return fail(at.error());
    touched.at.push_back(*at);
  }
  return touched;
}

int run_touch(Context& context, const TouchCommand& command) {
  const auto setup = read_touch_setup(command.setup);
  if (!setup) return complain(setup.error());
  if (auto checked = check(command, *setup); !checked) return complain(checked.error());
  auto touches = read_touches(command, *setup);
  if (!touches) return complain(touches.error());
  const auto no = [](const Error& error) {
    complain(error);
    return kExitNo;
  };
  const auto touched = touch_all(command, *setup, std::move(*touches));
  if (!touched) return no(touched.error());
  const auto measured = measure(command, *setup, *touched);
  if (!measured) return no(measured.error());
  report(context, command, *touched, *measured);
  return kExitOk;
}

void add_touch_options(Command command, TouchCommand& options) {
  command.add_option("--setup", options.setup, "TOML file with the workpiece: [probe]").required();
  command.add_option("--ball", options.ball, "Effective radius of the stylus [0]")
      .check(non_negative_number());
  command.add_option("--travel", options.travel, "Longest probe stroke [100 mm]")
      .check(positive_number());
  command.add_option("--tool-axis", options.tool_axis, "X, Y or Z [Z]")
      .check(one_of({"X", "Y", "Z"}));
  const Check is_number(
      [](std::string& text) {
        return text.find_first_of("nN") == std::string::npos ? "" : text + " is no number";
      },
      "");  // the parser takes inf and nan for numbers
  command.add_option("--ring", options.ring, "Radius of the ring gauge, for the function radius")
      .check(is_number);
  command
      .add_option("--nominal", options.nominal,
                  "Nominal angle of the side, for the function rotation [0]")
      .check(is_number);
  command
      .add_option("--datum", options.values,
                  "Set the datum: coordinates of the measured point, e.g. 50,10 [0]")
      .delimiter(',')
      .check(is_number)
      .allow_extra_args(false);
  command.add_flag("--boss", options.is_boss, "Probe the circle from outside");
  command.add_flag("--rotation-touches", options.takes_rotation_touches,
                   "Corner: the first side is where the setup's basic rotation was touched");
  command.add_flag("--inch", options.is_inch, "Read the lengths of this command as inches, not mm");
}

}  // namespace

void add_touch_command(Command app, Context& context) {
  auto command = app.add_subcommand(
      "touch", "Run the TNC 155's touch probe functions on the workpiece of a setup file");
  auto options = std::make_shared<TouchCommand>();
  command
      .add_option("FUNCTION", options->function,
                  "length, radius (calibration), rotation, surface, corner, circle")
      .required()
      .check(one_of({"length", "radius", "rotation", "surface", "corner", "circle"}));
  command
      .add_option(
          "TOUCH", options->touches,
          "Axis, direction and start of each, e.g. X+:10,20,-5; C+:40,0,-5,90 begins at C 90")
      .required();
  add_touch_options(command, *options);
  add_json_flag(command, context);
  command.footer(
      "No server is needed. Circle and radius take the touches in the order +, - of the first "
      "axis, then of\nthe second; corner takes two on each side. With a basic rotation in the "
      "setup the datum applies to the\nrotated coordinates. Values for the setup are in the "
      "setup's units. The fourth axis rotates about the\nmachine's zero.\n\nExit status: 0 "
      "measured, 1 no contact, or not measurable, 2 usage.\n\nExamples:\n  dnc touch circle "
      "--setup bore.toml --ball 2 X+:50,40,-5 X-:50,40,-5 Y+:50,40,-5 Y-:50,40,-5\n  dnc touch "
      "corner --setup vice.toml --rotation-touches --datum 0,0 X+:-20,15,-5 X+:-20,35,-5");
  command.callback([&context, options] { context.status = run_touch(context, *options); });
}

}  // namespace dripline::cli
