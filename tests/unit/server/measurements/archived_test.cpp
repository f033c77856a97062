#include "server/library/history/retention.hpp"
#include "tests/unit/server/measurements/measurements_fixture.hpp"

namespace dripline::measurements {
namespace {

/// Derives runs again whose records are in archives.
class ArchivedMeasurements : public MeasurementsTest {
 protected:
  ArchivedMeasurements() { std::filesystem::create_directory(folder_.path() / "archives"); }

  void archive(const library::RetentionRule& records,
               const library::RetentionRule& measurements = {}) {
    library::Retention::Options options;
    options.records = records;
    options.measurements = measurements;
    library::Retention retention({.store = *store_,
                                  .clock = clock_,
                                  .folder = folder_.path() / "archives",
                                  .database = "db",
                                  .made_by = "test"},
                                 options);
    const auto made = retention.apply();
    ASSERT_TRUE(made) << made.error().what;
    EXPECT_EQ(*made, 1u);
  }
  void expect_refused(const std::string& run) {
    const auto again = measurements_->derive(run, {}, {});
    ASSERT_FALSE(again) << run;
    EXPECT_EQ(again.error().code, Errc::Conflict);
    EXPECT_NE(again.error().what.find("the archive records-lathe-1-7-"), std::string::npos)
        << again.error().what;
  }
  static constexpr library::RetentionRule kOld{.age = std::chrono::hours(24), .rows = {}};
};

/// The records that are left would give fewer measurements than there are.
TEST_F(ArchivedMeasurements, AreNotDerivedAgain) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40", "D 40.001"});
  clock_.advance(std::chrono::hours(1));
  print({"PART 2", "D 40", "run_ended"});
  wait_until_derived();
  ASSERT_TRUE(measurements_->derive("r1", {}, {})) << "as long as all its records are there";
  archive({.age = {}, .rows = 3});
  expect_refused("r1");
  EXPECT_EQ(all({.run = "r1"}).size(), 3u) << "what was measured stays";
  EXPECT_EQ(store_->measurements.parts({.run = "r1"}, {})->size(), 2u);
  clock_.advance(std::chrono::hours(48));
  make_run("r2");
  print({"PART 3", "D 40", "run_ended"}, "r2");
  wait_until_derived();
  archive(kOld);
  expect_refused("r1");
  archive({}, kOld);
  EXPECT_TRUE(all({.run = "r1", .with_superseded = true}).empty());
  expect_refused("r1");
  const auto later = measurements_->derive("r2", {}, {});
  EXPECT_TRUE(later) << "archives of earlier records do not matter: " << later.error().what;
}

/// The clock of a gateway was an hour late: by the times the archive is of before the run.
TEST_F(ArchivedMeasurements, AreKnownByTheirRecords) {
  start();
  use(kBore);
  Run run = run_of(revision_, "r1");
  run.created += std::chrono::hours(1);
  ASSERT_TRUE(store_->runs.create(run));
  print({"PART 1", "D 40", "D 40.001", "run_ended"});
  wait_until_derived();
  archive({.age = {}, .rows = 2});
  expect_refused("r1");
}

}  // namespace
}  // namespace dripline::measurements
