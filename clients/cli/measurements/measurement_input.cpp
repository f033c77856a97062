#include "clients/cli/measurements/measurement_input.hpp"

#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/tools/measurement_files/aqdef.hpp"
#include "clients/tools/measurement_files/text_files.hpp"

namespace dripline::cli {
namespace {

using measurement::Measurement;
using measurement_files::MeasurementSource;
using measurement_files::Visitor;

/// What the server does with its own, for files.
class Filter {
 public:
  static Result<Filter> of(const MeasurementChoice& choice) {
    Filter filter;
    filter.choice_ = choice;
    if (choice.query.run == "latest") {
      return fail(Errc::Syntax, "--run latest needs the server: name the run by its id");
    }
    if (!choice.query.verdict.empty()) {
      const auto verdict = measurement::parse_verdict(choice.query.verdict);
      if (!verdict) return fail(verdict.error());
      filter.verdict_ = *verdict;
    }
    for (const auto& [text, time] : {std::pair{&choice.query.since, &filter.since_},
                                     std::pair{&choice.query.until, &filter.until_}}) {
      if (text->empty()) continue;
      const auto parsed = parse_iso8601(*text);
      if (!parsed) return fail(parsed.error());
      *time = *parsed;
    }
    return filter;
  }
  bool takes(const Measurement& m) const {
    const auto same = [](const std::string& wanted, const std::string& is) {
      return wanted.empty() || wanted == is;
    };
    const auto& query = choice_.query;
    return same(query.machine, m.machine) && same(query.characteristic, m.characteristic.name) &&
           same(choice_.tool, m.tool) && (query.run.empty() || m.run.starts_with(query.run)) &&
           (!verdict_ || m.verdict == *verdict_) && (!since_ || m.time >= *since_) &&
           (!until_ || m.time < *until_);
  }

 private:
  MeasurementChoice choice_;
  std::optional<measurement::Verdict> verdict_;
  std::optional<UtcTime> since_, until_;
};

class TextSource final : public MeasurementSource {
 public:
  TextSource(MappedFile file, Filter filter) : file_(std::move(file)), filter_(std::move(filter)) {}
  Result<void> each(const Visitor& visit) override {
    return measurement_files::read_measurements(
        file_.text(), [&](const Measurement& m) -> Result<void> {
          return filter_.takes(m) ? visit(m) : Result<void>{};
        });
  }

 private:
  MappedFile file_;
  Filter filter_;
};

/// Of an archive.
class FilteredSource final : public MeasurementSource {
 public:
  FilteredSource(std::unique_ptr<MeasurementSource> all, Filter filter)
      : all_(std::move(all)), filter_(std::move(filter)) {}
  Result<void> each(const Visitor& visit) override {
    return all_->each([&](const Measurement& m) -> Result<void> {
      return filter_.takes(m) ? visit(m) : Result<void>{};
    });
  }

 private:
  std::unique_ptr<MeasurementSource> all_;
  Filter filter_;
};

Result<std::unique_ptr<MeasurementSource>> open_file(const MeasurementChoice& choice) {
  auto filter = Filter::of(choice);
  if (!filter) return fail(filter.error());
  ArchiveChoice archive = choice.archive;
  if (archive.file.empty() && is_archive_name(choice.file)) archive.file = choice.file;
  if (!archive.file.empty()) {
    auto all = open_archived_measurements(archive, choice.query.with_superseded);
    if (!all) return fail(all.error());
    return std::make_unique<FilteredSource>(*std::move(all), *std::move(filter));
  }
  auto file = MappedFile::open(choice.file);
  if (!file) return fail(file.error());
  if (!has_suffix(choice.file, ".dfq"))
    return std::make_unique<TextSource>(*std::move(file), *std::move(filter));
  auto all = measurement_files::read_aqdef(file->text(), {});
  if (!all) return fail(all.error().code, "{}: {}", choice.file, all.error().what);
  std::erase_if(*all, [&](const Measurement& m) { return !filter->takes(m); });
  return std::make_unique<measurement_files::ListSource>(*std::move(all));
}

/// Closes it; its name is gone when it has been mapped.
struct Download {
  std::string path = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
  std::FILE* file = nullptr;
  Download() {
    const int descriptor = ::mkstemp(path.data());
    if (descriptor >= 0) file = ::fdopen(descriptor, "wb");
  }
  ~Download() {
    if (file != nullptr) std::fclose(file);
    ::unlink(path.c_str());
  }
  Download(const Download&) = delete;
  Download& operator=(const Download&) = delete;
};

std::unique_ptr<MeasurementSource> download(Context& context, const MeasurementChoice& choice) {
  const auto refuse = [&context](const auto& error) {
    context.status = complain(error);
    return nullptr;
  };
  auto client = context.connect();
  if (!client) return nullptr;
  client::MeasurementQuery query = choice.query;
  if (!query.run.empty()) {
    const auto run = find_run(*client, query.run);
    if (!run) return refuse(run.error());
    query.run = run->id;
  }
  const Download copy;
  if (copy.file == nullptr)
    return refuse(Error{Errc::Io, "file " + copy.path + " cannot be written"});
  const auto done = client->export_measurements(query, "jsonl", [&](std::string_view bytes) {
    return std::fwrite(bytes.data(), 1, bytes.size(), copy.file) == bytes.size();
  });
  if (!done) return refuse(done.error());
  if (std::fflush(copy.file) != 0)
    return refuse(Error{Errc::Io, "file " + copy.path + " cannot be written"});
  MeasurementChoice copied{.file = copy.path, .query = {}, .tool = choice.tool};
  auto source = open_file(copied);
  if (!source) return refuse(source.error());
  return *std::move(source);
}

}  // namespace

bool has_suffix(std::string_view path, std::string_view suffix) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return path.size() >= suffix.size() &&
         std::ranges::equal(path.substr(path.size() - suffix.size()), suffix, {}, lower, lower);
}

void add_measurement_choice(Command command, MeasurementChoice& choice) {
  command.add_option("--characteristic", choice.query.characteristic,
                     "Take only this characteristic");
  command.add_option("--machine", choice.query.machine, "Take only this machine");
  command.add_option("--run", choice.query.run,
                     "Take only this run: its id, the beginning of it, or latest");
  command.add_option("--tool", choice.tool, "Take only what this tool cut, e.g. T3");
  command.add_option(
      "--since", choice.query.since,
      "Take only what is from this time on, UTC: 2026-11-21 or 2026-11-21T07:40:06Z");
  command.add_option("--until", choice.query.until, "Take only what is earlier than this time");
}

std::unique_ptr<MeasurementSource> open_measurements(Context& context,
                                                     const MeasurementChoice& choice) {
  if (choice.file.empty() && choice.archive.file.empty()) return download(context, choice);
  auto source = open_file(choice);
  if (source) return *std::move(source);
  context.status = complain(source.error());
  return nullptr;
}

Result<std::vector<Measurement>> all_measurements(MeasurementSource& source) {
  std::vector<Measurement> all;
  const auto done = source.each([&](const Measurement& m) -> Result<void> {
    all.push_back(m);
    if (all.size() <= kMaxInMemory) return {};
    return fail(Errc::LimitExceeded, "over {} measurements: choose fewer", kMaxInMemory);
  });
  if (!done) return fail(done.error());
  return all;
}

}  // namespace dripline::cli
