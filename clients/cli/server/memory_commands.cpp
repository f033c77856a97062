#include <fmt/format.h>
#include <algorithm>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/server/kept_memory.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/setup/setup_changes.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

/// Reports of a machine that are looked at.
constexpr std::uint64_t kMaxRuns = 200;

struct MemoryCommand {
  std::string machine, run = {}, filter = {}, comment = {};
};

struct Found {
  client::Memory reported;
  KeptMemory memory;
};

Found found_in(client::Memory reported) {
  KeptMemory cells = cells_of(reported);
  return {std::move(reported), std::move(cells)};
}

/// The newest memories that the machine reported, at most `limit`.
client::Reply<std::vector<Found>> memories(client::Client& client, const std::string& machine,
                                           std::uint64_t limit) {
  auto reported =
      fetch_all(limit, [&](client::Page page) { return client.memories(machine, "", page); });
  if (!reported) return client::failed(reported.error());
  std::vector<Found> found;
  for (auto& memory : *reported) found.push_back(found_in(std::move(memory)));
  return found;
}

/// Runs that were begun at the machine are not among the server's: they are known by what they
/// reported.
client::Reply<Found> of_own_run(client::Client& client, const MemoryCommand& command) {
  auto all = memories(client, command.machine, kMaxRuns);
  if (!all) return client::failed(all.error());
  Found* found = nullptr;
  for (auto& memory : *all) {
    if (!memory.reported.run.starts_with(command.run)) continue;
    if (found != nullptr)
      return client::failed(client::Failure::Kind::Refused, Errc::Conflict,
                            "run '{}' fits {} and {}; expected more of the id", command.run,
                            found->reported.run, memory.reported.run);
    found = &memory;
  }
  if (found != nullptr) return std::move(*found);
  return client::failed(client::Failure::Kind::Refused, Errc::NotFound,
                        "no run's id begins with '{}'; expected one of dnc memory list {}, of dnc "
                        "run list, or latest",
                        command.run, command.machine);
}

/// Of the run that the command names, or the machine's newest.
client::Reply<Found> wanted(client::Client& client, const MemoryCommand& command) {
  if (!command.run.empty()) {
    auto run = find_run(client, command.run);
    if (!run && run.error().code == Errc::NotFound) return of_own_run(client, command);
    if (!run) return client::failed(run.error());
    auto reported = client.memories(run->machine, run->id, {1, 0});
    if (!reported) return client::failed(reported.error());
    return found_in(std::move(reported->front()));
  }
  constexpr std::uint64_t kEnough = 10;  // one that has not arrived yet is left out
  auto found = memories(client, command.machine, kEnough);
  if (!found) return client::failed(found.error());
  if (!found->empty()) return std::move(found->front());
  const auto machine = client.machine(command.machine);
  if (!machine) return client::failed(machine.error());
  return client::failed(
      client::Failure::Kind::Refused, Errc::NotFound,
      "no run of {} has left anything in its control's memory{}", command.machine,
      machine->connected ? "" : ", as far as is known: its gateway is not connected");
}

/// What the shown memory does not know of yet, or empty.
std::string what_may_follow(client::Client& client, const std::string& machine) {
  const auto now = client.machine(machine);
  if (!now) return {};
  if (!now->connected) {
    return fmt::format(
        "The gateway of {} is not connected, last seen {}: what it has kept since is not known\n",
        machine, time_text(now->last_seen));
  }
  if (!now->status || now->status->run.empty()) return {};
  const auto run = client.run(now->status->run);
  const bool is_over = run && run->state != "active" && run->state != "ordered";
  if (is_over) return {};
  return fmt::format("Run {} is active: what it changes is reported at its end\n",
                     short_id(now->status->run));
}

std::string number_text(const std::optional<double>& number) {
  return number ? fmt::format("{}", *number) : "vacant";
}

nlohmann::ordered_json to_json(const Found& found, const KeptMemory& cells) {
  auto list = nlohmann::ordered_json::array();
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  for (const auto& [name, cell] : cells)
    list.push_back({{"name", name}, {"value", number(cell.value)}, {"setup", number(cell.base)}});
  return {{"machine", found.reported.machine},
          {"run", found.reported.run},
          {"program", found.reported.program},
          {"ended", found.reported.time},
          {"cells", std::move(list)}};
}

int show(Context& context, client::Client& client, const MemoryCommand& command) {
  auto found = wanted(client, command);
  if (!found) return complain(found.error());
  const KeptMemory cells = filtered(found->memory, command.filter);
  if (context.wants_json) {
    context.print(json_text(to_json(*found, cells)));
    return kExitOk;
  }
  Table table({"NAME", right("VALUE"), right("FROM SETUP")});
  for (const auto& [name, cell] : cells)
    table.add({name, number_text(cell.value), number_text(cell.base)});
  context.print(table);
  const std::string program =
      found->reported.program.empty() ? "begun at the machine" : "of " + found->reported.program;
  const auto& change = found->reported.change;
  const std::string origin =
      change ? fmt::format("Since {} has set {}", printable(change->who), printable(change->what))
             : fmt::format("As run {} {} left it", short_id(found->reported.run), program);
  context.print(fmt::format("{}, {}\n", origin, time_text(found->reported.time)));
  if (command.run.empty()) context.print(what_may_follow(client, command.machine));
  return kExitOk;
}

int list(Context& context, client::Client& client, const MemoryCommand& command) {
  auto all = memories(client, command.machine, kMaxRuns);
  if (!all) return complain(all.error());
  if (context.wants_json) {
    auto runs = nlohmann::ordered_json::array();
    for (const Found& found : *all) runs.push_back(to_json(found, found.memory));
    context.print(json_text(nlohmann::ordered_json{{"memories", std::move(runs)}}));
    return kExitOk;
  }
  Table table({"RUN", "PROGRAM", "ENDED", right("CELLS")});
  for (const Found& found : *all) {
    const auto& change = found.reported.change;
    table.add({short_id(found.reported.run), change ? change->what : found.reported.program,
               time_text(found.reported.time), std::to_string(found.memory.size())});
  }
  context.print(table);
  return kExitOk;
}

int compare(Context& context, client::Client& client, const MemoryCommand& command) {
  auto now = wanted(client, {.machine = command.machine});
  if (!now) return complain(now.error());
  auto then = wanted(client, command);
  if (!then) return complain(then.error());
  KeptMemory names = now->memory;
  names.insert(then->memory.begin(), then->memory.end());
  const auto text_in = [](const KeptMemory& memory, const std::string& name) {
    const auto found = memory.find(name);
    return found == memory.end() ? std::string("as the setup") : number_text(found->second.value);
  };
  Table table({"NAME", right("NOW"), right(short_id(then->reported.run))});
  bool differ = false;
  for (const auto& [name, unused] : filtered(names, command.filter)) {
    const std::string a = text_in(now->memory, name), b = text_in(then->memory, name);
    if (a == b) continue;
    differ = true;
    table.add({name, a, b});
  }
  context.print(differ ? table.render(context.has_color()) : std::string("No difference\n"));
  return kExitOk;
}

/// The machine's newest setup with these variables: what it changes is taken over at the next
/// start.
int save(Context& context, client::Client& client, const MemoryCommand& command,
         const std::map<std::string, double>& variables, const std::string& why) {
  auto setup = client.setup(command.machine, std::nullopt);
  if (!setup) return complain(setup.error());
  const auto text = with_variables(setup->text, variables);
  if (!text) return complain(text.error());
  auto saved =
      client.save_setup({command.machine, *text, command.comment.empty() ? why : command.comment,
                         "", setup->revision});
  return saved ? report_saved(context, client, *saved) : complain(saved.error());
}

int restore(Context& context, client::Client& client, const MemoryCommand& command) {
  auto then = wanted(client, command);
  if (!then) return complain(then.error());
  std::map<std::string, double> variables;
  // What has changed since goes back to what the setup gives.
  if (auto now = wanted(client, {.machine = command.machine})) {
    for (const auto& [name, cell] : filtered(now->memory, command.filter)) {
      if (cell.base) variables[name] = *cell.base;
    }
  }
  for (const auto& [name, cell] : filtered(then->memory, command.filter)) {
    if (cell.value) variables[name] = *cell.value;
  }
  return save(context, client, command, variables,
              fmt::format("memory of run {}", short_id(then->reported.run)));
}

int clear(Context& context, client::Client& client, const MemoryCommand& command) {
  auto now = wanted(client, {.machine = command.machine});
  if (!now) return complain(now.error());
  std::map<std::string, double> variables;
  for (const auto& [name, cell] : filtered(now->memory, command.filter)) {
    if (cell.base) variables[name] = *cell.base;
  }
  return save(context, client, command, variables, "memory cleared");
}

using MemoryAction = int (*)(Context&, client::Client&, const MemoryCommand&);

std::pair<Command, std::shared_ptr<MemoryCommand>> add_memory_verb(Command group, Context& context,
                                                                   const char* name,
                                                                   const char* help,
                                                                   MemoryAction action) {
  auto verb = group.add_subcommand(name, help);
  auto options = std::make_shared<MemoryCommand>();
  verb.add_option("MACHINE", options->machine, "The machine").required();
  run_at_server(verb, context, options, action);
  return {verb, options};
}

}  // namespace

void add_memory_commands(Command app, Context& context) {
  auto group = app.add_subcommand("memory", "Retained memory of a control: variables, offsets");
  group.require_subcommand(1);
  group.footer(
      "The retained memory is reported at the end of each run that changed it. At the next start "
      "it takes\nprecedence over the setup, except where the setup was changed since. restore and "
      "clear make a new\nversion of the setup, in force from the next start.");

  constexpr const char* kFilter = "List only names that contain this text";
  auto [showing, show_options] =
      add_memory_verb(group, context, "show", "Show the retained memory", show);
  showing.add_option("--run", show_options->run, kRunHelp);
  showing.add_option("--filter", show_options->filter, kFilter);
  add_json_flag(showing, context);

  auto [listing, unused] =
      add_memory_verb(group, context, "list", "List the runs that changed it", list);
  (void)unused;
  add_json_flag(listing, context);

  auto [comparing, compare_options] = add_memory_verb(
      group, context, "compare", "Show the difference from what a run left", compare);
  comparing.add_option("RUN", compare_options->run, kRunHelp).required();
  comparing.add_option("--filter", compare_options->filter, kFilter);

  auto [restoring, restore_options] = add_memory_verb(
      group, context, "restore", "Restore what a run left, of this or another machine", restore);
  restoring.add_option("RUN", restore_options->run, kRunHelp).required();
  restoring.add_option("--filter", restore_options->filter, kFilter);
  restoring.add_option("-m,--comment", restore_options->comment,
                       "Give a reason; shown in the list of setups");
  add_json_flag(restoring, context);

  auto [clearing, clear_options] =
      add_memory_verb(group, context, "clear",
                      "Clear the retained memory: the next start uses the setup's values", clear);
  clearing.add_option("--filter", clear_options->filter, kFilter);
  clearing.add_option("-m,--comment", clear_options->comment,
                      "Give a reason; shown in the list of setups");
  add_json_flag(clearing, context);
}

}  // namespace dripline::cli
