#include "clients/cli/setup/setup_options.hpp"

#include <fmt/format.h>
#include <memory>

#include "clients/cli/text/standard_output.hpp"
#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::cli {
namespace {

using interpreter::Dialect;
using interpreter::ListedOption;

struct OptionsCommand {
  std::string control;
  bool wants_markdown = false;
};

/// "whole number, 1 to 16, rpm"; the words of a choice apart.
std::string value_text(const ListedOption& option) {
  std::string text;
  for (const std::string_view word : option.key.words()) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  const auto add = [&](std::string_view part) {
    if (!part.empty()) text.append(", ").append(part);
  };
  add(option.key.range.text());
  add(option.key.unit);
  return text;
}

nlohmann::ordered_json to_json(const Dialect& dialect) {
  auto options = nlohmann::ordered_json::array();
  for (const ListedOption& option : dialect.options()) {
    options.push_back({{"key", option.key.key},
                       {"type", option.key.type},
                       {"range", option.key.range.text()},
                       {"unit", option.key.unit},
                       {"default", option.fallback},
                       {"text", option.key.text}});
  }
  return {{"control", dialect.name}, {"options", std::move(options)}};
}

int list_options(Context& context, const OptionsCommand& command) {
  if (command.wants_markdown) {
    context.print(options_reference());
    return kExitOk;
  }
  std::vector<const Dialect*> dialects;
  if (command.control.empty()) {
    for (const Dialect& dialect : interpreter::dialects()) dialects.push_back(&dialect);
  } else {
    const auto found = interpreter::find_dialect(command.control);
    if (!found) return complain(found.error());
    dialects.push_back(*found);
  }
  auto controls = nlohmann::ordered_json::array();
  for (const Dialect* dialect : dialects) {
    if (context.wants_json) {
      controls.push_back(to_json(*dialect));
      continue;
    }
    Table table({"KEY", "VALUE", "DEFAULT", "MEANING"});
    for (const ListedOption& option : dialect->options()) {
      table.add({std::string(option.key.key), value_text(option), option.fallback,
                 std::string(option.key.text)});
    }
    const bool is_first = dialect == dialects.front();
    context.print(fmt::format("{}{}: {}\n\n", is_first ? "" : "\n", dialect->name, dialect->title));
    context.print(table);
  }
  if (context.wants_json) context.print(json_text({{"controls", std::move(controls)}}));
  return kExitOk;
}

/// A `|` would end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped.append(c == '|' ? "\\" : "").push_back(c);
  return escaped;
}

}  // namespace

std::string options_reference() {
  std::string text =
      "# The options of the controls\n\n"
      "What `[control]` of a setup file may hold ([setup-format.md](setup-format.md)), for each "
      "control. This page is written by `dnc setup\noptions --markdown`; `dnc setup options "
      "CONTROL` shows a control's part of it.\n\n"
      "- Words and texts are written in quotes, flags as `true` or `false`.\n"
      "- A length is in the setup file's `units`; the default is given with its own unit.\n"
      "- Axes are a table such as `{ X = 1.0, Z = 2.0 }`; a list is written in brackets, and a "
      "list of one value may be the value alone.\n"
      "- A key that the control does not have is an error.\n";
  for (const Dialect& dialect : interpreter::dialects()) {
    text += fmt::format("\n## {}\n\n{}\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
                        dialect.name, dialect.title);
    for (const ListedOption& option : dialect.options()) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", option.key.key, cell(value_text(option)),
                          cell(option.fallback), cell(option.key.text));
    }
  }
  return text;
}

void add_setup_options(Command group, Context& context) {
  auto command = group.add_subcommand("options", "List the options of [control]");
  auto options = std::make_shared<OptionsCommand>();
  command.add_option("CONTROL", options->control, "Only those of this control, e.g. tnc155");
  command.add_flag("--markdown", options->wants_markdown, "Write deploy/docs/options.md");
  add_json_flag(command, context);
  command.footer("No server is needed.\nExample:\n  dnc setup options fanuc");
  command.callback([&context, options] { context.status = list_options(context, *options); });
}

}  // namespace dripline::cli
