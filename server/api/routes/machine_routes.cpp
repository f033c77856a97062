#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "gateway/interpreter/registry.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/utf8.hpp"
#include "server/api/api.hpp"
#include "server/api/audited.hpp"
#include "server/api/bodies/run_bodies.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

json memory_json(const library::KeptMemory& memory) {
  auto cells = json::array();
  for (const auto& [name, cell] : memory.cells) {
    cells.push_back({{"name", name},
                     {"value", number_or_null(cell.value)},
                     {"setup", number_or_null(cell.base)}});
  }
  const auto& change = memory.change;
  return {{"machine", memory.machine},
          {"change", change ? json({{"what", change->what}, {"who", change->by}}) : json(nullptr)},
          {"run", memory.run},
          {"program", memory.program ? json(*memory.program) : json(nullptr)},
          {"time", to_iso8601(memory.time)},
          {"cells", std::move(cells)}};
}

/// Reads the stored records, so that the gateway need not be connected.
Response list_memories(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const auto run = query.text("run");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const std::string machine = request.parameter("name");
  if (const auto known = services.machines.machine(machine); !known)
    return error_response(known.error());
  return list_response("memories", services.runs.memories(machine, run, page), memory_json);
}

}  // namespace

void add_memory_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machines/{name}/memory", with(services, list_memories));
}

namespace {

Response list_setups(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("setups", services.setups.list(request.parameter("name"), page), setup_json);
}

Response show_setup(Services& services, const Request& request) {
  QueryReader query(request);
  const auto number = query.number("revision", kMaxNumber);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto setup = services.setups.find(request.parameter("name"), number);
  if (!setup) return error_response(setup.error());
  auto view = setup_json(*setup);
  view["text"] = setup->text;
  return json_response(200, view);
}

/// The control that reads the text: the machine's, unless the server does not know the machine.
Result<std::string> control_of(Services& services, const std::string& machine,
                               const std::optional<std::string>& given) {
  const auto view = services.machines.machine(machine);
  const std::string known = view ? view->machine.control : "";
  if (known.empty() && given) return *given;
  if (known.empty()) {
    return fail(Errc::NotFound,
                "machine {} has not been seen yet: say which control it has (control=...)",
                machine);
  }
  if (given && *given != known) {
    return fail(Errc::Conflict, "machine {} is a {}, not a {}", machine, known, *given);
  }
  return known;
}

Response save_setup(Services& services, const Request& request) {
  QueryReader query(request);
  const auto control = query.text("control");
  library::SetupText text;
  text.comment = query.text("comment").value_or("");
  text.base = query.number("base", kMaxNumber);
  if (auto good = query.finish(); !good) return error_response(good.error());
  text.machine = request.parameter("name");
  if (auto named = check_machine_name(text.machine); !named) return error_response(named.error());
  const auto resolved = control_of(services, text.machine, control);
  if (!resolved) return error_response(resolved.error());
  text.control = *resolved;
  text.text = request.body;
  const auto saved = services.setups.save(text, request.who);
  if (!saved) return error_response(saved.error());
  auto view = setup_json(saved->setup);
  view["unchanged"] = saved->is_unchanged;
  return json_response(saved->is_unchanged ? 200 : 201, view);
}

Response show_loaded(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const std::string machine = request.parameter("name");
  const auto loaded = services.setups.loaded(machine);
  if (!loaded) return error_response(loaded.error());
  if (*loaded) return json_response(200, loaded_setup_json(**loaded));
  return error_response(
      {Errc::NotFound,
       fmt::format("it was never stated which setup is in the control of machine {}", machine)});
}

Response note_loaded(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto number = decode_loaded_setup(request.body);
  if (!number) return error_response(number.error());
  const std::string name = request.parameter("name");
  const auto view = services.machines.machine(name);
  if (!view) return error_response(view.error());
  if (!view->has_serial_line()) {
    return error_response(
        {Errc::Conflict, fmt::format("machine {}: its gateway gets the newest setup with each "
                                     "start; only what is in a control at the end of a line has "
                                     "to be said",
                                     name)});
  }
  return value_response(200, services.setups.note_loaded(name, *number, request.who),
                        loaded_setup_json);
}

}  // namespace

void add_setup_routes(Router& router, Services& services) {
  const std::string machine = "/api/v1/machines/{name}";
  router.add("GET", machine + "/setups", with(services, list_setups));
  router.add("GET", machine + "/setup", with(services, show_setup));
  router.add("PUT", machine + "/setup", with(services, save_setup));
  router.add("GET", machine + "/setup/loaded", with(services, show_loaded));
  router.add("PUT", machine + "/setup/loaded", with(services, note_loaded));
}

namespace {

/// What the gateway answers is checked: programs read it.
Result<nlohmann::json> values_json(const std::string& machine, const std::string& answer) {
  auto values = nlohmann::json::parse(answer, nullptr, false);
  const auto has = [&values](const char* name, bool (nlohmann::json::*is_type)() const noexcept) {
    return values.contains(name) && (values[name].*is_type)();
  };
  const bool is_good = values.is_object() && has("values", &nlohmann::json::is_array) &&
                       has("outputs", &nlohmann::json::is_array) &&
                       has("codes", &nlohmann::json::is_array) && values.contains("next");
  if (!is_good)
    return fail(Errc::Corrupt, "machine {}: its gateway's answer has no values", machine);
  for (const char* later : {"inputs", "analog", "functions"})  // older gateways have none
    if (!has(later, &nlohmann::json::is_array)) values[later] = nlohmann::json::array();
  values["machine"] = machine;
  return values;
}

Response show_values(Services& services, const Request& request) {
  QueryReader query(request);
  constexpr std::uint64_t kMaxPassedOver = 1'000'000;
  machines::ValueQuery asked{.machine = request.parameter("name"),
                             .beginning = query.text("beginning").value_or(""),
                             .passed_over = query.number("offset", kMaxPassedOver).value_or(0)};
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto answer = services.machines.values(asked);
  if (!answer) return error_response(answer.error());
  const auto values = values_json(asked.machine, *answer);
  return values ? json_response(200, *values) : error_response(values.error());
}

/// Why nothing can be keyed in there; what the gateway checks is left to it.
Result<void> check_mdi(const machines::MachineView& view, const std::string& text) {
  const std::string& name = view.machine.name;
  if (view.has_serial_line()) {
    return fail(Errc::Unsupported, "machine '{}' is at the end of a line: MDI is its control's own",
                name);
  }
  const auto dialect = interpreter::find_dialect(view.machine.control);
  const std::size_t most = dialect ? (*dialect)->mdi_blocks : 0;
  if (most == 0) {
    return fail(Errc::Unsupported, "machine '{}': control {} has no MDI", name,
                view.machine.control);
  }
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  if (lines > most) {
    return fail(Errc::LimitExceeded, "{} blocks: MDI of control {} takes {}", lines,
                view.machine.control, most);
  }
  return {};
}

/// What is refused is not kept. The status may be older than the end of a run.
Result<void> check_idle(Services& services, const std::string& machine) {
  for (const auto state : {storage::RunState::Ordered, storage::RunState::Active}) {
    storage::RunFilter filter;
    filter.machine = machine;
    filter.state = state;
    const auto runs = services.runs.runs(filter, {1, 0});
    if (!runs) return fail(runs.error());
    if (runs->empty()) continue;
    return fail(Errc::Busy, "machine '{}' is busy with run {} of program {}", machine,
                runs->front().id, runs->front().program);
  }
  return {};
}

/// What was keyed in stays, as a revision of a program of the machine.
Result<storage::Revision> store_mdi(Services& services, const machines::MachineView& view,
                                    const std::string& text, const storage::Actor& who) {
  library::UploadRequest upload;
  upload.program = "MDI " + view.machine.name;
  upload.control = view.machine.control;
  upload.comment = "keyed in";
  const auto begun = services.programs.begin(upload, who);
  if (!begun) return fail(begun.error());
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  if (auto done = services.programs.append(begun->id, 0, bytes); !done) return fail(done.error());
  const auto committed = services.programs.commit(begun->id, std::nullopt, who);
  if (!committed) return fail(committed.error());
  return committed->revision;
}

Response key_in(Services& services, const Request& request) {
  const auto text = decode_mdi(request.body);
  if (!text) return error_response(text.error());
  const auto view = services.machines.machine(request.parameter("name"));
  if (!view) return error_response(view.error());
  if (auto good = check_mdi(*view, *text); !good) return error_response(good.error());
  if (auto idle = check_idle(services, view->machine.name); !idle)
    return error_response(idle.error());
  const auto revision = store_mdi(services, *view, *text, request.who);
  if (!revision) return error_response(revision.error());
  machines::StartRequest start;
  start.given = request.given;
  start.machine = view->machine.name;
  start.program = revision->program;
  start.revision = revision->number;
  start.author = request.who.name;
  start.role = request.caller->role;
  start.is_mdi = true;
  start.before = [&audit = services.audit, who = request.who, &text](const storage::Run& run) {
    return audit.write_before({.who = who,
                               .action = "run.mdi",
                               .subject = run.id,
                               .detail = fmt::format("{}: {}", run.machine, one_line(*text))});
  };
  std::string notice;
  start.on_notice = [&notice](const std::string& given) { notice = given; };
  const auto run = services.machines.start(start);
  if (!run) return error_response(run.error());
  return json_response(201, begun_json(*run, notice));
}

/// What was set, as the gateway gives it; an older one gives its text alone.
json position_json(const std::string& machine, const std::string& what,
                   const machines::PositionAnswer& answer) {
  const json given = json::parse(answer.details, nullptr, false);
  const auto number = [&](const char* name) {
    const bool has = given.is_object() && given.contains(name) && given[name].is_number();
    return has ? given[name] : json(nullptr);
  };
  json cells = json::array();
  if (given.is_object() && given.contains("cells") && given["cells"].is_array()) {
    for (const json& cell : given["cells"]) {
      const bool is_good = cell.is_object() && cell.contains("name") && cell["name"].is_string() &&
                           cell.contains("value") && cell["value"].is_number() &&
                           cell.contains("unit") && cell["unit"].is_string();
      if (!is_good) continue;
      const bool has_before = cell.contains("before") && cell["before"].is_number();
      cells.push_back({{"name", cell["name"]},
                       {"before", has_before ? cell["before"] : json(nullptr)},
                       {"value", cell["value"]},
                       {"unit", cell["unit"]}});
    }
  }
  return {{"machine", machine},    {"change", answer.change}, {"text", answer.text},
          {"what", what},          {"cells", cells},          {"length", number("length")},
          {"zero", number("zero")}};
}

/// The audit trail has it before it goes out.
Response set_position(Services& services, const Request& request, bool is_tool) {
  const auto setting = decode_position_setting(request.body, is_tool);
  if (!setting) return error_response(setting.error());
  const std::string name = request.parameter("name");
  if (const auto view = services.machines.machine(name); !view) return error_response(view.error());
  if (auto idle = check_idle(services, name); !idle) return error_response(idle.error());
  machines::PositionRequest asked{.machine = name,
                                  .argument = interpreter::to_text(*setting),
                                  .who = request.who.name,
                                  .is_playback = false,
                                  .given = request.given};
  const auto answer = ask_audited(services.audit,
                                  {.who = request.who,
                                   .action = is_tool ? "machine.touch_off" : "machine.datum",
                                   .subject = name,
                                   .detail = asked.argument},
                                  [&] { return services.machines.position(asked); });
  if (!answer) return error_response(answer.error());
  return json_response(200, position_json(name, asked.argument, *answer));
}

Response set_datum(Services& services, const Request& request) {
  return set_position(services, request, false);
}
Response touch_off(Services& services, const Request& request) {
  return set_position(services, request, true);
}

Response play_back(Services& services, const Request& request) {
  QueryReader query(request);
  machines::PositionRequest asked{.machine = request.parameter("name"),
                                  .argument = query.text("axes").value_or(""),
                                  .who = {},
                                  .is_playback = true};
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (asked.argument.empty() || asked.argument.size() > interpreter::kAxisCount ||
      asked.argument.find_first_not_of("XYZABCUVW") != std::string::npos) {
    return error_response(
        {Errc::Syntax, fmt::format("axes '{}': expected letters, as XYZ", asked.argument)});
  }
  const auto answer = services.machines.position(asked);
  if (!answer) return error_response(answer.error());
  return json_response(200, {{"machine", asked.machine}, {"block", answer->text}});
}

Response command_machine(Services& services, const Request& request) {
  auto command = decode_machine_command(request.body);
  if (!command) return error_response(command.error());
  command->machine = request.parameter("name");
  return carry_out(services, request, *command);
}

}  // namespace

void add_machine_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machines/{name}/values", with(services, show_values),
             Waits::ForMachine);
  router.add("POST", "/api/v1/machines/{name}/commands", with(services, command_machine),
             Waits::ForMachine);
  router.add("POST", "/api/v1/machines/{name}/mdi", with(services, key_in), Waits::ForMachine);
  router.add("POST", "/api/v1/machines/{name}/datum", with(services, set_datum), Waits::ForMachine);
  router.add("POST", "/api/v1/machines/{name}/touch-off", with(services, touch_off),
             Waits::ForMachine);
  router.add("GET", "/api/v1/machines/{name}/playback", with(services, play_back),
             Waits::ForMachine);
}

}  // namespace dripline::api
