#include "clients/cli/setup/setup_menu.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/lib/pull.hpp"
#include "clients/tools/program_editing/tnc155/whole_program.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

namespace dripline::cli {
namespace {

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
  Table functions({{"MOD FUNCTION"}, {"VALUE"}, {"ALLOWED"}});
  for (const auto& function : menu.functions) {
    functions.add({function.name, function.value, function.range});
  }
  std::string text = functions.render(has_color);
  if (menu.parameters.empty()) return text;
  Table parameters(
      {{"NO", Align::Right}, {"USER PARAMETER"}, {"MP"}, {"VALUE", Align::Right}, {"ALLOWED"}});
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
