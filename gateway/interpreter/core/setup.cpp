#include "gateway/interpreter/core/setup.hpp"

#include <algorithm>
#include <chrono>

#include "gateway/interpreter/core/impl/setup_table.hpp"
#include "gateway/interpreter/core/machine_data.hpp"

namespace dripline::interpreter {
namespace {

using setup_file::finite_number;
using setup_file::Reading;
using setup_file::Table;

constexpr std::size_t kMaxSetupBytes = 1024 * 1024;

constexpr auto kEveryAxis = {Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B,
                             Axis::C, Axis::U, Axis::V, Axis::W};

void read_units(Table& file) {
  file.read("units", "expected \"in\" or \"mm\"", [&](const toml::node& node) {
    const auto value = node.value<std::string_view>();
    if (value != "in" && value != "mm") return false;
    file.reading().units = value == "in" ? Units::Inch : Units::Millimeter;
    return true;
  });
}

void read_switches(Table& table, Switches& switches) {
  table.flag("block_skip", switches.block_skip);
  table.flag("optional_stop", switches.optional_stop);
  table.flag("single_block", switches.single_block);
  table.flag("dry_run", switches.dry_run);
  table.each("mirror", "expected a list of axis letters", [&](const toml::node& node) {
    const auto name = node.value<std::string_view>();
    const auto axis = name && name->size() == 1 ? axis_of((*name)[0]) : std::nullopt;
    if (axis) switches.mirror.push_back(*axis);
    return axis.has_value();
  });
}

bool is_date_time(const LocalTime& time) {
  const auto date = std::chrono::year_month_day(
      std::chrono::year(time.year), std::chrono::month(static_cast<unsigned>(time.month)),
      std::chrono::day(static_cast<unsigned>(time.day)));
  return date.ok() && time.hour < 24 && time.minute < 60 && time.second < 60;
}

/// YYYY-MM-DDThh:mm:ss, all digits in their places.
std::optional<LocalTime> parse_date_time(std::string_view text) {
  constexpr std::string_view kShape = "dddd-dd-ddTdd:dd:dd";
  if (text.size() != kShape.size()) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kShape[i] == 'd' ? !digit : text[i] != kShape[i]) return std::nullopt;
  }
  const auto field = [&](std::size_t from, std::size_t size) {
    int value = 0;
    for (const char c : text.substr(from, size)) value = value * 10 + (c - '0');
    return value;
  };
  const LocalTime time{field(0, 4),  field(5, 2),  field(8, 2),
                       field(11, 2), field(14, 2), field(17, 2)};
  if (!is_date_time(time)) return std::nullopt;
  return time;
}

void read_date_time(Table& file, Setup& setup) {
  file.read("date_time", "expected a date and time such as \"1993-12-17T12:51:52\"",
            [&](const toml::node& node) {
              if (const auto* value = node.as_date_time()) {  // without quotes
                const auto& date = value->get().date;
                const auto& time = value->get().time;
                setup.date_time = LocalTime{date.year,
                                            date.month,
                                            date.day,
                                            time.hour,
                                            time.minute,
                                            time.second,
                                            static_cast<int>(time.nanosecond / 1'000'000)};
                return true;
              }
              const auto text = node.value<std::string_view>();
              if (text) setup.date_time = parse_date_time(*text);
              return setup.date_time.has_value();
            });
}

void read_tool(Table& table, std::vector<ToolRecord>& tools) {
  ToolRecord tool;
  table.require("number");
  table.integer("number", 0, 99'999'999, tool.number);
  table.text("name", tool.name);
  table.axes({Axis::X, Axis::Z}, tool.length);
  if (table.has("length")) {
    if (table.has("Z")) table.complain("length", "a tool has either a length or X and Z");
    Length length;
    table.length("length", length);
    tool.length.set(Axis::Z, length);
  }
  table.length("radius", tool.radius);
  table.integer("tip", 0, 9, tool.tip);
  if (table.has("pocket")) table.integer("pocket", 0, 9999, tool.pocket.emplace());
  table.flag("special", tool.is_special);
  table.table("wear", {"X", "Z", "radius"}, [&](Table& wear) {
    wear.axes({Axis::X, Axis::Z}, tool.wear);
    wear.length("radius", tool.radius_wear);
  });
  const auto same = [&](const ToolRecord& other) { return other.number == tool.number; };
  if (std::any_of(tools.begin(), tools.end(), same)) {
    table.complain("number", fmt::format("tool {} is given twice", tool.number));
  }
  tools.push_back(tool);
}

/// The name under which a record is found again; it must be there and differ from the others'.
template <class Record>
void read_name(Table& table, const std::vector<Record>& others, std::string& name) {
  table.require("name");
  table.text("name", name);
  const auto same = [&](const Record& other) { return other.name == name; };
  if (std::any_of(others.begin(), others.end(), same)) {
    table.complain("name", fmt::format("{} is given twice", name));
  }
}

void read_offset(Table& table, std::vector<OffsetRecord>& offsets) {
  OffsetRecord offset;
  read_name(table, offsets, offset.name);
  table.axes(kEveryAxis, offset.value);
  offsets.push_back(std::move(offset));
}

void read_variable(Table& table, std::vector<VariableRecord>& variables) {
  VariableRecord variable;
  read_name(table, variables, variable.name);
  table.require("value");
  table.number("value", variable.value);
  variables.push_back(std::move(variable));
}

void read_plane(Table& table, Workpiece& workpiece) {
  ProbePlane plane;
  std::string axis;
  table.require("axis");
  table.require("at");
  table.text("axis", axis);
  table.length("at", plane.at);
  if (axis.size() != 1 || axis[0] < 'X' || axis[0] > 'Z') {
    return table.complain("axis", "expected \"X\", \"Y\" or \"Z\"");
  }
  plane.axis = *axis_of(axis[0]);
  workpiece.add(plane);
}

void read_cylinder(Table& parent, Workpiece& workpiece) {
  parent.table("cylinder", {"center", "radius"}, [&](Table& table) {
    Position center;
    ProbeCylinder cylinder;
    table.require("radius");
    table.length("radius", cylinder.radius);
    if (cylinder.radius <= Length{}) table.complain("radius", "expected a length above 0");
    table.table("center", {"X", "Y"}, [&](Table& axes) { axes.axes({Axis::X, Axis::Y}, center); });
    cylinder.center_x = center.linear(Axis::X);
    cylinder.center_y = center.linear(Axis::Y);
    workpiece.add(cylinder);
  });
}

void read_profile(Table& parent, Workpiece& workpiece) {
  constexpr std::string_view kExpected = "expected a list of at least two points [X, Z]";
  if (!parent.has("profile")) return;
  ProbeProfile profile;
  parent.each("profile", kExpected, [&](const toml::node& node) {
    const auto* pair = node.as_array();
    if (!pair || pair->size() != 2) return false;
    const auto x = finite_number(*pair->get(0));
    const auto z = finite_number(*pair->get(1));
    if (!x || !z) return false;
    profile.points.push_back({parent.reading().length(*x), parent.reading().length(*z)});
    return true;
  });
  if (profile.points.size() < 2) return parent.complain("profile", kExpected);
  workpiece.add(std::move(profile));
}

void read_probe(Table& probe, Workpiece& workpiece) {
  probe.tables("surface", {"axis", "at", "cylinder", "profile"}, [&](Table& surface) {
    const int kinds = surface.has("axis") + surface.has("cylinder") + surface.has("profile");
    if (kinds > 1)
      return surface.complain("axis", "one surface is a plane, a cylinder or a profile");
    read_cylinder(surface, workpiece);
    read_profile(surface, workpiece);
    if (!surface.has("cylinder") && !surface.has("profile")) read_plane(surface, workpiece);
  });
  read_cylinder(probe, workpiece);
  read_profile(probe, workpiece);
}

/// `rate` and the ends of the travel are lengths, or degrees.
void read_machine_axis(Table& table, Axis axis, MachineData::AxisData& data) {
  const auto read = [&](std::string_view key, std::optional<double>& out) {
    if (!table.has(key)) return;
    double value = 0;
    table.number(key, value);
    out = is_rotary(axis) ? value : table.reading().length(value).mm();
  };
  read("min", data.min);
  read("max", data.max);
  read("rate", data.max_rate);
  read("acceleration", data.acceleration);
  if (data.min.has_value() != data.max.has_value())
    return table.complain(data.min ? "min" : "max", "the travel has both ends, min and max");
  if (data.min && !(*data.min < *data.max)) return table.complain("min", "is not below max");
  if (data.max_rate && !(*data.max_rate > 0)) table.complain("rate", "expected a number above 0");
  if (data.acceleration && !(*data.acceleration >= MachineData::kMinAcceleration)) {
    const std::string_view unit = is_rotary(axis) ? "degrees" : "mm";
    table.complain("acceleration",
                   fmt::format("{} {}/s2 is below the least, {} {}/s2", *data.acceleration, unit,
                               MachineData::kMinAcceleration, unit));
  }
}

void read_machine(Table& table, MachineData& machine) {
  for (const Axis axis : kEveryAxis) {
    const char name = letter(axis);
    table.table(std::string_view(&name, 1), {"min", "max", "rate", "acceleration"},
                [&](Table& its) {
                  auto& data = machine.axes[static_cast<std::size_t>(axis)];
                  read_machine_axis(its, axis, data.emplace(MachineData::AxisData{}));
                });
  }
  if (table.has("max_rpm")) table.number("max_rpm", machine.max_rpm.emplace());
  if (machine.max_rpm && !(*machine.max_rpm > 0))
    table.complain("max_rpm", "expected a number above 0");
  if (table.has("homing")) table.flag("homing", machine.homing.emplace());
}

OptionValue read_option(Reading& reading, const std::string& key, const toml::node& node) {
  OptionValue option;
  option.line = node.source().begin.line;
  if (const auto* flag = node.as_boolean()) {
    option.value = flag->get();
  } else if (const auto* whole = node.as_integer()) {
    option.value = whole->get();
  } else if (const auto number = finite_number(node)) {
    option.value = *number;
  } else if (const auto* text = node.as_string()) {
    option.value = text->get();
  } else if (const auto* list = node.as_array()) {
    OptionList values;
    for (const toml::node& item : *list) values.push_back(read_option(reading, key, item));
    option.value = std::move(values);
  } else if (const auto* table = node.as_table()) {
    OptionTable entries;
    for (const auto& [name, item] : *table) {
      const std::string inner = key + "." + std::string(name.str());
      entries.push_back({std::string(name.str()), read_option(reading, inner, item)});
    }
    option.value = std::move(entries);
  } else {
    reading.complain(node.source(), key,
                     "expected a finite number, true or false, a text, a list or a table");
  }
  return option;
}

void read_control(Table& file, Setup& setup) {
  file.read("control", "expected a table", [&](const toml::node& node) {
    if (!node.is_table()) return false;
    OptionValue all = read_option(file.reading(), "control", node);
    setup.control = Options(std::get<OptionTable>(std::move(all.value)), file.reading().units);
    return true;
  });
}

void read_file(Table& file, Setup& setup, MachineData& machine) {
  read_units(file);
  if (file.has("units")) setup.units = file.reading().units;
  file.table("start", {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"},
             [&](Table& start) { start.axes(kEveryAxis, setup.start); });
  file.table("position", {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"},
             [&](Table& position) { position.axes(kEveryAxis, setup.position.emplace()); });
  file.table("switches", {"block_skip", "optional_stop", "mirror", "single_block", "dry_run"},
             [&](Table& switches) { read_switches(switches, setup.switches); });
  read_date_time(file, setup);
  file.texts("answers", setup.answers);
  file.tables("tool",
              {"number", "name", "length", "X", "Z", "radius", "tip", "wear", "pocket", "special"},
              [&](Table& tool) { read_tool(tool, setup.tools); });
  file.tables("offset", {"name", "X", "Y", "Z", "A", "B", "C", "U", "V", "W"},
              [&](Table& offset) { read_offset(offset, setup.offsets); });
  file.tables("variable", {"name", "value"},
              [&](Table& variable) { read_variable(variable, setup.variables); });
  file.table("probe", {"surface", "cylinder", "profile"},
             [&](Table& probe) { read_probe(probe, setup.workpiece); });
  file.table("machine", {"X", "Y", "Z", "A", "B", "C", "U", "V", "W", "max_rpm", "homing"},
             [&](Table& table) { read_machine(table, machine); });
  read_control(file, setup);
  file.table("library", {"path"}, [&](Table& library) {
    std::string path;
    library.text("path", path);
    if (!path.empty()) setup.library_path = std::move(path);
  });
}

struct File {
  Setup setup;
  MachineData machine;
};

/// `keys`: those the file may have at its top.
Result<File> parse(std::string_view text, Units units,
                   std::initializer_list<std::string_view> keys) {
  if (text.size() > kMaxSetupBytes) {
    return fail(Errc::LimitExceeded, "a setup file of {} bytes; at most {} are read", text.size(),
                kMaxSetupBytes);
  }
  toml::table parsed;
  try {  // Debian's library has only the parser that throws
    parsed = toml::parse(text);
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "line {}: {}", error.source().begin.line, error.description());
  }
  Reading reading{units, std::nullopt};
  File read;
  Table file(reading, parsed, "", keys);
  read_file(file, read.setup, read.machine);
  if (reading.error) return fail(*reading.error);
  return read;
}

}  // namespace

namespace {

Result<File> parse_file(std::string_view text, Units units) {
  return parse(text, units,
               {"start", "position", "units", "switches", "date_time", "answers", "tool", "offset",
                "variable", "probe", "machine", "control", "library"});
}

}  // namespace

Result<Setup> parse_setup(std::string_view text, Units units) {
  auto file = parse_file(text, units);
  if (!file) return fail(file.error());
  return std::move(file->setup);
}

Result<MachineData> parse_machine_data(std::string_view text, Units units) {
  const auto file = parse_file(text, units);
  if (!file) return fail(file.error());
  return file->machine;
}

Result<Setup> parse_control_data(std::string_view text, Units units) {
  auto file = parse(text, units, {"units", "tool", "offset", "variable", "control"});
  if (!file) return fail(file.error());
  return std::move(file->setup);
}

void use_control_data(Setup data, Setup& setup) {
  if (data.units) setup.units = data.units;
  if (!data.control.empty()) setup.control = std::move(data.control);
  setup.tools = std::move(data.tools);
  setup.offsets = std::move(data.offsets);
  setup.variables = std::move(data.variables);
}

}  // namespace dripline::interpreter
