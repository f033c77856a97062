#include "clients/cli/port/port_trial.hpp"

#include "clients/cli/port/port_file.hpp"
#include "clients/cli/text/json_text.hpp"

namespace dripline::cli {
namespace {

constexpr std::size_t kMaxText = 48 * 1024;

/// Programs are kept with LF; a file from a PC may have CR LF.
std::string with_line_feeds(std::string text) {
  std::erase(text, '\r');
  return text;
}

std::string verdict_text(const client::RuleVerdict& verdict) {
  std::string action = verdict.action;
  if (!verdict.argument.empty()) action += " " + verdict.argument;
  if (verdict.rule.empty()) return fmt::format("no rule fires; the default is: {}", action);
  return fmt::format("rule {} fires: {}", verdict.rule, action);
}

}  // namespace

int test_port(Context& context, const std::string& name) {
  auto client = context.connect();
  if (!client) return context.status;
  auto test = client->test_port(name);
  if (!test) return complain(test.error());
  if (context.wants_json) {
    context.print(json_text(*test));
  } else {
    for (const auto& finding : test->findings) context.print(printable(finding) + "\n");
    const auto verdict = test->passed ? styled("passed", Style::Good, context.has_color())
                                      : styled("failed", Style::Bad, context.has_color());
    context.print(fmt::format("{}: {}\n", printable(name), verdict));
  }
  return test->passed ? kExitOk : kExitNo;
}

int test_rules(Context& context, const std::string& name, const std::string& file) {
  auto text = read_small_file(file, kMaxText);
  if (!text) return complain(text.error());
  auto client = context.connect();
  if (!client) return context.status;
  auto verdict = client->test_rules(name, with_line_feeds(*std::move(text)));
  if (!verdict) return complain(verdict.error());
  if (context.wants_json) {
    context.print(json_text(*verdict));
    return kExitOk;
  }
  for (const auto& reason : verdict->why) context.print("  " + printable(reason) + "\n");
  const Style style = verdict->rule.empty() ? Style::Busy : Style::Good;
  context.print(styled(printable(verdict_text(*verdict)), style, context.has_color()) + "\n");
  return kExitOk;
}

}  // namespace dripline::cli
