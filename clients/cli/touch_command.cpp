#include <fmt/format.h>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/commands.hpp"
#include "clients/cli/json_text.hpp"
#include "clients/cli/port_file.hpp"
#include "gateway/interpreter/setup.hpp"
#include "gateway/interpreter/tnc155/control_version.hpp"
#include "gateway/interpreter/tnc155/probing_functions.hpp"

namespace dripline::cli {
namespace {

namespace tnc = interpreter::tnc155;
using interpreter::Axis;
using interpreter::Plane;
using interpreter::PlaneAxes;
using interpreter::Position;

constexpr std::size_t kMaxSetup = 1024 * 1024;

struct TouchCommand {
  std::string function, setup;
  std::vector<std::string> touches;
  tnc::Stylus stylus;
  std::string tool_axis = "Z";
  double ring = 0, nominal = 0;
  std::vector<double> values;  ///< what the touched place is to be called
  bool is_boss = false;
};

/// What was measured: names and values, in order, and what the control keeps of it.
struct Measured {
  std::vector<std::pair<std::string, double>> values;
  std::string keeps;  ///< TOML for a setup
};

struct Function {
  std::string_view name;
  std::size_t touches;
};
constexpr Function kFunctions[] = {{"length", 1},  {"radius", 4}, {"rotation", 2},
                                   {"surface", 1}, {"corner", 4}, {"circle", 4}};

/// "X+:10,20,-5": along +X from there.
Result<tnc::Touch> parse_touch(const std::string& text) {
  const auto wrong = [&] {
    return fail(Errc::Syntax, "touch \"{}\": expected axis, direction and start, as X+:10,20,-5",
                text);
  };
  if (text.size() < 4 || text[2] != ':') return wrong();
  const auto axis = interpreter::axis_of(text[0]);
  if (!axis || *axis > Axis::Z || (text[1] != '+' && text[1] != '-')) return wrong();
  tnc::Touch touch;
  touch.axis = *axis;
  touch.direction = text[1] == '+' ? tnc::ProbeDirection::Positive : tnc::ProbeDirection::Negative;
  const char* at = text.c_str() + 3;
  for (const Axis each : {Axis::X, Axis::Y, Axis::Z}) {
    char* end = nullptr;
    touch.from.set(each, Length::mm(std::strtod(at, &end)));
    if (end == at || *end != (each == Axis::Z ? '\0' : ',')) return wrong();
    at = end + 1;
  }
  return touch;
}

double value_at(const TouchCommand& command, std::size_t i) {
  return i < command.values.size() ? command.values[i] : 0;
}

/// The datum that makes `place` be called as the operator said.
std::string datum_text(const TouchCommand& command,
                       const std::vector<std::pair<Axis, double>>& place) {
  std::string text = "[[offset]]\nname = \"datum\"\n";
  for (std::size_t i = 0; i < place.size(); ++i) {
    text +=
        fmt::format("{} = {}\n", letter(place[i].first), place[i].second - value_at(command, i));
  }
  return text;
}

Measured surface(const TouchCommand& command, const tnc::Touch& touch, const Position& at,
                 Axis tool) {
  const double coordinate = tnc::touched_coordinate(at, touch, command.stylus, tool);
  return {{{std::string(1, letter(touch.axis)), coordinate}},
          datum_text(command, {{touch.axis, coordinate}})};
}

Result<Measured> measure_corner(const TouchCommand& command, const std::vector<tnc::Touch>& touches,
                                const std::vector<Position>& at, Plane plane) {
  const auto corner = tnc::corner({touches[0], touches[1], at[0], at[1]},
                                  {touches[2], touches[3], at[2], at[3]}, command.stylus, plane);
  if (!corner) return fail(corner.error());
  const PlaneAxes axes = axes_of(plane);
  return Measured{
      {{std::string(1, letter(axes.first)), corner->at.first},
       {std::string(1, letter(axes.second)), corner->at.second},
       {"PA of side 1", corner->first_angle},
       {"PA of side 2", corner->second_angle}},
      datum_text(command, {{axes.first, corner->at.first}, {axes.second, corner->at.second}})};
}

Measured measure_circle(const TouchCommand& command, std::span<const Position, 4> at, Plane plane) {
  const auto circle = tnc::circle_centre(at, plane, !command.is_boss, command.stylus);
  const PlaneAxes axes = axes_of(plane);
  return {{{std::string(1, letter(axes.first)), circle.centre.first},
           {std::string(1, letter(axes.second)), circle.centre.second},
           {"PR", circle.radius}},
          datum_text(command,
                     {{axes.first, circle.centre.first}, {axes.second, circle.centre.second}})};
}

Result<Measured> measure(const TouchCommand& command, const std::vector<tnc::Touch>& touches,
                         const std::vector<Position>& at) {
  const Axis tool = *interpreter::axis_of(command.tool_axis.front());
  const Plane plane = interpreter::plane_across(tool);
  if (command.function == "length") {
    const double length = tnc::calibrated_length(at[0], tool, value_at(command, 0));
    return Measured{{{"effective length", length}}, ""};
  }
  if (command.function == "surface") return surface(command, touches[0], at[0], tool);
  if (command.function == "rotation") {
    const auto angle = tnc::basic_rotation(at[0], at[1], plane, command.nominal);
    if (!angle) return fail(angle.error());
    return Measured{{{"basic rotation", *angle}},
                    fmt::format("[control]\nbasic_rotation = {}\n", *angle)};
  }
  if (command.function == "corner") return measure_corner(command, touches, at, plane);
  const std::span<const Position, 4> four(at.data(), 4);
  if (command.function == "circle") return measure_circle(command, four, plane);
  const auto radius = tnc::calibrated_radius(four, plane, command.ring);
  if (!radius) return fail(radius.error());
  return Measured{{{"effective radius", *radius}}, ""};
}

/// The probe is an extra of a control that has the functions for it.
Result<interpreter::Workpiece> read_workpiece(const std::string& path) {
  const auto text = read_small_file(path, kMaxSetup);
  if (!text) return fail(text.error());
  const auto setup = interpreter::parse_setup(*text);
  if (!setup) return fail(setup.error().code, "{}: {}", path, setup.error().what);
  const auto version = tnc::version_of(setup->control);
  if (!version) return fail(version.error().code, "{}: {}", path, version.error().what);
  if (!version->has(tnc::Feature::TouchProbe)) {
    return fail(Errc::Unsupported, "{}: {}", path, version->lacks(tnc::Feature::TouchProbe));
  }
  return setup->workpiece;
}

void report(Context& context, const std::vector<Position>& at, const Measured& measured) {
  const auto place = [](const Position& position) {
    nlohmann::ordered_json json;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
      json[std::string(1, letter(axis))] = position.raw(axis);
    }
    return json;
  };
  if (context.wants_json) {
    auto touches = nlohmann::ordered_json::array();
    for (const Position& position : at) touches.push_back(place(position));
    nlohmann::ordered_json values;
    for (const auto& [name, value] : measured.values) values[name] = value;
    context.print(
        json_text({{"touched", touches}, {"measured", values}, {"setup", measured.keeps}}));
    return;
  }
  std::string text;
  for (std::size_t i = 0; i < at.size(); ++i) {
    text += fmt::format("touch {}: X {:+.3f}  Y {:+.3f}  Z {:+.3f}\n", i + 1, at[i].raw(Axis::X),
                        at[i].raw(Axis::Y), at[i].raw(Axis::Z));
  }
  for (const auto& [name, value] : measured.values)
    text += fmt::format("{} {:+.4f}\n", name, value);
  if (!measured.keeps.empty()) text += "\n# for the machine's setup\n" + measured.keeps;
  context.print(text);
}

int run_touch(Context& context, const TouchCommand& command) {
  std::size_t needed = 0;
  for (const Function& row : kFunctions)
    needed = row.name == command.function ? row.touches : needed;
  if (command.touches.size() != needed) {
    return complain(
        Error{Errc::Syntax, fmt::format("{} takes {} touches, {} are given", command.function,
                                        needed, command.touches.size())});
  }
  const auto workpiece = read_workpiece(command.setup);
  if (!workpiece) return complain(workpiece.error());
  std::vector<tnc::Touch> touches;
  std::vector<Position> at;
  for (const std::string& text : command.touches) {
    const auto touch = parse_touch(text);
    if (!touch) return complain(touch.error());
    const auto touched = tnc::touch(*workpiece, command.stylus, *touch);
    if (!touched) {
      complain(touched.error());
      return kExitNo;
    }
    touches.push_back(*touch);
    at.push_back(*touched);
  }
  const auto measured = measure(command, touches, at);
  if (!measured) {
    complain(measured.error());
    return kExitNo;
  }
  report(context, at, *measured);
  return kExitOk;
}

}  // namespace

void add_touch_command(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "touch", "The TNC 155's touch probe functions on the workpiece of a setup file");
  auto options = std::make_shared<TouchCommand>();
  command
      ->add_option("FUNCTION", options->function,
                   "length, radius (calibration), rotation, surface, corner, circle")
      ->required()
      ->check(CLI::IsMember({"length", "radius", "rotation", "surface", "corner", "circle"}));
  command
      ->add_option("TOUCH", options->touches,
                   "Axis, direction and start of each, e.g. X+:10,20,-5 (mm)")
      ->required();
  command->add_option("--setup", options->setup, "TOML file with the workpiece: [probe]")
      ->required();
  command->add_option("--ball", options->stylus.radius, "Effective radius of the stylus [0]");
  command->add_option("--travel", options->stylus.travel, "Longest way of a touch [100]")
      ->check(CLI::PositiveNumber);
  command->add_option("--tool-axis", options->tool_axis, "X, Y or Z [Z]")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command->add_option("--ring", options->ring, "Radius of the ring gauge, of radius");
  command->add_option("--nominal", options->nominal, "Angle the side should have, of rotation [0]");
  command
      ->add_option("--datum", options->values,
                   "What the place is to be called, a value an axis [0]")
      ->delimiter(',');
  command->add_flag("--boss", options->is_boss, "The circle is touched from outside");
  add_json_flag(*command, context);
  command->footer(
      "No server is needed. Circle and radius take the touches in the order +, - of the first "
      "axis, "
      "then of the second.\n\nExample:\n  dnc touch circle --setup bore.toml --ball 2 X+:50,40,-5 "
      "X-:50,40,-5 Y+:50,40,-5 Y-:50,40,-5");
  command->callback([&context, options] { context.status = run_touch(context, *options); });
}

}  // namespace dripline::cli
