// Measurements at scale, as a program of its own because filling takes minutes: measurement_bench
// [ROWS] [MACHINES]. Prints how fast rows are stored, their bytes, the 95th percentile of queries
// by machine, time and characteristic, how fast they are exported, and how many records a second
// are stored beside readers. Default: 200,000 rows of 20 machines.
#include <stdlib.h>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <random>
#include <thread>

#include "protocol/base/invariant.hpp"
#include "storage/sqlite_store.hpp"

namespace {

using namespace dripline;
using namespace dripline::storage;
using Steady = std::chrono::steady_clock;

constexpr std::uint64_t kBatch = 1000;
constexpr int kCharacteristics = 12;
const UtcTime kBegin{std::chrono::microseconds{1'700'000'000'000'000}};

double seconds_since(Steady::time_point begin) {
  return std::chrono::duration<double>(Steady::now() - begin).count();
}

std::string machine_name(std::uint64_t machine) {
  return fmt::format("m{}", machine);
}

/// One value a second on each machine, twelve characteristics in turn, a part each dozen.
DerivedBatch batch_of(std::uint64_t machine, std::uint64_t after) {
  DerivedBatch batch;
  batch.machine = machine_name(machine);
  batch.epoch = 1;
  batch.after = after;
  batch.through = after + kBatch;
  batch.state = "{}";
  for (std::uint64_t n = after + 1; n <= after + kBatch; ++n) {
    const std::uint64_t part = (n / kCharacteristics) * 1000 + machine + 1;
    if (batch.parts.empty() || batch.parts.back().id != part) {
      MeasuredPart made;
      made.id = part;
      made.machine = batch.machine;
      made.run = fmt::format("run-{}-{}", machine, n / 1200);
      made.program = "O0100";
      made.revision = 1;
      made.template_name = "bore";
      made.template_version = 1;
      made.begun = kBegin + std::chrono::seconds(n);
      made.ended = made.begun;
      batch.parts.push_back(made);
    }
    measurement::Measurement value;
    value.part_id = part;
    value.characteristic = {.name = fmt::format("D{}", n % kCharacteristics),
                            .nominal = 40,
                            .lower = 39.98,
                            .upper = 40.02};
    value.actual = 40 + 0.00001 * static_cast<double>(n % 2003);
    value.time = kBegin + std::chrono::seconds(n);
    value.record = {1, n};
    value.verdict = n % 997 == 0 ? measurement::Verdict::Scrap : measurement::Verdict::Good;
    batch.measurements.push_back(std::move(value));
  }
  return batch;
}

void fill(SqliteStore& store, std::uint64_t rows, std::uint64_t machines) {
  const auto pushed = store.report_templates.push(
      {.name = "bore", .version = 0, .text = "x", .author = "bench", .created = kBegin}, "bench");
  invariant(pushed.has_value(), "the template is stored");
  for (std::uint64_t machine = 0; machine < machines; ++machine) {
    Machine made;
    made.name = machine_name(machine);
    invariant(store.machines.save(made).has_value(), "the machine is stored");
  }
  const auto begin = Steady::now();
  std::uint64_t done = 0;
  for (std::uint64_t after = 0; done < rows; after += kBatch) {
    for (std::uint64_t machine = 0; machine < machines && done < rows; ++machine) {
      const auto committed = store.measurements.commit(batch_of(machine, after));
      invariant(committed.has_value(), committed ? "" : committed.error().what.c_str());
      done += kBatch;
    }
  }
  const double took = seconds_since(begin);
  fmt::print("stored {} rows in {:.1f} s: {:.0f} a second\n", done, took,
             static_cast<double>(done) / took);
}

struct Times {
  double median = 0, p95 = 0;
};
template <class Query>
Times time_of(int count, Query query) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    const auto begin = Steady::now();
    query();
    all.push_back(seconds_since(begin) * 1000);
  }
  std::ranges::sort(all);
  return {all[all.size() / 2], all[all.size() * 95 / 100]};
}

void query(SqliteStore& store, std::uint64_t rows, std::uint64_t machines) {
  std::mt19937_64 random(1);
  const std::uint64_t span = rows / machines;
  const auto some = [&](std::uint64_t below) { return random() % below; };
  const auto filter = [&](bool machine, bool name, bool time) {
    MeasurementFilter made;
    if (machine) made.machine = machine_name(some(machines));
    if (name) made.characteristic = fmt::format("D{}", some(kCharacteristics));
    if (time) {
      made.since = kBegin + std::chrono::seconds(some(span));
      made.until = *made.since + std::chrono::hours(4);
    }
    return made;
  };
  const auto show = [&](const char* what, const auto& make) {
    const auto times = time_of(300, [&] {
      const auto found = store.measurements.list(make(), {}, 1000);
      invariant(found.has_value(), "the query is answered");
    });
    fmt::print("{}: median {:.2f} ms, 95 % {:.2f} ms (up to 1000 rows)\n", what, times.median,
               times.p95);
  };
  show("machine, characteristic, time", [&] { return filter(true, true, true); });
  show("machine, time", [&] { return filter(true, false, true); });
  show("characteristic, time", [&] { return filter(false, true, true); });
  show("time", [&] { return filter(false, false, true); });
  show("outside limits, machine", [&] {
    auto made = filter(true, false, false);
    made.verdict = measurement::Verdict::Scrap;
    return made;
  });
  show("run", [&] {
    MeasurementFilter made;
    made.run = fmt::format("run-{}-{}", some(machines), some(span / 1200 + 1));
    return made;
  });
}

std::uint64_t export_all(SqliteStore& store, const MeasurementFilter& filter) {
  std::optional<MeasurementPlace> place;
  std::uint64_t count = 0;
  for (;;) {
    const auto rows = store.measurements.list(filter, place, 1000);
    invariant(rows.has_value(), "the page is read");
    count += rows->size();
    if (rows->size() < 1000) return count;
    place = MeasurementPlace{rows->back().time, rows->back().id};
  }
}

/// A tenth, then all of one machine: the same rows a second when the time is linear.
void time_export(SqliteStore& store, std::uint64_t rows, std::uint64_t machines) {
  for (const std::uint64_t part : {10, 1}) {
    MeasurementFilter filter;
    filter.machine = machine_name(0);
    filter.until = kBegin + std::chrono::seconds(rows / machines / part + 1);
    const auto begin = Steady::now();
    const std::uint64_t count = export_all(store, filter);
    const double took = seconds_since(begin);
    fmt::print("exported {} rows in {:.2f} s: {:.0f} a second\n", count, took,
               static_cast<double>(count) / took);
  }
}

/// Report lines of one run, read as an export does it.
void time_report(SqliteStore& store, std::uint64_t lines) {
  std::uint64_t number = 0;
  const auto begin = Steady::now();
  while (number < lines) {
    RecordBatch batch;
    batch.machine = "m0";
    batch.epoch = 2;
    for (std::uint64_t i = 0; i < kBatch; ++i) {
      Record record;
      record.machine = "m0";
      record.epoch = 2;
      record.number = ++number;
      record.time = kBegin;
      record.run = "long";
      record.kind = "output";
      record.text = "D    12 NOM     40.000 ACT     40.018 DEV      0.018 TOL  0.020 OUT 0";
      batch.records.push_back(std::move(record));
    }
    invariant(store.records.store(batch).has_value(), "records are stored");
  }
  fmt::print("stored {} records in {:.1f} s\n", number, seconds_since(begin));
  const auto read_begin = Steady::now();
  RecordPlace place;
  std::uint64_t read = 0;
  for (;;) {
    const auto records = store.records.of_run_after("long", "output", place, 1000);
    invariant(records.has_value(), "records are read");
    read += records->size();
    if (records->size() < 1000) break;
    place = {records->back().epoch, records->back().number};
  }
  fmt::print("report of {} lines read in {:.2f} s\n", read, seconds_since(read_begin));
}

/// Records of one machine, while two threads query measurements.
void write_beside_reading(SqliteStore& store, std::uint64_t rows, std::uint64_t machines) {
  std::atomic<bool> is_over = false;
  std::atomic<std::uint64_t> queries = 0;
  std::vector<std::jthread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&, i] {
      std::mt19937_64 random(static_cast<unsigned>(i));
      while (!is_over) {
        MeasurementFilter filter;
        filter.machine = machine_name(random() % machines);
        filter.since = kBegin + std::chrono::seconds(random() % (rows / machines));
        invariant(store.measurements.list(filter, {}, 100).has_value(), "the query is answered");
        ++queries;
      }
    });
  }
  std::uint64_t number = 0;
  const auto begin = Steady::now();
  while (seconds_since(begin) < 5) {
    RecordBatch batch;
    batch.machine = "m1";
    batch.epoch = 3;
    for (std::uint64_t i = 0; i < kBatch; ++i) {
      Record record;
      record.machine = "m1";
      record.epoch = 3;
      record.number = ++number;
      record.time = kBegin;
      record.kind = "output";
      record.text = "D    12 NOM     40.000 ACT     40.018 DEV      0.018 TOL  0.020 OUT 0";
      batch.records.push_back(std::move(record));
    }
    invariant(store.records.store(batch).has_value(), "records are stored");
  }
  const double took = seconds_since(begin);
  is_over = true;
  readers.clear();
  fmt::print("records beside reading: {:.0f} a second, {:.0f} queries a second\n",
             static_cast<double>(number) / took, static_cast<double>(queries.load()) / took);
}

std::uint64_t number_of(const char* text, std::uint64_t otherwise) {
  if (text == nullptr) return otherwise;
  std::uint64_t value = otherwise;
  std::from_chars(text, text + std::string_view(text).size(), value);
  return std::max<std::uint64_t>(value, 1);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t rows = number_of(argc > 1 ? argv[1] : nullptr, 200'000);
  const std::uint64_t machines = number_of(argc > 2 ? argv[2] : nullptr, 20);
  std::string pattern = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  {
    const SystemClock clock;
    SqliteStoreOptions options;
    options.file = folder / "bench.sqlite";
    auto store = SqliteStore::open(options, clock);
    invariant(store.has_value(), "the store opens");
    fill(**store, rows, machines);
    fmt::print(
        "{:.0f} bytes a row in the file\n",
        static_cast<double>(std::filesystem::file_size(options.file)) / static_cast<double>(rows));
    query(**store, rows, machines);
    time_export(**store, rows, machines);
    time_report(**store, 500'000);
    write_beside_reading(**store, rows, machines);
  }
  std::filesystem::remove_all(folder);
  return 0;
}
