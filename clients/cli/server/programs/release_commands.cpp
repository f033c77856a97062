#include "clients/cli/server/programs/release_commands.hpp"

#include <algorithm>
#include <memory>

#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using DecisionCommand = client::Client::DecisionRequest;

int print_decided(Context& context, const client::Reply<client::Revision>& revision) {
  if (!revision) return complain(revision.error());
  context.print(fmt::format("{} revision {} is {}, sha256 {}\n", revision->program,
                            revision->revision, state_text(revision->state),
                            short_id(revision->sha256)));
  return kExitOk;
}

int submit(Context& context, client::Client& client, const DecisionCommand& command) {
  return print_decided(context, client.decide("submit", command));
}
int approve(Context& context, client::Client& client, const DecisionCommand& command) {
  return print_decided(context, client.decide("approve", command));
}
int release(Context& context, client::Client& client, const DecisionCommand& command) {
  return print_decided(context, client.decide("release", command));
}
int withdraw(Context& context, client::Client& client, const DecisionCommand& command) {
  return print_decided(context, client.decide("withdraw", command));
}

int reject(Context& context, client::Client& client, const DecisionCommand& command) {
  const auto rejected = client.reject_revision(command);
  if (!rejected) return complain(rejected.error());
  if (*rejected) return print_decided(context, client::Reply<client::Revision>(**rejected));
  context.print(fmt::format("Rejected {} revision {}; it is hidden and will never run.\n",
                            command.program, command.revision));
  return kExitOk;
}

int states(Context& context, client::Client& client, const DecisionCommand& command) {
  auto found = client.revision_states(command.program, command.revision);
  if (const auto status = finished(context, found)) return *status;
  context.print(fmt::format("{} revision {} is {}\n", printable(command.program), command.revision,
                            state_text(found->state)));
  if (found->steps.empty()) return kExitOk;
  const std::vector<client::Pin>* print_pins = nullptr;
  Table table({right("STEP"), "WHAT", "TIME", "WHO", "COMMENT"});
  for (const auto& step : found->steps) {
    table.add({std::to_string(step.id), printable(step.step), time_text(step.time),
               printable(step.who), printable(step.comment)});
    if (step.closure) print_pins = &*step.closure;
  }
  context.print("\n");
  context.print(table);
  if (print_pins == nullptr) return kExitOk;
  context.print(print_pins->empty() ? "\nReleased with its closure: it calls nothing.\n"
                                    : "\nReleased with its closure; a run gets these and no "
                                      "others:\n\n");
  Table pins({"PROGRAM", right("REV"), "SHA-256"});
  for (const auto& pin : *print_pins)
    pins.add({printable(pin.program), std::to_string(pin.revision), short_id(pin.sha256)});
  if (!pins.empty()) context.print(pins);
  return kExitOk;
}

using DecisionAction = int (*)(Context&, client::Client&, const DecisionCommand&);
struct DecisionVerb {
  const char* name;
  const char* help;
  DecisionAction action;
  const char* footer;
};

constexpr std::array kDecisionVerbs{
    DecisionVerb{
        "submit", "Submit a draft for review", submit,
        "A pushed revision is a draft. The server's policy decides which steps there are, who may "
        "take them, and whether\nmachines run released revisions only.\n\nExample:\n  dnc program "
        "submit O0200 3 --comment \"deeper groove\""},
    DecisionVerb{
        "approve", "Approve a revision that is in review", approve,
        "Where the policy asks for four eyes, not by who pushed the text.\n\nExample:\n  dnc "
        "program approve O0200 3"},
    DecisionVerb{
        "reject", "Reject a revision: hide a pending one, make another a draft again", reject,
        "A program that an operator sent from a control is pending approval: rejected, it is "
        "hidden permanently.\nOne that is in review or approved becomes a draft.\n\nExample:\n  "
        "dnc program reject O0200 3 --comment \"wrong offset\""},
    DecisionVerb{
        "release", "Release an approved revision", release,
        "Under the policy release, machines run released revisions only; a run names the step "
        "that released it. With --closure what the program calls is released with it and pinned: "
        "a newer\nsubprogram does not change what was approved.\n\nExample:\n  dnc program "
        "release O0200 3 --closure"},
    DecisionVerb{
        "withdraw", "Withdraw a revision; it never runs again", withdraw,
        "A run that has begun keeps it to its end.\n\nExample:\n  dnc program withdraw O0200 2 "
        "--comment \"cuts into the chuck\""},
};

void add_revision_options(Command command, const std::shared_ptr<DecisionCommand>& options) {
  command.add_option("NAME", options->program, "The program").required();
  command.add_option("REV", options->revision, "Its revision").required();
}

void add_closure_options(Command command, const std::shared_ptr<DecisionCommand>& options) {
  auto closure = command.add_flag("--closure", options->has_closure,
                                  "Release with it what it calls, and pin those revisions");
  command
      .add_option("--machine", options->machine,
                  "Machine whose newest setup binds G, M and T codes to programs")
      .needs(closure);
  command
      .add_option("--with", options->with,
                  "A program that is called too, or another revision: NAME or NAME@REVISION")
      .allow_extra_args(false)
      .needs(closure);
}

}  // namespace

std::string state_text(const std::string& state) {
  std::string text = printable(state);
  std::ranges::replace(text, '_', ' ');
  return text;
}

void add_release_commands(Command group, Context& context) {
  for (const DecisionVerb& verb : kDecisionVerbs) {
    auto command = group.add_subcommand(verb.name, verb.help);
    auto options = std::make_shared<DecisionCommand>();
    add_revision_options(command, options);
    command.add_option("--comment", options->comment, "State why; kept with the decision");
    if (verb.action == release) add_closure_options(command, options);
    command.footer(verb.footer);
    run_at_server(command, context, options, verb.action);
  }
  add_closure_command(group, context);
  auto command = group.add_subcommand("states", "Show what was decided about a revision");
  auto options = std::make_shared<DecisionCommand>();
  add_revision_options(command, options);
  add_json_flag(command, context);
  command.footer("--json has the signed texts, their Ed25519 signatures and the server's key.");
  run_at_server(command, context, options, states);
}

}  // namespace dripline::cli
