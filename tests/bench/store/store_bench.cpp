// The store on a real disk: committed records per second and bytes of programs in and out.
// The folder is that of TMPDIR: a tmpfs there makes commits look cheaper than they are. With
// DRIPLINE_BENCH_POSTGRESQL (the URL of an empty database, with fsync on) the same runs in
// PostgreSQL, for a comparison in one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <filesystem>

#include "protocol/base/invariant.hpp"
#include "storage/postgresql/database.hpp"
#include "storage/postgresql_store.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline::storage {
namespace {

constexpr std::size_t kPiece = 4 << 20;           // as a client sends them
constexpr std::size_t kProgramBytes = 256 << 20;  // of NC text

enum class Engine : std::int64_t { Sqlite, Postgresql };

const char* postgresql_url() {
  return ::getenv("DRIPLINE_BENCH_POSTGRESQL");  // NOLINT(concurrency-mt-unsafe): no threads yet
}

/// A store of its own, in a folder or in the database that is emptied first.
class Place {
 public:
  explicit Place(Engine engine) {
    std::string pattern = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    if (engine == Engine::Postgresql) {
      open_postgresql();
    } else {
      open_sqlite();
    }
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  OpenedStore& store() { return *store_; }

 private:
  void open_sqlite() {
    SqliteStoreOptions options;
    options.file = folder_ / "bench.sqlite";
    auto opened = SqliteStore::open(options, clock_);
    invariant(opened.has_value(), "the store opens");
    store_ = std::move(*opened);
  }
  void open_postgresql() {
    auto database = postgresql::Database::connect({.url = postgresql_url()});
    invariant(database.has_value(), "the database is there");
    const auto emptied =
        database->execute("DROP SCHEMA public CASCADE; CREATE SCHEMA public; CHECKPOINT");
    invariant(emptied.has_value(), "the database is emptied");
    auto opened = PostgresqlStore::open({.url = postgresql_url()}, clock_);
    invariant(opened.has_value(), "the store opens");
    store_ = std::move(*opened);
  }

  SystemClock clock_;
  std::filesystem::path folder_;
  std::unique_ptr<OpenedStore> store_;
};

Engine engine_of(const benchmark::State& state) {
  return static_cast<Engine>(state.range(0));
}

/// SQLite, and PostgreSQL where there is one; then what else is varied.
void both_engines(benchmark::internal::Benchmark* bench, const std::vector<std::int64_t>& values) {
  bench->ArgNames({"postgresql", "of"});
  for (const std::int64_t value : values) {
    bench->Args({static_cast<std::int64_t>(Engine::Sqlite), value});
    if (postgresql_url() != nullptr)
      bench->Args({static_cast<std::int64_t>(Engine::Postgresql), value});
  }
}

/// `kPiece` bytes of contour, no two pieces alike.
std::string nc_piece(unsigned piece) {
  std::string text;
  text.reserve(kPiece + 64);
  unsigned state = piece + 1;
  for (unsigned n = 0; text.size() < kPiece; ++n) {
    state = state * 1664525 + 1013904223;
    fmt::format_to(std::back_inserter(text), "N{} G01 X{}.{:04} Z-{}.{:03} F{}\n",
                   (piece * 200000 + n) * 10, 20 + (n >> 12), state >> 18, n % 90,
                   (state >> 3) % 1000, 5 + state % 4);
  }
  text.resize(kPiece);
  return text;
}

std::vector<std::string> nc_program() {
  std::vector<std::string> pieces;
  for (unsigned i = 0; i < kProgramBytes / kPiece; ++i) pieces.push_back(nc_piece(i));
  return pieces;
}

Digest push(OpenedStore& store, const std::vector<std::string>& pieces) {
  Upload upload;
  upload.program = "big.nc";
  const auto begun = store.uploads.begin(upload);
  invariant(begun.has_value(), "the upload begins");
  std::uint64_t offset = 0;
  for (const std::string& piece : pieces) {
    const auto stored = store.uploads.append(begun->id, offset, std::as_bytes(std::span(piece)));
    invariant(stored.has_value(), "the piece is stored");
    offset = stored->received;
  }
  const auto revision = store.uploads.commit(begun->id, std::nullopt);
  invariant(revision.has_value(), "the upload is committed");
  return revision->content;
}

void store_records(benchmark::State& state) {
  Place place(engine_of(state));
  RecordBatch batch{"m1", 1, {}, {}, {}};
  batch.records.resize(static_cast<std::size_t>(state.range(1)));
  std::uint64_t number = 0;
  for (auto _ : state) {
    for (Record& record : batch.records) {
      record.machine = "m1";
      record.epoch = 1;
      record.number = ++number;
      record.run = "0190f7a2-5d4e-7c31-9c55-2f1f6a1d7b11";
      record.kind = "output";
      record.device = "port1";
      record.text = "X12.3456 Z-78.9012 D0.0031";
    }
    invariant(place.store().records.store(batch) == number, "the records are stored");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(number));
}
BENCHMARK(store_records)->Apply([](auto* bench) {
                          both_engines(bench, {1, 64, 256, 1000});
                        }) -> UseRealTime();

void update_counters(benchmark::State& state) {
  Place place(engine_of(state));
  OpenedStore& store = place.store();
  const Digest content = push(store, {"M30\n"});
  invariant(store.machines.save({"m1", "", "", "", 1, 0, {}, {}}).has_value(), "a machine");
  Run run;
  run.id = "r1";
  run.machine = "m1";
  run.program = "big.nc";
  run.revision = 1;
  run.content = content;
  invariant(store.runs.create(run).has_value(), "a run");
  std::uint64_t n = 0;
  for (auto _ : state) {
    ++n;
    invariant(store.runs.update_counters({"m1", "r1", {n, n, n}, n, 0}).has_value(),
              "counters are stored");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(n));
}
BENCHMARK(update_counters)->Apply([](auto* bench) { both_engines(bench, {1}); }) -> UseRealTime();

void push_program(benchmark::State& state) {
  const auto pieces = nc_program();
  for (auto _ : state) {
    state.PauseTiming();
    auto place = std::make_unique<Place>(engine_of(state));
    state.ResumeTiming();
    benchmark::DoNotOptimize(push(place->store(), pieces));
    state.PauseTiming();
    place.reset();
    state.ResumeTiming();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kProgramBytes));
}
BENCHMARK(push_program)->Apply([](auto* bench) {
                         both_engines(bench, {1});
                       }) -> UseRealTime() -> Unit(benchmark::kMillisecond) -> Iterations(2);

void read_program(benchmark::State& state) {
  Place place(engine_of(state));
  const Digest content = push(place.store(), nc_program());
  const auto piece = static_cast<std::uint64_t>(state.range(1));
  for (auto _ : state) {
    for (std::uint64_t offset = 0; offset < kProgramBytes; offset += piece) {
      const auto bytes = place.store().programs.read_content(content, offset, piece);
      invariant(bytes.has_value() && bytes->size() == piece, "the content is read");
    }
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kProgramBytes));
}
BENCHMARK(read_program)->Apply([](auto* bench) {
                         both_engines(bench, {16 << 10, 1 << 20});
                       }) -> UseRealTime() -> Unit(benchmark::kMillisecond) -> Iterations(2);

}  // namespace
}  // namespace dripline::storage

BENCHMARK_MAIN();
