#include "clients/cli/server/archive_commands.hpp"

#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;

int list_archives(Context& context, client::Client& client) {
  const auto answer = client.archives({.limit = 1000});
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    Table table({"FILE", "MACHINE", right("ROWS"), right("SIZE"), "FIRST", "LAST", "SHA256"});
    for (const auto& one : shown.at("archives")) {
      table.add({printable(text_at(one, "file")), text_at(one, "machine"),
                 std::to_string(one.at("rows").get<std::uint64_t>()),
                 bytes_text(one.at("bytes").get<std::uint64_t>()), time_text(text_at(one, "first")),
                 time_text(text_at(one, "last")), short_id(text_at(one, "sha256"))});
    }
    context.print(table);
  });
}

int make_archives(Context& context, client::Client& client) {
  return print_answer(context, client, client.make_archives(), [&](const ordered_json& shown) {
    context.print(fmt::format("Made {} archives\n", shown.at("made").get<std::uint64_t>()));
  });
}

}  // namespace

void add_archive_commands(Command server, Context& context) {
  auto made = server.add_subcommand("archive", "Move old records into archives now");
  add_json_flag(made, context);
  run_at_server(made, context, make_archives);
  auto listed = server.add_subcommand("archives", "List the archives, newest first");
  add_json_flag(listed, context);
  run_at_server(listed, context, list_archives);
}

}  // namespace dripline::cli
