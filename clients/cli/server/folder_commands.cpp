#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct FolderList {};

struct FolderChoice {
  std::string folder;
  std::uint64_t limit = 100;
};

Cell folder_state(const client::Folder& folder) {
  if (!folder.fault.empty()) return {"fault", Style::Bad};
  return folder.looked.empty() ? Cell("not looked at yet", Style::Busy) : Cell("ok", Style::Good);
}

int list_folders(Context& context, client::Client& client, const FolderList& /*command*/) {
  const auto folders = client.folders();
  if (const auto status = finished(context, folders, "folders")) return *status;
  if (folders->empty()) {
    context.print("There are no hot folders; dncd reads them from its --config ([[folder]]).\n");
    return kExitOk;
  }
  Table table({"FOLDER", "STATE", "MACHINE", right("WAITING"), right("STORED"), right("FAILED"),
               "PATH", "FAULT, OR LAST REFUSED FILE"});
  for (const auto& folder : *folders) {
    const std::string refused =
        folder.last_refused.empty()
            ? ""
            : fmt::format("{}: {}", folder.last_refused, folder.last_reason);
    table.add({printable(folder.name), folder_state(folder),
               printable(folder.machine.empty() ? folder.control : folder.machine),
               std::to_string(folder.waiting), std::to_string(folder.stored),
               std::to_string(folder.failed), printable(folder.path),
               printable(folder.fault.empty() ? refused : folder.fault)});
  }
  context.print(table);
  return kExitOk;
}

std::string outcome_text(const client::FolderFile& file) {
  if (file.revision) return fmt::format("{} revision {}", file.program, *file.revision);
  return file.reason;
}

int list_files(Context& context, client::Client& client, const FolderChoice& command) {
  const auto files = fetch_all(
      command.limit, [&](client::Page page) { return client.folder_files(command.folder, page); });
  if (const auto status = finished(context, files, "files")) return *status;
  if (files->empty()) {
    context.print(fmt::format("Nothing was taken from folder {} yet.\n", command.folder));
    return kExitOk;
  }
  Table table({"TIME", "FILE", right("SIZE"), "STATE", "WHAT"});
  for (const auto& file : *files) {
    const bool is_failed = file.state == "failed";
    table.add({time_text(file.taken), printable(file.name), bytes_text(file.size),
               is_failed ? Cell(file.state, Style::Bad) : Cell(printable(file.state)),
               printable(outcome_text(file))});
  }
  context.print(table);
  return kExitOk;
}

}  // namespace

void add_folder_commands(Command app, Context& context) {
  auto group =
      app.add_subcommand("folder", "Hot folders: what was taken from them, and how they are");
  group.require_subcommand(1);

  auto list = group.add_subcommand("list", "List the hot folders, their counts and last faults");
  add_json_flag(list, context);
  list.footer("Hot folders are tables [[folder]] of dncd's configuration file.");
  run_at_server(list, context, std::make_shared<FolderList>(), list_folders);

  auto files = group.add_subcommand("files", "List what became of a folder's files, newest first");
  auto options = std::make_shared<FolderChoice>();
  files.add_option("NAME", options->folder, "The folder").required();
  files.add_option("--limit", options->limit, "List at most this many; 0: all");
  add_json_flag(files, context);
  files.footer("Example:\n  dnc folder files cam-mills --limit 20");
  run_at_server(files, context, options, list_files);
}

}  // namespace dripline::cli
