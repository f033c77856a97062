#include "clients/cli/server/migrate_command.hpp"

#include <unistd.h>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace dripline::cli {
namespace {

struct MigrateCommand {
  std::string to, from;
};

/// An empty variable in a script would start a server instead, or leave another database.
Check not_empty() {
  return {[](const std::string& value) {
            return std::string(value.empty() ? "a value is needed, this one is empty" : "");
          },
          ""};
}

/// Becomes `dncd`, which alone opens databases: beside this program, as they are installed. Returns
/// when that is not possible.
Error become_dncd(std::vector<std::string> words) {
  std::error_code ec;
  const auto dncd = std::filesystem::read_symlink("/proc/self/exe", ec).parent_path() / "dncd";
  words.insert(words.begin(), dncd.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(dncd.c_str(), arguments.data());
  return {Errc::NotFound,
          fmt::format("{}: {}; a migration is done at the server's computer, with its dncd",
                      dncd.string(), std::generic_category().message(errno))};
}

int migrate(Context& context, const MigrateCommand& command) {
  std::vector<std::string> words{"--migrate-to", command.to};
  if (!command.from.empty()) words.insert(words.end(), {"--store", command.from});
  if (const auto& state = context.location.state_dir)
    words.insert(words.end(), {"--state", *state});
  if (context.wants_json) words.emplace_back("--json");
  return complain(become_dncd(std::move(words)));
}

}  // namespace

void add_migrate_command(Command server, Context& context) {
  auto command = server.add_subcommand(
      "migrate", "Move everything between the SQLite file and a PostgreSQL database");
  auto options = std::make_shared<MigrateCommand>();
  command
      .add_option("--to", options->to,
                  "postgresql://HOST/NAME, an empty database; or the state folder, for a SQLite "
                  "file in it")
      .required()
      .check(not_empty());
  command
      .add_option("--from", options->from,
                  "The PostgreSQL database to leave, for --to a folder (default: the SQLite "
                  "file of --state)")
      .check(not_empty());
  add_json_flag(command, context);
  command.footer(
      "Runs at the server's computer, as the user that dncd runs as, while dncd is stopped. Reads "
      "everything\nback and compares it; ended at any moment, it continues when it is run again. "
      "What was left stays as it\nwas, and no server uses it any more.\n\nExamples:\n  dnc server "
      "migrate --to postgresql://dripline@db-1/dripline\n  dnc server migrate --from "
      "postgresql://dripline@db-1/dripline --to /var/lib/dripline");
  command.callback([&context, options] { context.status = migrate(context, *options); });
}

}  // namespace dripline::cli
