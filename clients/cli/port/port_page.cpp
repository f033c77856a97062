#include <toml++/toml.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/port/port_file.hpp"
#include "clients/cli/port/port_parameters.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/lines/centurion_page.hpp"

/// `dnc port page`: the serial page of a Centurion and the line that fits it, without a server.
namespace dripline::cli {
namespace {

using wire::CenturionPage;
using wire::PagePort;

struct PageCommand {
  std::string file, line;
  std::vector<std::string> changes;
  bool is_secondary = false;

  PagePort port() const { return is_secondary ? PagePort::Secondary : PagePort::Primary; }
};

std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* flag = node.as_boolean()) return flag->get() ? "yes" : "no";
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  return "";
}

Result<CenturionPage> read_page(const std::string& path) {
  constexpr std::size_t kMaxPage = 16 * 1024;
  const auto text = read_small_file(path, kMaxPage);
  if (!text) return fail(text.error());
  CenturionPage page;
  try {
    for (const auto& [key, node] : toml::parse(*text)) {
      const auto line = static_cast<unsigned>(node.source().begin.line);
      const auto done = wire::set_page_value(page, key.str(), text_of(node));
      if (!done) return fail(Errc::Syntax, "{} line {}: {}", path, line, done.error().what);
    }
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "{} line {}: {}", path, static_cast<unsigned>(e.source().begin.line),
                e.description());
  }
  return page;
}

int show_page(Context& context, const CenturionPage& page) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::string text;
  for (const auto& row : wire::page_rows()) {
    json[std::string(row.key)] = row.get(page);
    text +=
        fmt::format("{:<31}# {}\n", fmt::format("{} = \"{}\"", row.key, row.get(page)), row.text);
  }
  context.print(context.wants_json ? json_text(json) : text);
  return kExitOk;
}

int page_of_line(Context& context, const PageCommand& command) {
  const auto line = line_named(command.line, command.changes);
  if (!line) return complain(line.error());
  const auto page = wire::page_of_line(*line, command.port());
  return page ? show_page(context, *page) : complain(page.error());
}

int line_of_page(Context& context, const PageCommand& command) {
  const auto page = read_page(command.file);
  if (!page) return complain(page.error());
  const auto line = wire::line_of_page(*page, command.port());
  if (!line) return complain(line.error());
  return show_line(context, line->control.tape_start ? "centurion-tape" : "centurion", *line);
}

}  // namespace

void add_port_page_command(Command group, Context& context) {
  auto command = group.add_subcommand(
      "page", "Convert the serial page of a Centurion to a line, or a line to the page");
  auto options = std::make_shared<PageCommand>();
  auto file = command.add_option("FILE", options->file, "Page, as `--for` prints it");
  auto line =
      command.add_option("--for", options->line, "Print the page for this template or short form");
  command.add_option("--set", options->changes, "Settings of that line, KEY=VALUE").needs(line);
  command.add_flag("--secondary", options->is_secondary,
                   "The line is connected to the secondary port");
  file.excludes(line);
  add_json_flag(command, context);
  command.footer(
      "Examples:\n  dnc port page --for centurion > page.toml   # what to set at the control\n  "
      "dnc port page page.toml                     # template and settings for dnc port add");
  command.callback([&context, options] {
    const bool has_line = !options->line.empty();
    if (!has_line && options->file.empty()) {
      context.status = complain(Error{Errc::Syntax, "port page needs FILE or --for LINE"});
      return;
    }
    context.status = has_line ? page_of_line(context, *options) : line_of_page(context, *options);
  });
}

}  // namespace dripline::cli
