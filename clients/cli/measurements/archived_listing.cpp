#include "clients/cli/measurements/archived_listing.hpp"

#include <algorithm>
#include <set>

#include "clients/cli/measurements/measurement_text.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"
#include "protocol/measurement/measurement_json.hpp"

namespace dripline::cli {
namespace {

using measurement::Measurement;
using nlohmann::ordered_json;

/// Whose lines of an archive of records are meant.
struct Whose {
  std::string run, machine;  ///< one of them is empty
  bool has(const ordered_json& record) const {
    return text_at(record, "kind") == "output" && text_at(record, "run") == run &&
           (!run.empty() || text_at(record, "machine") == machine);
  }
};

Result<void> each_record(const archive::VerifiedArchive& archive, const std::string& file,
                         const std::function<Result<void>(const ordered_json&)>& visit) {
  std::uint64_t number = 0;
  return archive.each([&](const std::string& text) -> Result<void> {
    ++number;
    const auto record = ordered_json::parse(text, nullptr, false);
    if (record.is_object()) return visit(record);
    return fail(Errc::Corrupt, "archive {}: row {} is no JSON", file, number);
  });
}

/// A run goes before a machine of that name.
Result<Whose> find_whose(const archive::VerifiedArchive& archive, const ArchivedReport& report) {
  if (report.of == "latest")
    return fail(Errc::Syntax, "latest needs the server: name the run by its id");
  std::set<std::string> runs;
  bool is_machine = false;
  const auto done =
      each_record(archive, report.archive.file, [&](const ordered_json& record) -> Result<void> {
        const std::string run = text_at(record, "run");
        if (!run.empty() && run.starts_with(report.of) && runs.size() < 2) runs.insert(run);
        is_machine = is_machine || (run.empty() && text_at(record, "machine") == report.of);
        return {};
      });
  if (!done) return fail(done.error());
  if (runs.size() > 1) {
    return fail(Errc::Conflict, "run {}: several fit: {} and {}", report.of, *runs.begin(),
                *runs.rbegin());
  }
  if (!runs.empty()) return Whose{*runs.begin(), ""};
  if (is_machine) return Whose{"", report.of};
  return fail(Errc::NotFound, "archive {} has no record of run or machine {}", report.archive.file,
              report.of);
}

/// As the server's export of a report has them.
ordered_json line_json(const ordered_json& record) {
  ordered_json line;
  for (const char* key : {"number", "time", "device", "block", "line", "sequence", "text"}) {
    const auto found = record.find(key);
    line[key] = found == record.end() ? ordered_json(nullptr) : *found;
  }
  return line;
}

Result<void> print_json(const archive::VerifiedArchive& archive, const std::string& file,
                        const Whose& whose, StandardOutput& output) {
  const auto text_or_null = [](const std::string& text) {
    return text.empty() ? ordered_json(nullptr) : ordered_json(text);
  };
  const std::string machine = whose.machine.empty() ? archive.head().machine : whose.machine;
  std::string begin = json_line({{"run", text_or_null(whose.run)},
                                 {"machine", text_or_null(machine)},
                                 {"program", nullptr},
                                 {"revision", nullptr}});
  begin.erase(begin.rfind('}'));
  if (auto done = output.write(begin + ",\"lines\":["); !done) return done;
  bool is_first = true;
  auto done = each_record(archive, file, [&](const ordered_json& record) -> Result<void> {
    if (!whose.has(record)) return {};
    std::string line = json_line(line_json(record));
    line.pop_back();
    return output.write((std::exchange(is_first, false) ? "\n" : ",\n") + line);
  });
  return done ? output.write("\n]}\n") : done;
}

bool is_before(const Measurement& a, const Measurement& b) {
  return std::pair(a.time, a.id) < std::pair(b.time, b.id);
}

/// Keeps the first `limit` in the order of `before`, in memory for twice as many.
class FirstOf {
 public:
  FirstOf(std::size_t limit, bool newest_first) : limit_(limit), newest_first_(newest_first) {}
  void add(const Measurement& one) {
    kept_.push_back(one);
    if (kept_.size() >= 2 * limit_) cut();
  }
  std::vector<Measurement> take() {
    cut();
    return std::move(kept_);
  }

 private:
  void cut() {
    std::ranges::stable_sort(kept_, [this](const Measurement& a, const Measurement& b) {
      return newest_first_ ? is_before(b, a) : is_before(a, b);
    });
    if (kept_.size() > limit_) kept_.resize(limit_);
  }
  std::size_t limit_;
  bool newest_first_;
  std::vector<Measurement> kept_;
};

}  // namespace

void add_archive_choice(Command command, ArchiveChoice& choice) {
  command.add_option("--archive", choice.file,
                     "Read this archive instead of the server; needs no server");
  command.add_option(
      "--sha256", choice.sha256,
      "Refuse the archive unless its SHA-256 begins with this (dnc server archives)");
}

int show_archived_report(Context& context, const ArchivedReport& report) {
  const auto archive = open_archive(report.archive, "records");
  if (!archive) return complain(archive.error());
  const auto whose = find_whose(*archive, report);
  if (!whose) return complain(whose.error());
  StandardOutput output(report.is_raw ? Content::Raw : Content::Data);
  const std::string& file = report.archive.file;
  Result<void> done;
  if (context.wants_json) {
    done = print_json(*archive, file, *whose, output);
  } else {
    done = each_record(*archive, file, [&](const ordered_json& record) -> Result<void> {
      if (!whose->has(record)) return {};
      return output.write(text_at(record, "text") + "\n");
    });
  }
  if (output.error()) return output.complain();
  return done ? kExitOk : complain(done.error());
}

int list_archived_measurements(Context& context, const MeasurementChoice& choice) {
  const auto source = open_measurements(context, choice);
  if (!source) return context.status;
  FirstOf first(choice.query.limit, choice.query.newest_first);
  const auto done = source->each([&](const Measurement& one) -> Result<void> {
    first.add(one);
    return {};
  });
  if (!done) return complain(done.error());
  auto rows = ordered_json::array();
  for (const Measurement& one : first.take())
    rows.push_back(ordered_json(measurement::to_json(one)));
  if (context.wants_json) {
    context.print(json_text(ordered_json{{"measurements", std::move(rows)}, {"next", nullptr}}));
  } else if (rows.empty()) {
    context.print("Nothing was measured.\n");
  } else {
    context.print(measurement_table(rows));
  }
  return kExitOk;
}

}  // namespace dripline::cli
