#include <fstream>
#include <memory>
#include <sstream>

#include "clients/cli/context.hpp"
#include "clients/cli/measurements/measurement_text.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/tools/report_template/report_interpreter.hpp"
#include "clients/tools/report_template/taken_json.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;

struct TemplateChoice {
  std::string name, file, run, lines;
  std::optional<std::uint64_t> version;
  bool text = false;
};

struct AssignmentChoice {
  client::TemplateAssignment assignment;
  std::string program, machine, macro;
};

int list_report_templates(Context& context, client::Client& client, const TemplateChoice&) {
  const auto templates = client.report_templates();
  if (!templates) return complain(templates.error());
  const auto assignments = client.report_template_assignments();
  if (!assignments) return complain(assignments.error());
  return shown_json(client, *templates, [&](const ordered_json& listed) {
    return shown_json(client, *assignments, [&](const ordered_json& assigned) {
      if (context.wants_json) {
        context.print(json_text(ordered_json{{"templates", listed.at("templates")},
                                             {"assignments", assigned.at("assignments")}}));
      } else if (listed.at("templates").empty()) {
        context.print("There are no report templates yet.\n");
      } else {
        context.print(template_table(listed.at("templates"), assigned.at("assignments")));
      }
      return kExitOk;
    });
  });
}

int show_template(Context& context, client::Client& client, const TemplateChoice& command) {
  const auto answer = client.report_template(command.name, command.version);
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    context.print_content(shown.at("text").get<std::string>());
  });
}

int push_template(Context& context, client::Client& client, const TemplateChoice& command) {
  const auto file = MappedFile::open(command.file);
  if (!file) {
    complain(file.error());
    return kExitUsage;
  }
  // Its errors name lines of the file, before anything is sent.
  if (const auto read = report_template::read_template(file->text()); !read)
    return complain(Error{read.error().code, command.file + ": " + read.error().what});
  const auto answer = client.push_report_template(command.name, file->text());
  return print_answer(context, client, answer, [&](const ordered_json& pushed) {
    context.print(fmt::format("Report template {} version {}\n", command.name,
                              pushed.at("version").get<std::uint64_t>()));
  });
}

int remove_template(Context& context, client::Client& client, const TemplateChoice& command) {
  const auto removed = client.remove_report_template(command.name);
  if (!removed) return complain(removed.error());
  context.print(
      fmt::format("Removed template {}; its measurements stay.\n", printable(command.name)));
  return kExitOk;
}

/// What the options mean; nullopt: they are not one of three.
std::optional<client::TemplateAssignment> assignment_of(const AssignmentChoice& command) {
  client::TemplateAssignment made = command.assignment;
  int given = 0;
  const auto take = [&](const char* scope, const std::string& subject) {
    if (subject.empty()) return;
    ++given;
    made.scope = scope;
    made.subject = subject;
  };
  take("program", command.program);
  take("machine", command.machine);
  take("macro", command.macro);
  if (given == 1) return made;
  complain(Error{Errc::Syntax, "give one of --program, --machine and --macro"});
  return std::nullopt;
}

int assign_template(Context& context, client::Client& client, const AssignmentChoice& command) {
  const auto assignment = assignment_of(command);
  if (!assignment) return kExitUsage;
  const auto assigned = client.assign_report_template(*assignment);
  if (!assigned) return complain(assigned.error());
  context.print(fmt::format("{} is for {} {}, from its next run on.\n", printable(assignment->name),
                            assignment->scope, printable(assignment->subject)));
  return kExitOk;
}

int unassign_template(Context& context, client::Client& client, const AssignmentChoice& command) {
  const auto assignment = assignment_of(command);
  if (!assignment) return kExitUsage;
  const auto done = client.unassign_report_template(*assignment);
  if (!done) return complain(done.error());
  context.print(fmt::format("{} is no longer for {} {}.\n", printable(assignment->name),
                            assignment->scope, printable(assignment->subject)));
  return kExitOk;
}

/// Lines with what the template makes of each. A line is printed as soon as it is interpreted.
class Trial {
 public:
  Trial(const Context& context, report_template::ReportTemplate read)
      : context_(context),
        interpreter_(std::make_shared<const report_template::ReportTemplate>(std::move(read))) {}

  void take(const report_template::ReportLine& line) {
    if (!interpreter_.is_for(line)) return;
    const auto taken = interpreter_.take(line);
    ++lines_;
    if (!taken.is_understood) ++unmatched_;
    const auto* rule =
        taken.is_understood ? &interpreter_.report_template().rules.at(taken.rule) : nullptr;
    print(line.text, rule, taken);
  }
  /// `cut`: how a run ended that did not complete.
  int end(std::string_view cut = {}) {
    report_template::Taken last;
    last.events = interpreter_.end(cut);
    if (!context_.wants_json) {
      for (const auto& event : last.events) context_.print(event_text(event));
      context_.print(fmt::format("\n{} lines, {} not understood\n", lines_, unmatched_));
    } else if (!last.events.empty()) {
      context_.print(json_line(report_template::taken_json("", nullptr, last)));
    }
    return unmatched_ == 0 ? kExitOk : kExitNo;
  }

 private:
  void print(std::string_view text, const report_template::LineRule* rule,
             const report_template::Taken& taken) const {
    if (context_.wants_json) {
      context_.print(json_line(report_template::taken_json(text, rule, taken)));
      return;
    }
    context_.print(taken_text(text, rule, taken));
  }

  const Context& context_;
  report_template::ReportInterpreter interpreter_;
  std::uint64_t lines_ = 0, unmatched_ = 0;
};

int try_on_file(Trial& trial, const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  std::string line;
  while (std::getline(file, line)) trial.take({.text = line});
  if (file.eof()) return trial.end();
  complain(Error{Errc::Io, name + " cannot be read"});
  return kExitUsage;
}

int try_on_run(Trial& trial, Context& context, const std::string& reference) {
  auto client = context.connect();
  if (!client) return context.status;
  const auto run = find_run(*client, reference);
  if (!run) return complain(run.error());
  const std::string cut =
      run->state == "completed" || run->ended.empty() ? "" : "ended " + run->state;
  constexpr std::uint64_t kPage = 1000;
  for (std::uint64_t offset = 0;; offset += kPage) {
    const auto records = client->records(run->id, "", {.limit = kPage, .offset = offset});
    if (!records) return complain(records.error());
    for (const auto& record : *records)
      trial.take({.text = record.text, .kind = record.kind, .device = record.device});
    if (records->size() < kPage) return trial.end(cut);
  }
}

int try_template(Context& context, const TemplateChoice& command) {
  const auto file = MappedFile::open(command.file);
  if (!file) {
    complain(file.error());
    return kExitUsage;
  }
  auto read = report_template::read_template(file->text());
  if (!read) return complain(Error{read.error().code, command.file + ": " + read.error().what});
  if (command.run.empty() == command.lines.empty()) {
    complain(Error{Errc::Syntax, "give a RUN or --lines FILE"});
    return kExitUsage;
  }
  Trial trial(context, *std::move(read));
  return command.run.empty() ? try_on_file(trial, command.lines)
                             : try_on_run(trial, context, command.run);
}

void add_try(Command group, Context& context) {
  auto command =
      group.add_subcommand("try", "Try a template: show line by line what it understands");
  auto options = std::make_shared<TemplateChoice>();
  command.add_option("FILE", options->file, "File of the template (TOML)").required();
  command.add_option("RUN", options->run, "Run: its id, the beginning of it, or latest");
  command.add_option("--lines", options->lines,
                     "Try it on the lines of this file; needs no server");
  add_json_flag(command, context);
  command.footer(
      "Nothing is stored. The exit status is 1 if a line is not understood.\n\nExamples:\n  dnc "
      "report "
      "template try bore.toml latest\n  dnc report template try bore.toml --lines printed.txt");
  command.callback([&context, options] { context.status = try_template(context, *options); });
}

void add_assignment(Command command, const std::shared_ptr<AssignmentChoice>& options) {
  command.add_option("NAME", options->assignment.name, "The template").required();
  command.add_option("--program", options->program, "Assign it to the runs of this program");
  command.add_option("--machine", options->machine,
                     "Assign it to what this machine reports, also outside runs");
  command.add_option("--macro", options->macro,
                     "Assign it to what this printing macro prints, on any machine");
}

}  // namespace

void add_template_commands(Command report, Context& context) {
  auto group =
      report.add_subcommand("template", "Report templates: how report lines become measurements");
  group.require_subcommand(1);
  add_try(group, context);

  auto push = group.add_subcommand("push", "Store a file as the template's newest version");
  auto pushed = std::make_shared<TemplateChoice>();
  push.add_option("NAME", pushed->name, "The template").required();
  push.add_option("FILE", pushed->file, "File of the template (TOML)").required();
  add_json_flag(push, context);
  push.footer("Example:\n  dnc report template push bore bore.toml");
  run_at_server(push, context, pushed, push_template);

  auto list = group.add_subcommand("list", "List templates and what they are assigned to");
  auto listed = std::make_shared<TemplateChoice>();
  add_json_flag(list, context);
  run_at_server(list, context, listed, list_report_templates);

  auto show = group.add_subcommand("show", "Print a template");
  auto shown = std::make_shared<TemplateChoice>();
  show.add_option("NAME", shown->name, "The template").required();
  show.add_option("--version", shown->version, "Print this version [the newest]");
  add_json_flag(show, context);
  run_at_server(show, context, shown, show_template);

  auto assign = group.add_subcommand("assign", "Assign a template to a program, machine or macro");
  auto assigned = std::make_shared<AssignmentChoice>();
  add_assignment(assign, assigned);
  assign.add_option("--version", assigned->assignment.version,
                    "Always use this version [the newest]");
  assign.footer(
      "It applies from the next run on. `dnc report derive` applies it to a run that has "
      "ended.\n\nExample:\n  dnc report template assign bore --program O0100");
  run_at_server(assign, context, assigned, assign_template);

  auto unassign = group.add_subcommand("unassign", "Remove an assignment");
  auto unassigned = std::make_shared<AssignmentChoice>();
  add_assignment(unassign, unassigned);
  run_at_server(unassign, context, unassigned, unassign_template);

  auto remove = group.add_subcommand("remove", "Remove a template and its assignments");
  auto removed = std::make_shared<TemplateChoice>();
  remove.add_option("NAME", removed->name, "The template").required();
  run_at_server(remove, context, removed, remove_template);
}

}  // namespace dripline::cli
