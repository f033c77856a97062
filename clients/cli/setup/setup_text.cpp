#include "clients/cli/setup/setup_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/pull.hpp"
#include "clients/tools/program_editing/tnc155/whole_program.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

namespace dripline::cli {

namespace {

using interpreter::Axis;

/// Lengths as they were written: the file's units, no digits that say nothing.
class Lengths {
 public:
  explicit Lengths(interpreter::Units units) : is_inch_(units == interpreter::Units::Inch) {}
  const char* unit() const { return is_inch_ ? "in" : "mm"; }
  std::string text(Length length) const {
    return fmt::format("{:.{}f}", is_inch_ ? length.inch() : length.mm(), is_inch_ ? 4 : 3);
  }
  /// "-" for an axis that was not given.
  std::string text(const interpreter::Position& position, Axis axis) const {
    if (!position.has(axis)) return "-";
    return is_rotary(axis) ? fmt::format("{:.3f}", position.rotary(axis).degrees())
                           : text(position.linear(axis));
  }

 private:
  bool is_inch_;
};

std::string tool_table(const std::vector<interpreter::ToolRecord>& tools, const Lengths& lengths,
                       bool has_color) {
  const std::string unit = lengths.unit();
  std::vector<Column> columns{right("TOOL"),           right("X " + unit), right("Z " + unit),
                              right("RADIUS " + unit), right("WEAR X"),    right("WEAR Z"),
                              right("WEAR R"),         right("TIP"),       right("POCKET")};
  const bool has_names =
      std::ranges::any_of(tools, [](const auto& tool) { return !tool.name.empty(); });
  if (has_names) columns.push_back({"NAME"});
  Table table(std::move(columns));
  for (const auto& tool : tools) {
    const std::string pocket = tool.pocket ? std::to_string(*tool.pocket) : "-";
    std::vector<Cell> row{std::to_string(tool.number),
                          lengths.text(tool.length, Axis::X),
                          lengths.text(tool.length, Axis::Z),
                          lengths.text(tool.radius),
                          lengths.text(tool.wear, Axis::X),
                          lengths.text(tool.wear, Axis::Z),
                          lengths.text(tool.radius_wear),
                          std::to_string(tool.tip),
                          tool.is_special ? "S" + pocket : pocket};
    if (has_names) row.emplace_back(tool.name);
    table.add(std::move(row));
  }
  return table.render(has_color);
}

std::string offset_table(const std::vector<interpreter::OffsetRecord>& offsets,
                         const Lengths& lengths, bool has_color) {
  std::vector<Axis> used;
  for (const Axis axis : interpreter::kAllAxes) {
    const auto has_it = [axis](const auto& offset) { return offset.value.has(axis); };
    if (std::any_of(offsets.begin(), offsets.end(), has_it)) used.push_back(axis);
  }
  std::vector<Column> columns{{"OFFSET"}};
  for (const Axis axis : used) {
    const std::string unit = is_rotary(axis) ? "deg" : lengths.unit();
    columns.push_back({fmt::format("{} {}", letter(axis), unit), Align::Right});
  }
  Table table(std::move(columns));
  for (const auto& offset : offsets) {
    std::vector<Cell> row{offset.name};
    for (const Axis axis : used) row.emplace_back(lengths.text(offset.value, axis));
    table.add(std::move(row));
  }
  return table.render(has_color);
}

std::string variable_table(const std::vector<interpreter::VariableRecord>& variables,
                           bool has_color) {
  Table table({"VARIABLE", right("VALUE")});
  for (const auto& variable : variables) {
    table.add({variable.name, fmt::format("{:g}", variable.value)});
  }
  return table.render(has_color);
}

/// A Centurion's axis and power parameters by their pages; other controls have none.
std::string machine_table(const interpreter::Options& control, bool has_color) {
  interpreter::centurion::Parameters values;
  if (!interpreter::centurion::load_machine_parameters(control, values)) return {};
  Table table({"PAGE", "PARAMETER", right("VALUE"), right("X"), right("Z"), "MEANING"});
  for (const auto& row : interpreter::centurion::machine_parameters()) {
    const std::string first = fmt::format("{:g}", values[row.number]);
    const std::string x = row.is_per_axis ? fmt::format("{:g}", values[row.number + 1]) : "";
    if (first == "0" && (x == "0" || x.empty())) continue;
    table.add({std::string(row.page), std::string(row.name), row.is_per_axis ? "" : first, x,
               row.is_per_axis ? first : "", std::string(row.title)});
  }
  return table.empty() ? std::string() : table.render(has_color);
}

namespace tnc155 = interpreter::tnc155;
using client::Failure;

constexpr std::string_view kControl = "tnc155";
/// 999 blocks are much less: what is longer is not read to be counted.
constexpr std::uint64_t kLongestProgram = 1024 * 1024;

client::Reply<std::string> text_of(client::Client& client, const std::string& name) {
  const auto program = client.program(name);
  if (!program) return client::failed(program.error());
  if (program->program.size > kLongestProgram) {
    return client::failed(Failure::Kind::Local, Errc::LimitExceeded,
                          "{} has {} bytes: the control keeps 999 blocks of a program", name,
                          program->program.size);
  }
  std::string text;
  const client::PullOptions options{name, program->program.revision, retry_policy(), {}};
  const auto pulled = client::pull_program(client, options, [&text](std::string_view bytes) {
    text += bytes;
    return Result<void>{};
  });
  if (!pulled) return client::failed(pulled.error());
  return text;
}

client::Reply<std::size_t> vacant_blocks(client::Client& client, std::size_t memory_blocks,
                                         const std::vector<std::string>& programs) {
  tnc155::MemoryLimits limits;
  limits.blocks = memory_blocks;
  tnc155::ProgramMemory memory(limits);
  for (const std::string& name : programs) {
    const auto text = text_of(client, name);
    if (!text) return client::failed(text.error());
    const auto program = program_editing::describe_program(*text);
    const auto stored = program ? memory.store(*program) : Result<void>(fail(program.error()));
    if (!stored) {
      return client::failed(Failure::Kind::Refused, stored.error().code, "{}: {}", name,
                            stored.error().what);
    }
  }
  return memory.vacant_blocks();
}

}  // namespace

Result<std::string> setup_tables(const client::Setup& setup, bool has_color) {
  const auto data = interpreter::parse_control_data(setup.text);
  if (!data) return fail(data.error());
  const Lengths lengths(data->units.value_or(interpreter::Units::Millimeter));
  std::string text =
      fmt::format("Setup {} of {}, saved {}{}{}\n", setup.revision, setup.machine,
                  time_text(setup.created), setup.comment.empty() ? "" : ": ", setup.comment);
  const auto add = [&text](const std::string& table) { text += "\n" + table; };
  if (!data->tools.empty()) add(tool_table(data->tools, lengths, has_color));
  if (!data->offsets.empty()) add(offset_table(data->offsets, lengths, has_color));
  if (!data->variables.empty()) add(variable_table(data->variables, has_color));
  if (const auto machine = machine_table(data->control, has_color); !machine.empty()) add(machine);
  if (!data->control.empty()) text += "\nIt also sets options of the control: dnc setup pull\n";
  return text;
}

client::Reply<std::optional<SetupMenu>> menu_of(client::Client& client, const client::Setup& setup,
                                                const SetupMenuRequest& request) {
  std::string control = request.control;
  if (control.empty()) {
    const auto machine = client.machine(setup.machine);
    if (machine) control = machine->control;
  }
  const auto data = interpreter::parse_control_data(setup.text);
  if (!data) return client::failed_locally(data.error());
  // A machine never seen is recognized by options that only this control has.
  const bool is_tnc = control == kControl || (control.empty() && !data->control.empty() &&
                                              tnc155::read_options(*data).has_value());
  if (!is_tnc) {
    if (request.holds.empty()) return std::optional<SetupMenu>{};
    return client::failed(
        Failure::Kind::Local, Errc::Unsupported, "--holds is for a TNC; machine {} is {}",
        setup.machine, control.empty() ? "not known to be one; name it with --control" : control);
  }
  const auto settings = tnc155::read_mod_settings(data->control);
  if (!settings) return client::failed_locally(settings.error());
  const auto vacant = vacant_blocks(client, settings->memory_blocks, request.holds);
  if (!vacant) return client::failed(vacant.error());
  return std::optional(
      SetupMenu{tnc155::mod_functions(*settings, *vacant), settings->user_parameters});
}

std::string menu_tables(const SetupMenu& menu, bool has_color) {
  Table functions({"MOD FUNCTION", "VALUE", "ALLOWED"});
  for (const auto& function : menu.functions) {
    functions.add({function.name, function.value, function.range});
  }
  std::string text = functions.render(has_color);
  if (menu.parameters.empty()) return text;
  Table parameters({right("NO"), "USER PARAMETER", "MP", right("VALUE"), "ALLOWED"});
  std::size_t number = 0;
  for (const auto& parameter : menu.parameters) {
    parameters.add({std::to_string(++number), parameter.text,
                    fmt::format("MP{}", parameter.parameter),
                    fmt::format("{:.12g}", parameter.value), tnc155::range_text(parameter)});
  }
  return text + "\n" + parameters.render(has_color);
}

void add_menu(const SetupMenu& menu, nlohmann::ordered_json& json) {
  auto functions = nlohmann::ordered_json::array();
  for (const auto& [name, value, range] : menu.functions) {
    functions.push_back({{"name", name}, {"value", value}, {"range", range}});
  }
  auto parameters = nlohmann::ordered_json::array();
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  for (const auto& parameter : menu.parameters) {
    parameters.push_back({{"number", parameters.size() + 1},
                          {"text", parameter.text},
                          {"machine_parameter", parameter.parameter},
                          {"value", parameter.value},
                          {"min", number(parameter.min)},
                          {"max", number(parameter.max)}});
  }
  json["mod_functions"] = std::move(functions);
  json["user_parameters"] = std::move(parameters);
}

}  // namespace dripline::cli
