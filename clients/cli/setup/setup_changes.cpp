#include "clients/cli/setup/setup_changes.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/changer.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

namespace dripline::cli {

namespace {

namespace tnc155 = interpreter::tnc155;
using client::Failure;
using Changes = std::vector<SetupChange>;

struct ChangeCommand {
  std::string machine, parameter, value, comment;
};

template <class... Arguments>
tl::unexpected<Failure> refused(Errc code, fmt::format_string<Arguments...> text,
                                Arguments&&... arguments) {
  return client::failed(Failure::Kind::Refused, code, text, std::forward<Arguments>(arguments)...);
}

/// A setup's text, checked as its control checks it.
client::Reply<interpreter::Setup> read_setup(const client::Setup& setup) {
  auto data = interpreter::parse_control_data(setup.text);
  if (!data) return refused(data.error().code, "{}", data.error().what);
  const auto options = tnc155::read_options(*data);
  if (!options) {
    return refused(options.error().code, "setup {} of {} is not one of a TNC: {}", setup.revision,
                   setup.machine, options.error().what);
  }
  return *std::move(data);
}

/// Stores the changed text as the next version, unless there is one already.
int save(Context& context, client::Client& client, const client::Setup& before,
         const Changes& changes, const std::string& comment) {
  client::SetupRequest request{before.machine, {}, comment, {}, before.revision};
  auto text = with_numbers(before.text, changes);
  if (!text) return complain(text.error());
  request.text = *std::move(text);
  client::Setup changed = before;
  changed.text = request.text;
  if (const auto checked = read_setup(changed); !checked) return complain(checked.error());
  // The control of a machine never seen is given by the user who saves.
  if (!client.machine(before.machine)) request.control = "tnc155";
  const auto saved = client.save_setup(request);
  return saved ? report_saved(context, client, *saved) : complain(saved.error());
}

client::Reply<double> number_of(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto read = std::from_chars(begin, text.data() + text.size(), value);
  if (read.ec == std::errc{} && read.ptr == text.data() + text.size() && std::isfinite(value)) {
    return value;
  }
  return client::failed(Failure::Kind::Local, Errc::Syntax, "'{}' is not a number", text);
}

/// A user parameter has its value beside it, and may be among the machine parameters too.
Changes changes_of(const interpreter::Setup& data, const tnc155::UserParameter& parameter,
                   std::size_t place, double value) {
  const std::string text = fmt::format("{}", value);
  Changes changes{{fmt::format("control.user_parameters[{}].value", place), text}};
  const auto machine = tnc155::machine_parameters_of(data.control);
  if (machine && machine->contains(parameter.parameter)) {
    changes.push_back({fmt::format("control.machine_parameters.MP{}", parameter.parameter), text});
  }
  return changes;
}

int set_parameter(Context& context, const ChangeCommand& command) {
  const auto value = number_of(command.value);
  if (!value) return complain(value.error());
  auto client = context.connect();
  if (!client) return context.status;
  const auto setup = client->setup(command.machine, std::nullopt);
  if (!setup) return complain(setup.error());
  const auto data = read_setup(*setup);
  if (!data) return complain(data.error());
  const auto settings = tnc155::read_mod_settings(data->control);
  if (!settings) return complain(settings.error());
  const auto place = tnc155::find_user_parameter(*settings, command.parameter);
  if (!place) {
    return complain(Failure{Failure::Kind::Refused, place.error().code,
                            fmt::format("machine {}: {}", command.machine, place.error().what)});
  }
  const auto& parameter = settings->user_parameters[*place];
  if (const auto good = tnc155::check_value(parameter, *value); !good) {
    return complain(Failure{Failure::Kind::Refused, good.error().code,
                            fmt::format("machine {}: {}", command.machine, good.error().what)});
  }
  const std::string comment = command.comment.empty()
                                  ? fmt::format("{} (MP{}) {:.12g}, before {:.12g}", parameter.text,
                                                parameter.parameter, *value, parameter.value)
                                  : command.comment;
  return save(context, *client, *setup, changes_of(*data, parameter, *place, *value), comment);
}

/// The newest run that has begun; what was refused changed nothing.
client::Reply<client::Run> newest_run(client::Client& client, const std::string& machine) {
  constexpr std::uint64_t kMaxLookedAt = 1000;
  const auto runs = fetch_all(kMaxLookedAt, [&](client::Page page) {
    return client.runs({machine, "", "", page});
  });
  if (!runs) return client::failed(runs.error());
  for (const auto& run : *runs) {
    if (run.state == "refused") continue;
    if (run.state == "ordered" || run.state == "active") {
      return refused(Errc::Busy,
                     "machine {}: run {} is {}: its pockets are known when it has ended", machine,
                     short_id(run.id), run.state);
    }
    return run;
  }
  return refused(Errc::NotFound, "machine {} has finished no run", machine);
}

/// The run's pockets are those of the setup it began with, and of no other one.
client::Reply<void> check_setup_of(const client::Run& run, const client::Setup& setup) {
  if (run.setup == setup.revision) return {};
  if (!run.setup) {
    return refused(Errc::Conflict, "run {} of {} began without a setup of the server",
                   short_id(run.id), run.machine);
  }
  return refused(Errc::Conflict,
                 "run {} of {} began with setup {}, and {} is the newest by now: its pockets are "
                 "not taken over",
                 short_id(run.id), run.machine, *run.setup, setup.revision);
}

/// Pocket by tool, from the run's last line about it. A run that was cut off may have changed none;
/// one that came to its end has reported all.
client::Reply<std::map<int, int>> reported_pockets(client::Client& client, const client::Run& run) {
  const auto records =
      fetch_all(0, [&](client::Page page) { return client.records(run.id, "output", page); });
  if (!records) return client::failed(records.error());
  std::map<int, int> pockets;
  for (const auto& record : *records) {
    const auto tool = tnc155::read_pocket_text(record.text);
    if (record.device == "screen" && tool && tool->pocket) pockets[tool->tool] = *tool->pocket;
  }
  if (pockets.empty() && run.state == "completed") {
    return refused(Errc::NotFound,
                   "run {} of {} has reported no pockets: a control on a line does not; dnc setup "
                   "import takes its program 0",
                   short_id(run.id), run.machine);
  }
  return pockets;
}

int take_pockets(Context& context, const ChangeCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  const auto setup = client->setup(command.machine, std::nullopt);
  if (!setup) return complain(setup.error());
  const auto data = read_setup(*setup);
  if (!data) return complain(data.error());
  if (!tnc155::read_options(*data)->random_changer) {
    return complain(Failure{Failure::Kind::Refused, Errc::Unsupported,
                            fmt::format("setup {} of {} has no random changer (random_changer): "
                                        "its pockets do not change",
                                        setup->revision, setup->machine)});
  }
  const auto run = newest_run(*client, command.machine);
  if (!run) return complain(run.error());
  if (const auto same = check_setup_of(*run, *setup); !same) return complain(same.error());
  const auto pockets = reported_pockets(*client, *run);
  if (!pockets) return complain(pockets.error());
  Changes changes;
  for (std::size_t i = 0; i < data->tools.size(); ++i) {
    const auto& tool = data->tools[i];
    const auto now = pockets->find(tool.number);
    if (!tool.pocket || now == pockets->end() || now->second == *tool.pocket) continue;
    changes.push_back({fmt::format("tool[{}].pocket", i), std::to_string(now->second)});
  }
  const std::string comment = command.comment.empty()
                                  ? fmt::format("pockets after run {}", short_id(run->id))
                                  : command.comment;
  return save(context, *client, *setup, changes, comment);
}

void add_verb(Command command, Context& context, const std::shared_ptr<ChangeCommand>& options,
              int (*action)(Context&, const ChangeCommand&)) {
  command.add_option("-m,--comment", options->comment, "Give a reason; shown in the list");
  add_json_flag(command, context);
  command.callback([&context, options, action] { context.status = action(context, *options); });
}

/// How it comes into the control.
std::string way_of(client::Client& client, const client::Setup& setup) {
  const auto machine = client.machine(setup.machine);
  const bool has_line = machine && machine->starts && machine->starts->head;
  if (!has_line) return "it goes with the next start";
  return fmt::format("load it into the control, then: dnc setup loaded {} {}", setup.machine,
                     setup.revision);
}

}  // namespace

int report_saved(Context& context, client::Client& client, const client::Setup& setup) {
  if (context.wants_json) {
    context.print(json_text(setup));
  } else if (setup.unchanged) {
    context.print(
        fmt::format("Setup {} of {} is the same already\n", setup.revision, setup.machine));
  } else {
    context.print(fmt::format("Saved setup {} of {}, {}; {}\n", setup.revision, setup.machine,
                              bytes_text(setup.size), way_of(client, setup)));
  }
  return kExitOk;
}

void add_setup_changes(Command group, Context& context) {
  auto parameter = group.add_subcommand("parameter", "Set a user parameter of a TNC");
  auto options = std::make_shared<ChangeCommand>();
  parameter.add_option("MACHINE", options->machine, "The machine").required();
  parameter
      .add_option("PARAMETER", options->parameter,
                  "Text, number in the menu (1 to 16), or machine parameter: MP173")
      .required();
  parameter.add_option("VALUE", options->value, "A number within its range").required();
  parameter.footer(
      "Only what [[control.user_parameters]] lists can be set; dnc setup show has the list. The "
      "newest setup\ngets a next version in which nothing else has changed.\n\nExamples:\n  dnc "
      "setup parameter mill-3 \"FEED LIMIT\" 3000\n  dnc setup parameter mill-3 MP173 1");
  add_verb(parameter, context, options, &set_parameter);

  auto pockets = group.add_subcommand(
      "pockets", "Take over the pockets of a random tool changer from the newest run");
  auto taken = std::make_shared<ChangeCommand>();
  pockets.add_option("MACHINE", taken->machine, "The machine").required();
  pockets.footer(
      "With random_changer a run reports each pocket that changes, and all of them at its end "
      "(T5 P8; pocket 0\nis the spindle). They become the next version of the setup: refused while "
      "a run is active, and when the\nsetup has changed since the run began.");
  add_verb(pockets, context, taken, &take_pockets);
}

namespace {

struct Splice {
  std::size_t begin, end;
  const std::string* value;
};

/// Where a line and a column lie, both from 1; the columns of a line are characters, not bytes.
std::size_t offset_of(std::string_view text, const toml::source_position& at) {
  std::size_t offset = 0;
  for (toml::source_index line = 1; line < at.line; ++line) {
    offset = std::min(text.find('\n', offset), text.size() - 1) + 1;
  }
  const auto is_continued = [&] {
    return offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0) == 0x80;
  };
  for (toml::source_index column = 1; column < at.column && offset < text.size(); ++column) {
    ++offset;
    while (is_continued()) ++offset;
  }
  return offset;
}

Result<toml::table> parse(std::string_view text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "line {}: {}", error.source().begin.line, error.description());
  }
}

}  // namespace

Result<std::string> with_numbers(std::string_view toml, std::span<const SetupChange> changes) {
  const auto table = parse(toml);
  if (!table) return fail(table.error());
  std::vector<Splice> splices;
  for (const SetupChange& change : changes) {
    const auto found = table->at_path(change.path);
    if (!found.is_number()) {
      return fail(Errc::NotFound, "the setup has no number at {}", change.path);
    }
    const toml::source_region& region = found.node()->source();
    splices.push_back({offset_of(toml, region.begin), offset_of(toml, region.end), &change.value});
  }
  std::ranges::sort(splices, std::greater{}, &Splice::begin);
  std::string text(toml);
  for (const Splice& splice : splices) {
    text.replace(splice.begin, splice.end - splice.begin, *splice.value);
  }
  return text;
}

}  // namespace dripline::cli
