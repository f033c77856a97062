#include <fmt/format.h>
#include <filesystem>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "gateway/interpreter/dialects/centurion/reading/chart_index.hpp"

namespace dripline::cli {
namespace {

namespace centurion = interpreter::centurion;

struct ChartCommand {
  std::string index;
  std::size_t page = 0;  ///< line of the index; 0: the index itself
  bool is_whole = false;
};

void print_index(const Context& context, const ChartCommand& command,
                 const std::vector<centurion::ChartLine>& lines) {
  const std::size_t shown =
      command.is_whole ? lines.size() : std::min(lines.size(), centurion::kChartLines);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::string number = lines[i].file.empty() ? "" : std::to_string(i + 1);
    text += fmt::format("{:>3}  {}\n", number, lines[i].text);
  }
  context.print(text);
}

/// A page lies beside its index; its name cannot lead out of the folder.
int print_page(const Context& context, const ChartCommand& command, const std::string& name) {
  if (name.find_first_of("/\\") != std::string::npos || name.starts_with("..")) {
    return complain(
        Error{Errc::Syntax, fmt::format("{}: \"{}\" is no file name", command.index, name)});
  }
  const auto path = std::filesystem::path(command.index).parent_path() / name;
  auto file = MappedFile::open(path.string());
  if (!file) return complain(file.error());
  context.print_content(command.is_whole ? file->text()
                                         : centurion::first_chart_page(file->text()));
  return kExitOk;
}

int show_chart(const Context& context, const ChartCommand& command) {
  auto file = MappedFile::open(command.index);
  if (!file) return complain(file.error());
  const auto lines = centurion::parse_chart_index(file->text());
  if (command.page == 0) {
    print_index(context, command, lines);
    return kExitOk;
  }
  if (command.page > lines.size() || lines[command.page - 1].file.empty()) {
    return complain(Error{Errc::NotFound, fmt::format("{}: line {} names no page; it has {} lines",
                                                      command.index, command.page, lines.size())});
  }
  return print_page(context, command, lines[command.page - 1].file);
}

}  // namespace

void add_chart_command(Command app, Context& context) {
  auto command =
      app.add_subcommand("chart", "Show the help pages of a Centurion control (charts.dat)");
  auto options = std::make_shared<ChartCommand>();
  command.add_option("INDEX", options->index, "charts.dat; the pages are in the same folder")
      .required();
  command.add_option("PAGE", options->page, "Show the page of this line of the index");
  command.add_flag("--whole", options->is_whole, "Show more than the 16 lines the control shows");
  command.footer("No server is needed.\n\nExample:\n  dnc chart charts.dat 5");
  command.callback([&context, options] { context.status = show_chart(context, *options); });
}

}  // namespace dripline::cli
