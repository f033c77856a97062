#include "clients/cli/port/port_line.hpp"

#include <nlohmann/json.hpp>

#include "clients/cli/text/json_text.hpp"

namespace dripline::cli {

Result<wire::LineSettings> line_named(const std::string& name,
                                      const std::vector<std::string>& changes) {
  wire::LineSettings line;
  if (const auto found = wire::find_template(name)) {
    line = (*found)->settings;
  } else if (auto done = wire::apply_short_form(name, line); !done) {
    return fail(Errc::NotFound, "{}: neither a template nor a short form such as 9600e72", name);
  }
  for (const auto& change : changes) {
    const auto sign = change.find('=');
    auto done = sign == std::string::npos
                    ? wire::apply_short_form(change, line)
                    : wire::set_value(line, change.substr(0, sign), change.substr(sign + 1));
    if (!done) return fail(done.error());
  }
  return line;
}

int show_line(Context& context, std::string_view template_name, const wire::LineSettings& line) {
  const auto usual = wire::find_template(template_name);
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  std::string text = fmt::format("--template {}", template_name);
  for (const auto& row : wire::setting_rows()) {
    const std::string value = row.get(line);
    if (row.key == "line" || (usual && value == row.get((*usual)->settings))) continue;
    settings[std::string(row.key)] = value;
    text += fmt::format(" {}={}", row.key, value);
  }
  if (context.wants_json) {
    context.print(
        json_text(nlohmann::ordered_json{{"template", template_name}, {"settings", settings}}));
  } else {
    context.print(text + "\n");
  }
  return kExitOk;
}

}  // namespace dripline::cli
