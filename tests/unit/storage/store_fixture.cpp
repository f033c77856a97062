#include "tests/unit/storage/store_fixture.hpp"

#include <regex>

#include "storage/postgresql/database.hpp"
#include "storage/sqlite/database.hpp"

namespace dripline::storage {

std::string nc_text(std::size_t size, unsigned seed) {
  std::string text;
  text.reserve(size + 64);
  unsigned state = seed;
  for (unsigned n = 10; text.size() < size; n += 10) {
    state = state * 1664525 + 1013904223;
    text += fmt::format("N{} G01 X{}.{:04} Z-{}.{:03} F{}\n", n, state >> 26, state % 10000,
                        (state >> 12) % 90, (state >> 3) % 1000, 5 + state % 20);
  }
  text.resize(size);
  return text;
}

Record make_record(std::uint64_t number, const std::string& run, const std::string& kind) {
  Record record;
  record.machine = "m1";
  record.epoch = 7;
  record.number = number;
  record.time = UtcTime{std::chrono::microseconds{1'000'000 + number}};
  record.run = run;
  record.kind = kind;
  record.block = 10 * number;
  record.line = 11 * number;
  record.sequence = static_cast<std::int64_t>(12 * number);
  record.device = "port1";
  record.text = fmt::format("X{}", number);
  return record;
}

RecordBatch make_batch(std::uint64_t first, std::uint64_t last, const std::string& run) {
  RecordBatch batch{"m1", 7, {}, {}, {}};
  for (std::uint64_t n = first; n <= last; ++n) batch.records.push_back(make_record(n, run));
  return batch;
}

namespace {

void skip(const char* why) {
  GTEST_SKIP() << why;
}

/// What damages a SQLite file, as PostgreSQL writes it.
std::string in_postgresql(const std::string& sql) {
  std::string text =
      std::regex_replace(sql, std::regex("\\bx'([0-9a-f]*)'"), "decode('$1', 'hex')");
  text = std::regex_replace(text, std::regex("AS BLOB\\)"), "AS bytea)");
  return std::regex_replace(text, std::regex("zeroblob\\((\\d+)\\)"),
                            "decode(repeat('00', $1), 'hex')");
}

}  // namespace

StoreTest::StoreTest(sql::Engine engine) : engine_(engine) {
  options_.file = directory_ / "store.sqlite";
  if (engine_ == sql::Engine::Postgresql) {
    database_ = test::TestDatabase::make();
    if (!database_) skip("PostgreSQL is not installed");
  }
  if (!IsSkipped()) reopen();
}

void StoreTest::reopen() {
  store_.reset();
  if (engine_ == sql::Engine::Postgresql) {
    auto opened = PostgresqlStore::open({.url = database_->url()}, clock_);
    ASSERT_TRUE(opened) << opened.error().what;
    store_ = std::move(*opened);
    return;
  }
  auto opened = SqliteStore::open(options_, clock_);
  ASSERT_TRUE(opened) << opened.error().what;
  store_ = std::move(*opened);
}

std::string StoreTest::begin(const std::string& program) {
  Upload upload;
  upload.program = program;
  upload.control = "centurion";
  upload.comment = "a comment";
  upload.author = "cam";
  const auto begun = store_->uploads.begin(upload);
  EXPECT_TRUE(begun) << begun.error().what;
  return begun ? begun->id : "";
}

Result<Revision> StoreTest::push(const std::string& program, std::string_view text,
                                 std::size_t piece) {
  const std::string id = begin(program);
  for (std::size_t at = 0; at < text.size(); at += piece) {
    auto appended = store_->uploads.append(id, at, bytes_of(text.substr(at, piece)));
    if (!appended) return fail(appended.error());
  }
  return store_->uploads.commit(id, sha256(text));
}

std::string StoreTest::pull(const Digest& content) {
  const auto bytes =
      store_->programs.read_content(content, 0, std::numeric_limits<std::uint64_t>::max());
  EXPECT_TRUE(bytes) << bytes.error().what;
  return bytes ? text_of(*bytes) : "";
}

storage::Run StoreTest::make_run(const std::string& id) {
  Machine machine;
  machine.name = "m1";
  machine.control = "centurion";
  machine.epoch = 7;
  machine.first_seen = machine.last_seen = clock_.now();
  EXPECT_TRUE(store_->machines.save(machine));
  const auto revision = push("p.nc", "G00 X1.\nM30\n");
  EXPECT_TRUE(revision) << revision.error().what;
  Run run;
  run.id = id;
  run.machine = "m1";
  run.program = "p.nc";
  run.revision = revision->number;
  run.content = revision->content;
  run.size = revision->size;
  run.control = "centurion";
  run.author = "operator";
  run.created = clock_.now();
  return run;
}

std::int64_t StoreTest::query(const std::string& sql) {
  const auto read = [&](auto database) {
    EXPECT_TRUE(database) << database.error().what;
    const auto value = database->integer(sql);
    EXPECT_TRUE(value) << value.error().what;
    return value.value_or(-1);
  };
  if (engine_ == sql::Engine::Postgresql)
    return read(postgresql::Database::connect({.url = database_->url()}));
  return read(sqlite::Database::open(options_.file, {.access = sqlite::Access::ReadOnly}));
}

void StoreTest::change(const std::string& sql) {
  const auto write = [](auto database, const std::string& text) {
    ASSERT_TRUE(database) << database.error().what;
    const auto done = database->execute(text);
    ASSERT_TRUE(done) << done.error().what;
  };
  if (engine_ == sql::Engine::Postgresql)
    return write(postgresql::Database::connect({.url = database_->url()}), in_postgresql(sql));
  write(sqlite::Database::open(options_.file), sql);
}

void StoreTest::damage(const std::string& sql) {
  store_.reset();
  change(sql);
  reopen();
}

}  // namespace dripline::storage
