#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;

struct OffsetChoice {
  client::OffsetQuery query;
  std::string machine, target, run, file, comment;
  std::uint64_t id = 0, limit = 200;
};

std::string offset_word(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return "-";
  return printable(found->get<std::string>());
}

std::string offset_number(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return "-";
  return found->is_number_float() ? fmt::format("{:.6g}", found->get<double>()) : found->dump();
}

std::string change_text(const ordered_json& offset) {
  return fmt::format("{} to {} {}", offset_number(offset, "old_value"),
                     offset_number(offset, "new_value"), offset_word(offset, "unit"));
}

std::string decision_text(const ordered_json& offset) {
  std::string text = offset_word(offset, "state");
  if (offset.value("automatic", false)) text += " within the policy";
  if (offset.contains("setup") && offset["setup"].is_number())
    text += fmt::format(" as setup {}", offset_number(offset, "setup"));
  return text;
}

Table offset_table(const ordered_json& offsets) {
  Table table(
      {right("ID"), "MACHINE", "VALUE", "CHANGE", right("FROM"), "STATE", "PROPOSED", "WHO"});
  for (const auto& offset : offsets) {
    table.add({offset_number(offset, "id"), offset_word(offset, "machine"),
               offset_word(offset, "target"), change_text(offset), offset_number(offset, "used"),
               decision_text(offset), time_text(offset_word(offset, "created")),
               offset_word(offset, "who")});
  }
  return table;
}

int list_offsets(Context& context, client::Client& client, const OffsetChoice& command) {
  return print_listing(context, client, client.offsets(command.query),
                       {"offsets", "No correction is proposed.\n", offset_table});
}

void print_offset(const Context& context, const ordered_json& offset) {
  Details details;
  details.add("proposal", offset_number(offset, "id"));
  details.add("value",
              fmt::format("{} {}", offset_word(offset, "machine"), offset_word(offset, "target")));
  details.add("change", change_text(offset));
  details.add("rule", offset_word(offset, "rule"));
  details.add("state", decision_text(offset));
  details.add("made from", fmt::format("setup {}", offset_number(offset, "base")));
  details.add("measurements",
              fmt::format("{} used, {} left out, {} to {}", offset_number(offset, "used"),
                          offset_number(offset, "left_out"), offset_number(offset, "first"),
                          offset_number(offset, "last")));
  if (const auto who = offset_word(offset, "who"); who != "-") details.add("decided by", who);
  if (const auto comment = offset_word(offset, "comment"); comment != "-")
    details.add("comment", comment);
  context.print(details);
  context.print("\n");
  for (const auto& reason : offset.at("reasons"))
    context.print(fmt::format("  {}\n", printable(reason.get<std::string>())));
}

int show_one(Context& context, client::Client& client, const client::Reply<std::string>& answer) {
  return print_answer(context, client, answer,
                      [&](const ordered_json& shown) { print_offset(context, shown); });
}

int show_offset(Context& context, client::Client& client, const OffsetChoice& command) {
  return show_one(context, client, client.offset(command.id));
}

/// The machine is part of the address, so that its group decides who may.
int decide(Context& context, client::Client& client, const OffsetChoice& command,
           std::string_view decision) {
  const auto known = client.offset(command.id);
  if (!known) return complain(known.error());
  std::string machine;
  const int read = shown_json(client, *known, [&](const ordered_json& shown) {
    machine = shown.at("machine").get<std::string>();
    return kExitOk;
  });
  if (read != kExitOk) return read;
  return show_one(context, client,
                  client.decide_offset(machine, command.id, decision, command.comment));
}

int approve(Context& context, client::Client& client, const OffsetChoice& command) {
  return decide(context, client, command, "approve");
}
int reject(Context& context, client::Client& client, const OffsetChoice& command) {
  return decide(context, client, command, "reject");
}

void print_evaluation(const Context& context, const ordered_json& rule) {
  const bool has_setup = rule.at("since") != 0;
  const std::string value =
      has_setup ? fmt::format("{} {} since setup {}", offset_number(rule, "value"),
                              offset_word(rule, "unit"), offset_number(rule, "since"))
                : std::string("in no setup");
  context.print(
      fmt::format("{}: {} is {}\n", offset_word(rule, "rule"), offset_word(rule, "target"), value));
  for (const auto& reason : rule.at("reasons"))
    context.print(fmt::format("  {}\n", printable(reason.get<std::string>())));
  const auto& proposal = rule.at("proposal");
  if (!proposal.is_object()) return;
  context.print(fmt::format("  proposal {}: {}, {}\n", offset_number(proposal, "id"),
                            change_text(proposal), decision_text(proposal)));
}

int evaluate(Context& context, client::Client& client, const OffsetChoice& command) {
  const auto answer = client.evaluate_offsets(command.machine);
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    for (const auto& rule : shown.at("rules")) print_evaluation(context, rule);
  });
}

int show_rules(Context& context, client::Client& client, const OffsetChoice& command) {
  const auto answer = client.offset_rules(command.machine);
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    context.print(shown.at("text").get<std::string>());
  });
}

int push_rules(Context& context, client::Client& client, const OffsetChoice& command) {
  const auto file = MappedFile::open(command.file);
  if (!file) return complain(file.error());
  const auto answer = client.save_offset_rules(command.machine, file->text());
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    context.print(fmt::format("Stored offset rules {} of {}\n", offset_number(shown, "version"),
                              command.machine));
  });
}

Table history_table(const ordered_json& history) {
  Table table({"VALUE", right("IS"), "UNIT", right("SETUP"), "SINCE", "WHO", right("RUNS"),
               right("PARTS"), right("GOOD"), right("ARCHIVED"), "FIRST RUN", "LAST RUN", "WHY"});
  for (const auto& entry : history) {
    const auto& runs = entry.at("runs");
    const auto run = [&](std::size_t i) {
      return runs.empty() ? std::string("-") : short_id(runs.at(i).get<std::string>());
    };
    table.add({offset_word(entry, "target"), offset_number(entry, "value"),
               offset_word(entry, "unit"), offset_number(entry, "setup"),
               time_text(offset_word(entry, "time")), offset_word(entry, "who"),
               std::to_string(runs.size()), offset_number(entry, "parts"),
               offset_number(entry, "good"), offset_number(entry, "archived"), run(0),
               run(runs.empty() ? 0 : runs.size() - 1), offset_word(entry, "why")});
  }
  return table;
}

/// The files that the list `key` of some entry names, each once.
std::vector<std::string> files_of(const ordered_json& history, const char* key) {
  std::vector<std::string> files;
  for (const auto& entry : history) {
    const auto list = entry.find(key);  // an older server has none
    if (list == entry.end()) continue;
    for (const auto& file : *list) {
      const std::string name = printable(file.get<std::string>());
      if (std::ranges::find(files, name) == files.end()) files.push_back(name);
    }
  }
  return files;
}

void print_archives(const Context& context, const ordered_json& history) {
  const auto archives = files_of(history, "archives");
  if (!archives.empty()) {
    context.print(
        fmt::format("\nARCHIVED parts are counted in PARTS; their measurements are in {}\n"
                    "(dnc report measurements --archive FILE reads them).\n",
                    fmt::join(archives, ", ")));
  }
  const auto uncounted = files_of(history, "uncounted");
  if (!uncounted.empty()) {
    context.print(
        fmt::format("\nMay have more parts of these runs, which an earlier version did not count: "
                    "{}\n",
                    fmt::join(uncounted, ", ")));
  }
}

/// With the digits of the control's screen, where its gateway gives the unit.
std::string number_at_machine(const ordered_json& cell, const char* key, const std::string& unit) {
  const auto found = cell.find(key);
  if (unit == "-" || found == cell.end() || !found->is_number()) return offset_number(cell, key);
  return fmt::format("{:.{}f}", found->get<double>(), unit == "in" ? 4 : 3);
}

/// What the length or the datum was computed with.
std::string basis_at_machine(const ordered_json& change, const std::string& unit) {
  const std::string length = number_at_machine(change, "length", unit);
  const std::string zero = number_at_machine(change, "zero", unit);
  std::string text = length == "-" ? "-" : "tool " + length;
  if (zero != "-") text += fmt::format(", zero {}", zero);
  return text;
}

/// In the control's memory, and in no setup.
void print_at_machine(const Context& context, const ordered_json& shown) {
  const auto changes = shown.find("at_machine");  // an older server has none
  if (changes == shown.end() || changes->empty()) return;
  Table table({"VALUE", "SINCE", "WHO", "SET", "CELLS", "UNIT", "IN FORCE"});
  for (const auto& change : *changes) {
    const std::string unit = offset_word(change, "unit");
    std::string cells;
    for (const auto& cell : change.at("cells")) {
      cells += fmt::format("{}{} {} -> {}", cells.empty() ? "" : ", ", offset_word(cell, "name"),
                           number_at_machine(cell, "before", unit),
                           number_at_machine(cell, "value", unit));
    }
    table.add({offset_word(change, "target"), time_text(offset_word(change, "time")),
               offset_word(change, "who"), offset_word(change, "what"), cells, unit,
               basis_at_machine(change, unit)});
  }
  context.print("\nSet at the machine, in the memory of its control:\n");
  context.print(table);
}

int history(Context& context, client::Client& client, const OffsetChoice& command) {
  const auto answer = client.offset_history(command.machine, command.target, command.limit);
  const int status = print_listing(context, client, answer,
                                   {"history", "No setup states such a value.\n", history_table});
  if (status != kExitOk || context.wants_json) return status;
  return shown_json(client, *answer, [&](const ordered_json& shown) {
    print_archives(context, shown.at("history"));
    print_at_machine(context, shown);
    return kExitOk;
  });
}

int in_force(Context& context, client::Client& client, const OffsetChoice& command) {
  const auto run = find_run(client, command.run);
  if (!run) return complain(run.error());
  const auto answer = client.offsets_of_run(run->id);
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    context.print(fmt::format("Run {}, blocks {} to {}: setup {}\n\n", short_id(run->id),
                              offset_number(shown, "first_block"),
                              offset_number(shown, "last_block"), offset_number(shown, "setup")));
    Table table({"VALUE", right("IS")});
    for (const auto& value : shown.at("values"))
      table.add({offset_word(value, "target"), offset_number(value, "value")});
    context.print(table);
  });
}

using Shared = std::shared_ptr<OffsetChoice>;

void add_decisions(Command group, Context& context) {
  auto list = group.add_subcommand("list", "List proposed corrections, newest first");
  const Shared listed = std::make_shared<OffsetChoice>();
  list.add_option("--machine", listed->query.machine, "List only this machine");
  list.add_option("--target", listed->query.target, "List only this value, e.g. T3.wear.X");
  list.add_option("--state", listed->query.state, "List only this state")
      .check(one_of({"pending", "applied", "rejected", "superseded"}));
  list.add_option("--limit", listed->query.limit, "List at most this many, up to 1000 [100]")
      .check(in_range(1, 1000));
  add_json_flag(list, context);
  run_at_server(list, context, listed, list_offsets);

  auto show = group.add_subcommand("show", "Show a proposal with its reasons");
  const Shared shown = std::make_shared<OffsetChoice>();
  show.add_option("ID", shown->id, "Number of the proposal (dnc offset list)").required();
  add_json_flag(show, context);
  run_at_server(show, context, shown, show_offset);

  auto yes = group.add_subcommand(
      "approve", "Approve a proposal: the machine's next setup version has the value");
  const Shared approved = std::make_shared<OffsetChoice>();
  yes.add_option("ID", approved->id, "Number of the proposal").required();
  yes.add_option("--comment", approved->comment, "State why; kept with the setup and the decision");
  add_json_flag(yes, context);
  yes.footer(
      "It goes with the machine's next start. A control at the end of a line gets it by hand (`dnc "
      "setup\nexport MACHINE`: G10 or the TNC's tool store); measurements count again once `dnc "
      "setup loaded` says so.");
  run_at_server(yes, context, approved, approve);

  auto no = group.add_subcommand("reject", "Reject a proposal");
  const Shared rejected = std::make_shared<OffsetChoice>();
  no.add_option("ID", rejected->id, "Number of the proposal").required();
  no.add_option("--reason", rejected->comment, "State why; kept with the decision").required();
  add_json_flag(no, context);
  run_at_server(no, context, rejected, reject);
}

void add_rules(Command group, Context& context) {
  auto rules = group.add_subcommand("rules", "Print a machine's offset rules");
  const Shared shown = std::make_shared<OffsetChoice>();
  rules.add_option("MACHINE", shown->machine, "The machine").required();
  add_json_flag(rules, context);
  run_at_server(rules, context, shown, show_rules);

  auto push =
      group.add_subcommand("push-rules", "Store a file as the machine's newest offset rules");
  const Shared pushed = std::make_shared<OffsetChoice>();
  push.add_option("MACHINE", pushed->machine, "The machine").required();
  push.add_option("FILE", pushed->file, "TOML with [[rule]] tables").required();
  add_json_flag(push, context);
  push.footer(
      "A rule:\n  [[rule]]\n  name = \"D40\"\n  characteristic = \"D40\"\n  target = "
      "\"T3.wear.X\"\n"
      "  program = \"O0900\"  # no other program's measurements; also: tool = 3, template = "
      "\"bore\"\n"
      "  scale = 0.5        # X is a radius, D40 a diameter\n  gain = 0.7\n  dead_band = 0.003\n"
      "  max_step = 0.02\n  min_count = 3\n  automatic = 0.005  # smaller steps without approval; "
      "0: none");
  run_at_server(push, context, pushed, push_rules);

  auto evaluated =
      group.add_subcommand("evaluate", "Evaluate a machine's rules now and report the reasons");
  const Shared evaluation = std::make_shared<OffsetChoice>();
  evaluated.add_option("MACHINE", evaluation->machine, "The machine").required();
  add_json_flag(evaluated, context);
  run_at_server(evaluated, context, evaluation, evaluate);
}

}  // namespace

void add_offset_commands(Command app, Context& context) {
  auto group =
      app.add_subcommand("offset", "Corrections of tool wear and work offsets from measurements");
  group.require_subcommand(1);
  add_decisions(group, context);
  add_rules(group, context);

  auto past = group.add_subcommand(
      "history", "List every value of an offset: who set it, why, and what was cut with it");
  const Shared of = std::make_shared<OffsetChoice>();
  past.add_option("MACHINE", of->machine, "The machine").required();
  past.add_option("TARGET", of->target, "Tool or offset: T3, T3.wear.X, G54 [all]");
  past.add_option("--setups", of->limit, "Look through this many setups, newest first [200]")
      .check(in_range(1, 1000));
  add_json_flag(past, context);
  past.footer("Example:\n  dnc offset history lathe-1 T3");
  run_at_server(past, context, of, history);

  auto force = group.add_subcommand("in-force",
                                    "List the tools and offsets that were in force during a run");
  const Shared of_run = std::make_shared<OffsetChoice>();
  force.add_option("RUN", of_run->run, kRunHelp).required();
  add_json_flag(force, context);
  run_at_server(force, context, of_run, in_force);
}

}  // namespace dripline::cli
