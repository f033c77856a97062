#include <fmt/format.h>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/graphics_options.hpp"
#include "clients/cli/port/port_file.hpp"
#include "clients/cli/setup/loaded_setup.hpp"
#include "clients/cli/setup/setup_changes.hpp"
#include "clients/cli/setup/setup_forms.hpp"
#include "clients/cli/setup/setup_options.hpp"
#include "clients/cli/setup/setup_text.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

constexpr std::size_t kMaxSetupText = 64 * 1024;

struct SetupCommand {
  std::string machine, file, comment, control, map;
  std::optional<std::uint64_t> revision;
  std::uint64_t limit = 20;
  std::optional<std::uint64_t> base;
  std::vector<std::string> holds;
  bool wants_parameters = false;
};

int list(Context& context, const SetupCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto setups = fetch_all(command.limit,
                          [&](client::Page page) { return client->setups(command.machine, page); });
  if (const auto status = finished(context, setups, "setups")) return *status;
  if (setups->empty()) {
    context.print(fmt::format("The server keeps no setup of {}; its gateway has its own.\n",
                              command.machine));
    return kExitOk;
  }
  Table table({right("REV"), right("SIZE"), "SAVED", "BY", "COMMENT"});
  for (const auto& setup : *setups) {
    table.add({std::to_string(setup.revision), bytes_text(setup.size), time_text(setup.created),
               setup.author, setup.comment});
  }
  context.print(table);
  return kExitOk;
}

int show(Context& context, const SetupCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto setup = client->setup(command.machine, command.revision);
  if (!setup) return complain(setup.error());
  const auto menu = menu_of(*client, *setup, {command.control, command.holds});
  if (!menu) return complain(menu.error());
  if (context.wants_json) {
    auto json = client::to_json_value(*setup);
    if (*menu) add_menu(**menu, json);
    context.print(json_text(json));
    return kExitOk;
  }
  const auto text = setup_tables(*setup, context.has_color());
  if (!text) return complain(text.error());
  context.print(*text);
  if (*menu) context.print("\n" + menu_tables(**menu, context.has_color()));
  return kExitOk;
}

int push(Context& context, const SetupCommand& command) {
  auto text = read_small_file(command.file, kMaxSetupText);
  if (!text) return complain(text.error());
  auto client = context.connect();
  if (!client) return context.status;
  auto saved =
      client->save_setup({command.machine, *text, command.comment, command.control, command.base});
  return saved ? report_saved(context, *client, *saved) : complain(saved.error());
}

int put_out(const std::string& path, std::string_view text, const std::string& what) {
  const int status = write_to(path, text);
  const bool is_file = !path.empty() && path != "-";
  if (status == kExitOk && is_file) print_error("Wrote {} to {}\n", what, path);
  return status;
}

int pull(Context& context, const SetupCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto setup = client->setup(command.machine, command.revision);
  if (!setup) return complain(setup.error());
  return put_out(command.file, setup->text,
                 fmt::format("setup {} of {}", setup->revision, setup->machine));
}

/// The control of the machine, unless the command names it; a TNC where neither does.
std::string control_of(client::Client& client, const SetupCommand& command) {
  if (!command.control.empty()) return command.control;
  const auto machine = client.machine(command.machine);
  return machine && !machine->control.empty() ? machine->control : "tnc155";
}

/// The text of a parameter map; none was named: nothing.
Result<std::string> map_of(const std::string& path) {
  if (path.empty()) return std::string();
  auto text = read_small_file(path, kMaxSetupText);
  if (text && text->empty()) return fail(Errc::Syntax, "{} is empty", path);
  return text;
}

int export_form(Context& context, const SetupCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto setup = client->setup(command.machine, command.revision);
  if (!setup) return complain(setup.error());
  const auto map = map_of(command.map);
  if (!map) return complain(map.error());
  const std::string control = control_of(*client, command);
  const auto text = command.wants_parameters ? machine_parameters_text(setup->text, control)
                                             : control_form_of(setup->text, control, *map);
  if (!text) return complain(text.error());
  const bool is_ours = !command.wants_parameters && control == "centurion" && map->empty();
  if (is_ours) {
    print_error(
        "dnc: numbers from P500 on are Dripline's own and not the control's: do not send "
        "this to a Centurion. --map FILE gives it the control's\n");
  }
  return put_out(command.file, *text,
                 fmt::format("setup {} of {} {}", setup->revision, setup->machine,
                             is_ours ? "in Dripline's numbering" : "as its control takes it"));
}

struct ImportCommand {
  std::vector<std::string> files;
  std::string output, setup, map, units;
};

int import_tables(const ImportCommand& command, const std::vector<std::string>& texts) {
  if (command.units.empty()) {
    return complain(Error{Errc::Syntax,
                          "LinuxCNC's files do not say their unit: give that of the machine "
                          "(LINEAR_UNITS of its ini file) with --units mm or in"});
  }
  if (!command.setup.empty() || !command.map.empty())
    return complain(Error{Errc::Syntax, "--setup and --map do not go with LinuxCNC's files"});
  const auto setup = setup_of_table_files(
      texts, command.units == "in" ? interpreter::Units::Inch : interpreter::Units::Millimeter);
  if (!setup) {
    const std::string files = fmt::format("{}", fmt::join(command.files, ", "));
    return complain(Error{setup.error().code, files + ": " + setup.error().what});
  }
  return put_out(command.output, *setup, "a setup");
}

int import_form(const ImportCommand& command) {
  std::vector<std::string> texts;
  for (const std::string& path : command.files) {
    auto text = read_small_file(path, kMaxSetupText);
    if (!text) return complain(text.error());
    texts.push_back(*std::move(text));
  }
  if (texts.size() > 1 || !command.units.empty() || is_table_file(texts.front()))
    return import_tables(command, texts);
  const std::string& path = command.files.front();
  const auto version = tnc_version_of(command.setup);
  if (!version) return complain(version.error());
  const auto map = map_of(command.map);
  if (!map) return complain(map.error());
  const auto setup = setup_of_control_form(texts.front(), *version, *map);
  if (!setup) return complain(Error{setup.error().code, path + ": " + setup.error().what});
  return put_out(command.output, *setup, "a setup");
}

void add_import(Command group, Context& context) {
  auto command = group.add_subcommand(
      "import",
      "Make a setup from the text of a control: TNC tools or MP, Centurion parameters, LinuxCNC's "
      "tool table and parameter file");
  auto options = std::make_shared<ImportCommand>();
  command
      .add_option("FILE", options->files,
                  "A TNC's program 0 or its list MP0: ..., P... = values between G10 and G11, or "
                  "LinuxCNC's tool.tbl, its .var, or both")
      .required()
      .expected(1, 2);
  command.add_option("--setup", options->setup,
                     "TOML file whose [control] names the TNC's model and software; what that "
                     "control lacks is refused");
  command.add_option("--map", options->map,
                     "Centurion: which of its numbers from P500 on is which of Dripline's "
                     "(deploy/examples/centurion-parameters.map)");
  command
      .add_option("--units", options->units,
                  "LinuxCNC: the unit of its machine, mm or in (LINEAR_UNITS of its ini file)")
      .check(one_of({"mm", "in"}));
  command.add_option("-o,--output", options->output,
                     "TOML file to write, - for standard output [-]");
  command.footer(
      "No server is needed. A Centurion's numbers of tables and pages are not known: without --map "
      "only\nwhat dnc setup export has written, or P0 to P199, is taken.");
  command.callback([&context, options] { context.status = import_form(*options); });
}

/// The old text becomes the newest revision: nothing is ever lost.
int restore(Context& context, const SetupCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto old = client->setup(command.machine, command.revision);
  if (!old) return complain(old.error());
  const std::string comment =
      command.comment.empty() ? fmt::format("setup {} again", old->revision) : command.comment;
  auto saved = client->save_setup({command.machine, old->text, comment, command.control});
  return saved ? report_saved(context, *client, *saved) : complain(saved.error());
}

using SetupAction = int (*)(Context&, const SetupCommand&);

struct Verb {
  Command command;
  std::shared_ptr<SetupCommand> options;
};
Verb add_setup_verb(Command group, Context& context, const char* name, const char* help,
                    SetupAction action) {
  Verb verb{group.add_subcommand(name, help), std::make_shared<SetupCommand>()};
  verb.command.add_option("MACHINE", verb.options->machine, "The machine").required();
  verb.command.callback(
      [&context, options = verb.options, action] { context.status = action(context, *options); });
  return verb;
}

void add_saving_options(Verb& verb, Context& context) {
  verb.command.add_option("-m,--comment", verb.options->comment,
                          "Give a reason; shown in the list");
  verb.command.add_option("--control", verb.options->control,
                          "Control, for a machine that has never been connected, e.g. tnc155");
  add_json_flag(verb.command, context);
}

}  // namespace

void add_setup_commands(Command app, Context& context) {
  auto group = app.add_subcommand("setup", "Tool tables, offsets and parameters of machines");
  group.require_subcommand(1);
  group.footer(
      "A setup is a TOML file with [[tool]], [[offset]], [[variable]] and [control]. The server "
      "checks it\nfor the machine's control, keeps every version, and sends the newest with each "
      "start of a program; a control at the end of a line is loaded by hand (loaded).");

  auto listing =
      add_setup_verb(group, context, "list", "List the versions of a setup, newest first", list);
  listing.command.add_option("--limit", listing.options->limit,
                             "List at most this many, 0 for all [20]");
  add_json_flag(listing.command, context);

  auto showing = add_setup_verb(group, context, "show", "Show the tables of a setup", show);
  showing.command.add_option("-r,--revision", showing.options->revision, "Version [newest]");
  showing.command.add_option("--control", showing.options->control,
                             "Control, for a machine that has never been connected, e.g. tnc155");
  showing.command
      .add_option("--holds", showing.options->holds,
                  "TNC: count vacant blocks as if these programs of the server were in its memory")
      .type_name("PROGRAM");
  showing.command.footer(
      "For a TNC also its MOD functions in the control's order, and the user parameters.");
  add_json_flag(showing.command, context);

  auto pushing =
      add_setup_verb(group, context, "push", "Store a file as the machine's setup", push);
  pushing.command.add_option("FILE", pushing.options->file, "TOML").required();
  pushing.command.add_option("--base", pushing.options->base,
                             "Push only if this is still the newest version, 0: none yet");
  add_saving_options(pushing, context);
  pushing.command.footer("Example:\n  dnc setup push mill-3 mill-3-tools.toml -m \"new cutter 4\"");

  auto pulling = add_setup_verb(group, context, "pull", "Fetch a setup's text", pull);
  pulling.command.add_option("-r,--revision", pulling.options->revision, "Version [newest]");
  pulling.command.add_option("-o,--output", pulling.options->file,
                             "File to write, - for standard output [-]");

  auto exporting =
      add_setup_verb(group, context, "export",
                     "Write a setup in the control's own format: a TNC's tools (program 0), "
                     "tools and offsets of a Fanuc control (G10), a Centurion's parameters "
                     "(G10; with --map in the control's numbers), LinuxCNC's tool table",
                     export_form);
  exporting.command.add_option("--control", exporting.options->control,
                               "tnc155, centurion, fanuc, fanuc-t or rs274ngc [the machine's]");
  exporting.command.add_flag(
      "--parameters", exporting.options->wants_parameters,
      "Instead, a TNC's machine parameters (MP0: ...) or LinuxCNC's parameter "
      "file (.var)");
  exporting.command.add_option("--map", exporting.options->map,
                               "Centurion: its numbers, filled in by its builder "
                               "(deploy/examples/centurion-parameters.map)");
  exporting.command.footer(
      "A Centurion's numbers from P500 on are not known. Without --map they are Dripline's own: a "
      "backup\nfor dnc setup import, which overwrites other parameters on a real control. Never "
      "send it to one.");
  exporting.command.add_option("-r,--revision", exporting.options->revision, "Version [newest]");
  exporting.command.add_option("-o,--output", exporting.options->file,
                               "File to write, - for standard output [-]");
  add_import(group, context);
  add_setup_options(group, context);

  add_setup_changes(group, context);
  add_loaded_setup(group, context);

  auto restoring =
      add_setup_verb(group, context, "restore", "Make an old version the newest", restore);
  restoring.command.add_option("REVISION", restoring.options->revision, "Version to restore")
      .required();
  add_saving_options(restoring, context);
}

}  // namespace dripline::cli
