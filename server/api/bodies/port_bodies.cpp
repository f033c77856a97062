#include "server/api/bodies/port_bodies.hpp"

#include <algorithm>

#include "protocol/base/names.hpp"
#include "server/api/bodies/json_object.hpp"
#include "server/api/bodies/program_bodies.hpp"

namespace dripline::api {
namespace {

Result<void> check_size(const storage::Port& port) {
  if (port.settings.size() > storage::kMaxPortSettings) {
    return fail(Errc::LimitExceeded, "member 'settings' has {} members: at most {}",
                port.settings.size(), storage::kMaxPortSettings);
  }
  if (port.address.empty()) return fail(Errc::Syntax, "member 'address' is empty");
  return {};
}

Result<ports::ProgramChoice> parse_choice(const std::string& text) {
  const auto named = parse_named_program(text);
  if (!named) return fail(named.error());
  return ports::ProgramChoice{.program = named->program, .revision = named->revision};
}

}  // namespace

Result<storage::Port> decode_port(const std::string& name, std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  storage::Port port;
  port.name = name;
  port.machine = object->required_text("machine", kMaxName);
  port.address = object->required_text("address", kMaxAddress);
  port.line_template = object->optional_text("template", kMaxName).value_or("");
  port.settings = object->optional_scalars("settings", kMaxSettingValue);
  port.rules = object->optional_text("rules", storage::kMaxPortRules).value_or("");
  port.is_enabled = object->optional_flag("enabled").value_or(true);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = check_port_name(port.name); !good) return fail(good.error());
  if (auto good = check_machine_name(port.machine); !good) return fail(good.error());
  if (auto good = check_size(port); !good) return fail(good.error());
  std::stable_partition(port.settings.begin(), port.settings.end(),
                        [](const auto& setting) { return setting.first == "line"; });
  return port;
}

Result<std::vector<ports::ProgramChoice>> decode_transfer(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const auto texts = object->optional_texts("programs", kMaxName, ports::kMaxTransferPrograms);
  if (auto good = object->finish(); !good) return fail(good.error());
  std::vector<ports::ProgramChoice> choices;
  for (const auto& text : texts) {
    auto choice = parse_choice(text);
    if (!choice) return fail(choice.error());
    choices.push_back(*std::move(choice));
  }
  return choices;
}

Result<std::string> decode_rules_text(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  auto text = object->required_text("text", kMaxRulesText);
  if (auto good = object->finish(); !good) return fail(good.error());
  return text;
}

}  // namespace dripline::api
