#include "clients/cli/server/archive_commands.hpp"

#include "clients/cli/measurements/measurement_text.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "protocol/archive/archive_reader.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;

/// An empty text allows everything; an id may be shortened.
bool is_wanted(const std::string& wanted, const std::string& found) {
  return wanted.empty() || found.starts_with(wanted);
}

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

int read_archive(const std::string& file, const std::string& kind,
                 const std::function<void(const ordered_json&)>& take) {
  auto reader = archive::ArchiveReader::open(file);
  if (!reader) return complain(reader.error());
  if (reader->head().kind != kind)
    return complain(Error{Errc::Unsupported, fmt::format("archive {} holds {}, not {}", file,
                                                         printable(reader->head().kind), kind)});
  for (;;) {
    const auto row = reader->next();
    if (!row) return complain(row.error());
    if (!*row) return kExitOk;
    const auto read = ordered_json::parse(**row, nullptr, false);
    if (!read.is_object())
      return complain(Error{Errc::Corrupt, fmt::format("archive {}: a row is no JSON", file)});
    take(read);
  }
}

int show_archived_report(Context& context, const std::string& file, const std::string& run) {
  StandardOutput output;
  const int status = read_archive(file, "records", [&](const ordered_json& record) {
    if (text_at(record, "kind") != "output" || !is_wanted(run, text_at(record, "run"))) return;
    (void)output.write(context.wants_json ? json_line(record)
                                          : printable(text_at(record, "text")) + "\n");
  });
  return output.error() ? output.complain() : status;
}

int show_archived_measurements(Context& context, const std::string& file,
                               const ArchivedChoice& choice) {
  auto rows = ordered_json::array();
  const int status = read_archive(file, "measurements", [&](const ordered_json& row) {
    const auto found = row.find("measurement");
    if (found == row.end() || !found->is_object()) return;
    const ordered_json& one = *found;
    if (!is_wanted(choice.run, text_at(one, "run"))) return;
    if (!choice.machine.empty() && choice.machine != text_at(one, "machine")) return;
    if (!choice.characteristic.empty() && choice.characteristic != text_at(one, "characteristic"))
      return;
    if (!choice.verdict.empty() && choice.verdict != text_at(one, "verdict")) return;
    if (context.wants_json) {
      context.print(json_line(one));
    } else {
      rows.push_back(one);
    }
  });
  if (!context.wants_json) context.print(measurement_table(rows));
  return status;
}

void add_archive_commands(Command server, Context& context) {
  auto made = server.add_subcommand("archive", "Move old records into archives now");
  add_json_flag(made, context);
  run_at_server(made, context, make_archives);
  auto listed = server.add_subcommand("archives", "List the archives, newest first");
  add_json_flag(listed, context);
  run_at_server(listed, context, list_archives);
}

}  // namespace dripline::cli
