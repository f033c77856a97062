#include "clients/cli/setup/setup_text.hpp"

#include <fmt/format.h>

#include "clients/cli/text/table.hpp"
#include "clients/cli/text/value_text.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"

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
  Table table({{"TOOL", Align::Right},
               {"X " + unit, Align::Right},
               {"Z " + unit, Align::Right},
               {"RADIUS " + unit, Align::Right},
               {"WEAR X", Align::Right},
               {"WEAR Z", Align::Right},
               {"WEAR R", Align::Right},
               {"TIP", Align::Right},
               {"POCKET", Align::Right}});
  for (const auto& tool : tools) {
    const std::string pocket = tool.pocket ? std::to_string(*tool.pocket) : "-";
    table.add({std::to_string(tool.number), lengths.text(tool.length, Axis::X),
               lengths.text(tool.length, Axis::Z), lengths.text(tool.radius),
               lengths.text(tool.wear, Axis::X), lengths.text(tool.wear, Axis::Z),
               lengths.text(tool.radius_wear), std::to_string(tool.tip),
               tool.is_special ? "S" + pocket : pocket});
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
  Table table({{"VARIABLE"}, {"VALUE", Align::Right}});
  for (const auto& variable : variables) {
    table.add({variable.name, fmt::format("{:g}", variable.value)});
  }
  return table.render(has_color);
}

/// A Centurion's axis and power parameters by their pages; other controls have none.
std::string machine_table(const interpreter::Options& control, bool has_color) {
  interpreter::centurion::Parameters values;
  if (!interpreter::centurion::load_machine_parameters(control, values)) return {};
  Table table({{"PAGE"},
               {"PARAMETER"},
               {"VALUE", Align::Right},
               {"X", Align::Right},
               {"Z", Align::Right},
               {"MEANING"}});
  for (const auto& row : interpreter::centurion::machine_parameters()) {
    const std::string first = fmt::format("{:g}", values[row.number]);
    const std::string x = row.is_per_axis ? fmt::format("{:g}", values[row.number + 1]) : "";
    if (first == "0" && (x == "0" || x.empty())) continue;
    table.add({std::string(row.page), std::string(row.name), row.is_per_axis ? "" : first, x,
               row.is_per_axis ? first : "", std::string(row.title)});
  }
  return table.empty() ? std::string() : table.render(has_color);
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

}  // namespace dripline::cli
