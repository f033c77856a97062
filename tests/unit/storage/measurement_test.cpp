#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

using measurement::Measurement;
using measurement::Verdict;

class Measurements : public ContractTest {
 protected:
  Measurements() { assign(); }

  void assign() {
    ASSERT_TRUE(store_->report_templates.push(
        {.name = "bore", .version = 0, .text = "x", .author = "anna", .created = clock_.now()},
        "anna"));
  }
  void add_records(std::uint64_t first, std::uint64_t last) {
    ASSERT_TRUE(store_->records.store(make_batch(first, last)));
  }
  MeasuredPart part(std::uint64_t id, const std::string& machine = "m1") {
    MeasuredPart made;
    made.id = id;
    made.machine = machine;
    made.run = "r1";
    made.program = "p.nc";
    made.revision = 1;
    made.template_name = "bore";
    made.template_version = 1;
    made.serial = fmt::format("S{}", id);
    made.verdict = Verdict::Good;
    made.begun = clock_.now();
    return made;
  }
  Measurement value(std::uint64_t number, double actual, const std::string& name = "D") {
    Measurement made;
    made.part_id = 1;
    made.characteristic = {.name = name, .nominal = 40, .lower = 39.98, .upper = 40.02};
    made.actual = actual;
    made.tool = "T3";
    made.time = clock_.now() + std::chrono::seconds(number);
    made.record = {.epoch = kEpoch, .number = number};
    made.verdict = Verdict::Good;
    return made;
  }
  DerivedBatch batch(std::uint64_t after, std::uint64_t through) {
    DerivedBatch made;
    made.machine = "m1";
    made.epoch = kEpoch;
    made.after = after;
    made.through = through;
    made.state = fmt::format("after {}", through);
    return made;
  }
  /// A batch with a part and one value of each of these numbers.
  DerivedBatch values(std::uint64_t after, std::uint64_t through) {
    DerivedBatch made = batch(after, through);
    made.parts = {part(1)};
    for (std::uint64_t n = after + 1; n <= through; ++n)
      made.measurements.push_back(value(n, 40 + 0.001 * static_cast<double>(n)));
    return made;
  }
  std::vector<Measurement> all(const MeasurementFilter& filter = {}) {
    auto rows = store_->measurements.list(filter, {}, 1000);
    EXPECT_TRUE(rows) << rows.error().what;
    return rows.value_or(std::vector<Measurement>());
  }

  static inline const std::uint64_t kEpoch = make_batch(1, 1).epoch;
};

TEST_P(Measurements, AreStoredWithTheirCursor) {
  make_run("r1");
  add_records(1, 3);
  ASSERT_EQ(store_->measurements.underived()->size(), 1u);
  EXPECT_EQ(store_->measurements.underived()->front().last, 3u);
  ASSERT_TRUE(store_->measurements.commit(values(0, 3)));
  EXPECT_TRUE(store_->measurements.underived()->empty());
  reopen();
  EXPECT_EQ(store_->measurements.state("m1"), "after 3");
  EXPECT_EQ(store_->measurements.next_part_id(), 2u);
  const auto rows = all();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].characteristic, value(2, 0).characteristic);
  EXPECT_EQ(rows[1].actual, 40.002);
  EXPECT_EQ(rows[1].tool, "T3");
  EXPECT_EQ(rows[1].serial, "S1");
  EXPECT_EQ(rows[1].run, "r1");
  EXPECT_EQ(rows[1].record, (measurement::RecordKey{kEpoch, 2}));
  EXPECT_EQ(rows[1].time, value(2, 0).time);
  EXPECT_EQ(query("SELECT count(*) FROM characteristic"), 1);
}

TEST_P(Measurements, AreDerivedOnce) {
  make_run("r1");
  add_records(1, 4);
  ASSERT_TRUE(store_->measurements.commit(values(0, 3)));
  EXPECT_EQ(store_->measurements.commit(values(0, 3)).error().code, Errc::Conflict);
  EXPECT_EQ(store_->measurements.commit(values(2, 4)).error().code, Errc::Conflict);
  // Also if a cursor says otherwise: the record's place is taken.
  damage("UPDATE measurement_cursor SET number = 0");
  EXPECT_EQ(store_->measurements.commit(values(0, 4)).error().code, Errc::Conflict);
  EXPECT_EQ(all().size(), 3u);
  EXPECT_EQ(store_->measurements.state("m1"), "after 3") << "nothing of it stays";
}

TEST_P(Measurements, PassOverWhatWasThereBeforeTheFirstAssignment) {
  make_run("r1");
  add_records(1, 3);
  const TemplateAssignment for_p{
      .scope = TemplateScope::Program, .subject = "p.nc", .name = "bore"};
  ASSERT_TRUE(store_->report_templates.assign(for_p, "anna"));
  EXPECT_TRUE(store_->measurements.underived()->empty());
  add_records(4, 5);
  // Another one is no reason to pass over what waits.
  ASSERT_TRUE(store_->report_templates.assign(
      {.scope = TemplateScope::Machine, .subject = "m1", .name = "bore"}, "anna"));
  ASSERT_EQ(store_->measurements.underived()->size(), 1u);
  EXPECT_EQ(store_->measurements.underived()->front().derived, 3u);
}

TEST_P(Measurements, AreFoundByMachineCharacteristicAndTime) {
  make_run("r1");
  add_records(1, 20);
  DerivedBatch some = values(0, 10);
  for (std::uint64_t n = 11; n <= 20; ++n) some.measurements.push_back(value(n, 1, "X"));
  some.through = 20;
  some.measurements.back().verdict = Verdict::Scrap;
  ASSERT_TRUE(store_->measurements.commit(some));
  const auto at = [&](int second) { return clock_.now() + std::chrono::seconds(second); };
  EXPECT_EQ(all({.characteristic = "D"}).size(), 10u);
  EXPECT_EQ(all({.characteristic = "never"}).size(), 0u);
  EXPECT_EQ(all({.machine = "m2"}).size(), 0u);
  EXPECT_EQ(all({.machine = "m1", .characteristic = "X"}).size(), 10u);
  EXPECT_EQ(all({.machine = "m1", .since = at(5), .until = at(8)}).size(), 3u);
  EXPECT_EQ(all({.run = "r1", .characteristic = "X"}).size(), 10u);
  EXPECT_EQ(all({.run = "r2"}).size(), 0u);
  EXPECT_EQ(all({.part_id = 1}).size(), 20u);
  EXPECT_EQ(all({.verdict = Verdict::Scrap}).size(), 1u);
  EXPECT_EQ(all({.verdict = Verdict::Good}).size(), 19u);
  EXPECT_EQ(store_->measurements.characteristics("m1"), (std::vector<std::string>{"D", "X"}));
  EXPECT_EQ(store_->measurements.characteristics("m2")->size(), 0u);
}

TEST_P(Measurements, AreListedInPagesBothWays) {
  make_run("r1");
  add_records(1, 25);
  ASSERT_TRUE(store_->measurements.commit(values(0, 25)));
  for (const MeasurementFilter& filter :
       {MeasurementFilter{}, MeasurementFilter{.characteristic = "D"},
        MeasurementFilter{.run = "r1"}}) {
    std::vector<std::uint64_t> up, down;
    std::optional<MeasurementPlace> place;
    for (;;) {
      const auto rows = store_->measurements.list(filter, place, 10);
      for (const auto& row : *rows) up.push_back(row.record.number);
      if (rows->size() < 10) break;
      place = MeasurementPlace{rows->back().time, rows->back().id};
    }
    place.reset();
    for (;;) {
      const auto rows = store_->measurements.list_newest(filter, place, 10);
      for (const auto& row : *rows) down.push_back(row.record.number);
      if (rows->size() < 10) break;
      place = MeasurementPlace{rows->back().time, rows->back().id};
    }
    ASSERT_EQ(up.size(), 25u);
    EXPECT_TRUE(std::ranges::is_sorted(up));
    EXPECT_EQ(down, std::vector<std::uint64_t>(up.rbegin(), up.rend()));
  }
}

TEST_P(Measurements, StayWhenARunIsDerivedAgain) {
  make_run("r1");
  add_records(1, 3);
  DerivedBatch first = values(0, 3);
  first.findings = {{.machine = "m1",
                     .run = "r1",
                     .part_id = 1,
                     .record = {kEpoch, 2},
                     .time = clock_.now(),
                     .kind = "unmatched",
                     .text = "X2"}};
  ASSERT_TRUE(store_->measurements.commit(first));
  DerivedBatch again = batch(0, 0);
  again.parts = {part(2)};
  again.parts[0].verdict = Verdict::Scrap;
  again.measurements = {value(1, 41)};
  again.measurements[0].part_id = 2;
  ASSERT_TRUE(store_->measurements.replace("r1", again));
  EXPECT_EQ(all({.run = "r1"}).size(), 1u);
  EXPECT_EQ(all({.run = "r1", .with_superseded = true}).size(), 4u);
  EXPECT_EQ(store_->measurements.parts({.run = "r1"}, {})->size(), 1u);
  EXPECT_EQ(store_->measurements.parts({.run = "r1", .with_superseded = true}, {})->size(), 2u);
  EXPECT_TRUE(store_->measurements.part(1)->is_superseded);
  EXPECT_TRUE(store_->measurements.findings({.run = "r1"}, {})->empty());
  EXPECT_EQ(store_->measurements.state("m1"), "after 3") << "untouched";
  const auto counts = store_->measurements.parts_of_run("r1")->verdicts;
  EXPECT_EQ(counts[static_cast<std::size_t>(Verdict::Scrap)], 1u);
  EXPECT_EQ(counts[static_cast<std::size_t>(Verdict::Good)], 0u);
}

TEST_P(Measurements, UpdateTheirPart) {
  make_run("r1");
  add_records(1, 4);
  ASSERT_TRUE(store_->measurements.commit(values(0, 2)));
  DerivedBatch more = batch(2, 4);
  more.parts = {part(1)};
  more.parts[0].measurements = 4;
  more.parts[0].ended = clock_.now();
  more.parts[0].verdict = Verdict::Rework;
  ASSERT_TRUE(store_->measurements.commit(more));
  const auto found = store_->measurements.part(1);
  EXPECT_EQ(found->measurements, 4u);
  EXPECT_EQ(found->verdict, Verdict::Rework);
  EXPECT_TRUE(found->ended);
  EXPECT_EQ(store_->measurements.part(9).error().code, Errc::NotFound);
  EXPECT_EQ(store_->measurements.parts({.verdict = Verdict::Rework}, {})->size(), 1u);
  EXPECT_EQ(store_->measurements.parts({.machine = "m1", .verdict = Verdict::Good}, {})->size(),
            0u);
}

TEST_P(Measurements, KeepVersionsOfTemplates) {
  auto& templates = store_->report_templates;
  const auto push = [&](const std::string& text) {
    return templates
        .push({.name = "bore", .version = 0, .text = text, .author = "anna", .created = {}}, "anna")
        ->version;
  };
  EXPECT_EQ(push("x"), 1u) << "the same text is no new version";
  EXPECT_EQ(push("y"), 2u);
  EXPECT_EQ(templates.find("bore", {})->text, "y");
  EXPECT_EQ(templates.find("bore", 1)->text, "x");
  EXPECT_EQ(templates.find("bore", 3).error().code, Errc::NotFound);
  EXPECT_EQ(templates.list()->size(), 1u);
  EXPECT_EQ(
      templates.assign({.subject = "p.nc", .name = "bore", .version = 3}, "anna").error().code,
      Errc::NotFound);
  ASSERT_TRUE(templates.assign({.subject = "p.nc", .name = "bore", .version = 1}, "anna"));
  EXPECT_EQ(templates.assignments()->front().version, 1u);
  ASSERT_TRUE(templates.remove("bore", "anna", clock_.now()));
  EXPECT_TRUE(templates.list()->empty());
  EXPECT_TRUE(templates.assignments()->empty());
  EXPECT_EQ(templates.find("bore", {}).error().code, Errc::NotFound);
  EXPECT_EQ(templates.find("bore", 2)->text, "y") << "its measurements name it";
  EXPECT_EQ(push("y"), 3u) << "it comes back";
  EXPECT_EQ(store_->audit.list({.limit = 1})->front().action, "report_template.push");
}

/// A report of any length is read from where the last piece ended.
TEST_P(Measurements, LeaveRecordsToBeReadInPieces) {
  make_run("r1");
  add_records(1, 30);
  std::vector<std::uint64_t> numbers;
  RecordPlace place;
  for (;;) {
    const auto records = store_->records.of_run_after("r1", "output", place, 7);
    ASSERT_TRUE(records) << records.error().what;
    for (const auto& record : *records) numbers.push_back(record.number);
    if (records->size() < 7) break;
    place = {records->back().epoch, records->back().number};
  }
  EXPECT_EQ(numbers.size(), 30u);
  EXPECT_TRUE(std::ranges::is_sorted(numbers));
  EXPECT_EQ(store_->records.of_machine_after("m1", {kEpoch, 28}, 10)->size(), 2u);
  EXPECT_EQ(store_->records.of_machine_after("m2", {kEpoch, 0}, 10)->size(), 0u);
}

ON_BOTH_ENGINES(Measurements);

}  // namespace
}  // namespace dripline::storage
