#include "server/library/history/retention.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "protocol/archive/archive_reader.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::library {
namespace {

using nlohmann::json;

class RetentionTest : public server_test::ServerTest {
 protected:
  RetentionTest() {
    add_machine("lathe-1");
    std::filesystem::create_directory(archives());
  }
  std::filesystem::path archives() const { return folder_.path() / "archives"; }

  Retention make(const RetentionRule& records, const RetentionRule& measurements = {}) {
    Retention::Options options;
    options.records = records;
    options.measurements = measurements;
    options.file_rows = 10;
    options.piece = 3;
    return Retention({.store = *store_,
                      .clock = clock_,
                      .folder = archives(),
                      .database = "db",
                      .made_by = "test"},
                     options);
  }
  static std::uint64_t apply(Retention& retention) {
    const auto made = retention.apply();
    EXPECT_TRUE(made) << made.error().what;
    return made.value_or(0);
  }
  /// One record a minute.
  void print(std::uint64_t count, const std::string& run = "", const std::string& kind = "output") {
    storage::RecordBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 7;
    for (std::uint64_t n = 0; n < count; ++n) {
      storage::Record record;
      record.machine = "lathe-1";
      record.epoch = 7;
      record.number = ++last_;
      record.time = clock_.now();
      record.run = run;
      record.kind = kind;
      record.device = kind == "message" ? "memory" : "port1";
      record.text = fmt::format("X{}", record.number);
      batch.records.push_back(record);
      clock_.advance(std::chrono::minutes(1));
    }
    ASSERT_TRUE(store_->records.store(batch));
  }
  std::vector<std::uint64_t> stored() {
    std::vector<std::uint64_t> numbers;
    const auto records = store_->records.of_machine_after("lathe-1", {7, 0}, 1000);
    for (const auto& record : records.value()) numbers.push_back(record.number);
    return numbers;
  }
  std::vector<json> rows_of(const storage::Archive& archive) {
    auto reader = archive::ArchiveReader::open(archives() / archive.file);
    EXPECT_TRUE(reader) << reader.error().what;
    std::vector<json> rows;
    for (;;) {
      const auto row = reader->next();
      EXPECT_TRUE(row) << row.error().what;
      if (!row || !*row) break;
      rows.push_back(json::parse(**row));
    }
    EXPECT_EQ(reader->sha256(), archive.sha256);
    return rows;
  }

  std::uint64_t last_ = 0;
};

TEST_F(RetentionTest, LeavesWhatAReaderHasNotGot) {
  ASSERT_TRUE(store_->record_readers.begin("mqtt", clock_.now()));
  print(25);
  clock_.advance(std::chrono::hours(48));
  Retention::Options options;
  options.records = {.age = std::chrono::hours(24), .rows = {}};
  Retention retention({.store = *store_,
                       .clock = clock_,
                       .folder = archives(),
                       .database = "db",
                       .made_by = "test",
                       .reader = "mqtt"},
                      options);
  EXPECT_EQ(apply(retention), 0u);
  ASSERT_TRUE(store_->record_readers.advance("mqtt", {{"lathe-1", 7, 11}}));
  EXPECT_EQ(apply(retention), 1u);
  EXPECT_EQ(stored().front(), 12u);
  ASSERT_TRUE(store_->record_readers.advance("mqtt", {{"lathe-1", 7, 25}}));
  EXPECT_EQ(apply(retention), 1u);
  EXPECT_TRUE(stored().empty());
}

TEST_F(RetentionTest, MovesWhatIsOldIntoArchives) {
  print(25);
  clock_.advance(std::chrono::hours(23));
  auto retention = make({.age = std::chrono::hours(24), .rows = {}});
  EXPECT_EQ(apply(retention), 0u) << "25 minutes are not a day";
  clock_.advance(std::chrono::minutes(48));
  EXPECT_EQ(apply(retention), 2u);
  ASSERT_EQ(stored().size(), 12u);
  EXPECT_EQ(stored().front(), 14u);
  const auto list = retention.list({}).value();
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1].first, 1u);
  EXPECT_EQ(list[1].rows, 10u);
  EXPECT_TRUE(list[1].is_removed);
  const auto rows = rows_of(list[1]);
  ASSERT_EQ(rows.size(), 10u);
  EXPECT_EQ(rows[3]["text"], "X4");
  EXPECT_EQ(rows[3]["number"], 4);
  EXPECT_EQ(apply(retention), 0u);
}

TEST_F(RetentionTest, KeepsTheNewestRows) {
  print(25);
  auto retention = make({.age = {}, .rows = 12});
  EXPECT_EQ(apply(retention), 2u);
  EXPECT_EQ(stored().size(), 12u);
  EXPECT_EQ(stored().back(), 25u);
}

TEST_F(RetentionTest, LeavesRunsThatGoOnAndWhatAControlKeeps) {
  print(2, "", "message");
  print(5);
  const auto revision = push("O1", "O1\nM30\n");
  ASSERT_TRUE(store_->runs.create(run_of(revision, "r1")));
  print(5, "r1");
  clock_.advance(std::chrono::hours(100));
  auto retention = make({.age = std::chrono::hours(24), .rows = {}});
  EXPECT_EQ(apply(retention), 1u);
  EXPECT_EQ(stored(), (std::vector<std::uint64_t>{1, 2, 8, 9, 10, 11, 12}));
  ASSERT_TRUE(store_->runs.set_state("r1", storage::RunState::Aborted, "test"));
  EXPECT_EQ(apply(retention), 1u);
  EXPECT_EQ(stored(), (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(RetentionTest, WritesTheDigestIntoTheAuditTrail) {
  print(5);
  clock_.advance(std::chrono::hours(100));
  auto retention = make({.age = std::chrono::hours(24), .rows = {}});
  ASSERT_EQ(retention.apply(), 1u);
  const auto entry = store_->audit.list({.limit = 1})->front();
  EXPECT_EQ(entry.action, "archive.create");
  EXPECT_NE(entry.detail.find(retention.list({})->front().sha256.hex()), std::string::npos);
}

/// A kill between the archive's row and the end of the removal.
TEST_F(RetentionTest, FinishesWhatALastServerBegan) {
  print(5);
  clock_.advance(std::chrono::hours(100));
  {
    auto retention = make({.age = std::chrono::hours(24), .rows = {}});
    ASSERT_EQ(retention.apply(), 1u);
  }
  storage::Archive again = store_->archives.list({})->front();
  print(4);
  again.first = 6;
  again.last = 9;
  again.file = "copy";
  std::filesystem::copy_file(archives() / store_->archives.list({})->front().file,
                             archives() / "copy");
  ASSERT_TRUE(store_->archives.add(again, "test"));
  auto retention = make({});
  EXPECT_EQ(apply(retention), 0u);
  EXPECT_TRUE(stored().empty());
  EXPECT_TRUE(store_->archives.unremoved()->empty());
}

TEST_F(RetentionTest, RemovesNothingWithoutTheFile) {
  print(5);
  storage::Archive lost{.machine = "lathe-1", .epoch = 7, .first = 1, .last = 5, .file = "lost"};
  ASSERT_TRUE(store_->archives.add(lost, "test"));
  auto retention = make({});
  EXPECT_EQ(retention.apply().error().code, Errc::Corrupt);
  EXPECT_EQ(stored().size(), 5u);
}

TEST_F(RetentionTest, MovesEndedPartsWithTheirMeasurements) {
  ASSERT_TRUE(store_->report_templates.push(
      {.name = "bore", .version = 0, .text = "x", .author = "a", .created = clock_.now()}, "a"));
  print(3);
  storage::DerivedBatch batch;
  batch.machine = "lathe-1";
  batch.epoch = 7;
  batch.through = 3;
  for (std::uint64_t id = 1; id <= 3; ++id) {
    storage::MeasuredPart part;
    part.id = id;
    part.machine = "lathe-1";
    part.template_name = "bore";
    part.template_version = 1;
    part.begun = clock_.now();
    if (id < 3) part.ended = clock_.now();
    batch.parts.push_back(part);
    measurement::Measurement value;
    value.part_id = id;
    value.characteristic.name = "D";
    value.actual = 40 + static_cast<double>(id);
    value.time = clock_.now();
    value.record = {7, id};
    batch.measurements.push_back(value);
  }
  batch.findings = {{.machine = "lathe-1",
                     .run = {},
                     .part_id = 1,
                     .record = {7, 1},
                     .time = clock_.now(),
                     .kind = "doubled",
                     .text = "x"}};
  ASSERT_TRUE(store_->measurements.commit(batch));
  clock_.advance(std::chrono::hours(100));
  auto retention = make({}, {.age = std::chrono::hours(24), .rows = {}});
  EXPECT_EQ(apply(retention), 1u);
  EXPECT_EQ(store_->measurements.list({}, {}, 10)->size(), 1u);
  EXPECT_EQ(store_->measurements.part(1).error().code, Errc::NotFound);
  EXPECT_TRUE(store_->measurements.part(3)) << "it has not ended";
  const auto rows = rows_of(retention.list({})->front());
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0]["part"]["id"], 1);
  EXPECT_EQ(rows[1]["measurement"]["actual"], 41);
  EXPECT_EQ(rows[2]["finding"]["kind"], "doubled");
}

/// Parts and findings are rows of the file, but not what the rule counts: one file, not ever
/// smaller ones.
TEST_F(RetentionTest, MovesAllMeasurementsThatAreTooManyIntoOneArchive) {
  ASSERT_TRUE(store_->report_templates.push(
      {.name = "bore", .version = 0, .text = "x", .author = "a", .created = clock_.now()}, "a"));
  print(6);
  storage::DerivedBatch batch;
  batch.machine = "lathe-1";
  batch.epoch = 7;
  batch.through = 6;
  for (std::uint64_t id = 1; id <= 6; ++id) {
    storage::MeasuredPart part;
    part.id = id;
    part.machine = "lathe-1";
    part.template_name = "bore";
    part.template_version = 1;
    part.begun = clock_.now();
    part.ended = clock_.now();
    batch.parts.push_back(part);
    measurement::Measurement value;
    value.part_id = id;
    value.characteristic.name = "D";
    value.time = clock_.now();
    value.record = {7, id};
    batch.measurements.push_back(value);
  }
  ASSERT_TRUE(store_->measurements.commit(batch));
  auto retention = make({}, {.age = {}, .rows = 2});
  EXPECT_EQ(apply(retention), 1u);
  EXPECT_EQ(store_->measurements.list({}, {}, 10)->size(), 2u);
  EXPECT_EQ(rows_of(retention.list({})->front()).size(), 8u);
}

}  // namespace
}  // namespace dripline::library
