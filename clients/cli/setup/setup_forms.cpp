#include "clients/cli/setup/setup_forms.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "gateway/interpreter/dialects/centurion/memory/parameter_text.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/offset_text.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/table_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

namespace dripline::cli {

using interpreter::tnc155::ControlVersion;
using interpreter::tnc155::Feature;

namespace {

/// Tools as the TOML of a setup, in millimeters.
std::string tools_toml(const std::vector<interpreter::ToolRecord>& tools) {
  std::string text = "units = \"mm\"\n";
  for (const auto& tool : tools) {
    text +=
        fmt::format("\n[[tool]]\nnumber = {}\nlength = {:.12g}\nradius = {:.12g}\n", tool.number,
                    tool.length.linear(interpreter::Axis::Z).mm(), tool.radius.mm());
    if (tool.pocket) text += fmt::format("pocket = {}\n", *tool.pocket);
    if (tool.is_special) text += "special = true\n";
  }
  return text;
}

std::string parameters_toml(const interpreter::tnc155::MachineParameters& parameters) {
  std::string text = "[control.machine_parameters]\n";
  for (const auto& [number, value] : parameters) {
    text += fmt::format("MP{} = {:.12g}\n", number, value);
  }
  return text;
}

/// Text that a TNC sends of its memory: program 0, or its machine parameters (MP0: ...).
Result<std::string> setup_of_memory_file(std::string_view text, const ControlVersion& tnc) {
  const std::size_t begin = std::min(text.find_first_not_of(" \r\n\t\2"), text.size());
  if (text.substr(begin).starts_with("MP")) {
    const auto parameters = interpreter::tnc155::read_machine_parameters(text, tnc);
    if (!parameters) return fail(parameters.error());
    return parameters_toml(*parameters);
  }
  const auto tools = interpreter::tnc155::read_tool_store(text, tnc);
  if (!tools) return fail(tools.error());
  return tools_toml(*tools);
}

Result<void> check_tool_store(std::string_view toml) {
  const auto data = interpreter::parse_control_data(toml);
  if (!data) return fail(data.error());
  const auto version = interpreter::tnc155::version_of(data->control);
  if (!version) return fail(version.error());
  if (version->has(Feature::ToolStore)) return {};
  return fail(Errc::Unsupported, "{}", version->lacks(Feature::ToolStore));
}

}  // namespace

Result<std::string> machine_parameters_text(std::string_view toml, std::string_view control) {
  const auto data = interpreter::parse_control_data(toml);
  if (!data) return fail(data.error());
  if (control == "rs274ngc") return interpreter::rs274ngc::write_parameter_file(*data);
  const auto parameters = interpreter::tnc155::all_machine_parameters(data->control);
  if (!parameters) return fail(parameters.error());
  if (parameters->empty()) {
    return fail(Errc::NotFound,
                "the setup has no [control.machine_parameters] and no user parameters");
  }
  return interpreter::tnc155::write_machine_parameters(*parameters);
}

Result<std::string> tool_store_of(std::string_view toml) {
  const auto data = interpreter::parse_control_data(toml);
  if (!data) return fail(data.error());
  const auto sign = interpreter::tnc155::decimal_sign_of(data->control);
  if (!sign) return fail(sign.error());
  for (const auto& tool : data->tools) {
    const bool has_wear = tool.wear != interpreter::Position{} || tool.radius_wear != Length{};
    if (!has_wear) continue;
    return fail(
        Errc::Unsupported,
        "tool {} has a wear, and a TNC's tool store has none: put it into length and radius",
        tool.number);
  }
  return interpreter::tnc155::write_tool_store(
      data->tools, data->units.value_or(interpreter::Units::Millimeter), *sign);
}

Result<std::string> control_form_of(std::string_view toml, std::string_view control,
                                    std::string_view map) {
  if (control == "tnc155") {
    if (auto has = check_tool_store(toml); !has) return fail(has.error());
  }
  if (control == "tnc155") return tool_store_of(toml);
  if (control == "fanuc" || control == "fanuc-t") {
    const auto data = interpreter::parse_control_data(toml);
    if (!data) return fail(data.error());
    return interpreter::fanuc::write_offset_text(*data, control == "fanuc-t");
  }
  if (control == "rs274ngc") {
    const auto data = interpreter::parse_control_data(toml);
    if (!data) return fail(data.error());
    return interpreter::rs274ngc::write_tool_table(*data);
  }
  if (control != "centurion") {
    return fail(Errc::Unsupported,
                "there is no form of a setup that control {} takes; tnc155, centurion, fanuc, "
                "fanuc-t and rs274ngc have one",
                control);
  }
  const auto data = interpreter::parse_control_data(toml, interpreter::Units::Inch);
  if (!data) return fail(data.error());
  if (map.empty()) return interpreter::centurion::write_parameter_text(*data);
  const auto rows = interpreter::centurion::read_parameter_map(map);
  if (!rows) return fail(rows.error().code, "map: {}", rows.error().what);
  return interpreter::centurion::write_parameter_text(*data, &*rows);
}

bool is_table_file(std::string_view text) {
  return interpreter::rs274ngc::is_tool_table(text) ||
         interpreter::rs274ngc::is_parameter_file(text);
}

Result<std::string> setup_of_table_files(const std::vector<std::string>& texts,
                                         interpreter::Units units) {
  std::string_view tools, parameters;
  for (const std::string& text : texts) {
    const bool is_tools = !interpreter::rs274ngc::is_parameter_file(text);
    auto& place = is_tools ? tools : parameters;
    if (!place.empty()) {
      return fail(Errc::Syntax, "both files are {}", is_tools ? "tool tables" : "parameter files");
    }
    place = text;
  }
  return interpreter::rs274ngc::setup_of_table_files(tools, parameters, units);
}

Result<std::string> setup_of_control_form(std::string_view text, const ControlVersion& tnc,
                                          std::string_view map) {
  if (text.find("G10") != std::string_view::npos) {
    if (map.empty()) return interpreter::centurion::setup_of_parameter_text(text);
    const auto rows = interpreter::centurion::read_parameter_map(map);
    if (!rows) return fail(rows.error().code, "map: {}", rows.error().what);
    return interpreter::centurion::setup_of_parameter_text(text, &*rows);
  }
  return setup_of_memory_file(text, tnc);
}

}  // namespace dripline::cli
