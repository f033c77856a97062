#pragma once

#include <condition_variable>
#include <mutex>

#include "server/measurements/measurements.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::measurements {

/// Measurements over a real store; verdicts and holds are noted.
class MeasurementsTest : public server_test::ServerTest {
 protected:
  MeasurementsTest() {
    add_machine("lathe-1");
    add_machine("lathe-2");
    revision_ = push("O0100", "O0100\nM30\n");
  }
  ~MeasurementsTest() override { measurements_.reset(); }

  void start() {
    measurements_.reset();
    measurements_ = std::make_unique<Measurements>(Measurements::Parts{
        .store = *store_,
        .clock = clock_,
        .on_part =
            [this](const storage::MeasuredPart& part) {
              const std::lock_guard lock(mutex_);
              judged_.push_back(fmt::format("{} {}{}", part.serial,
                                            measurement::to_string(part.verdict),
                                            part.ended ? "" : " so far"));
            },
        .on_derived = [this](const std::string& machine) { derived_again_.push_back(machine); },
        .hold_queue = [this](const auto& part,
                             const auto& why) { return hold("queue", part, why); },
        .hold_machine = [this](const auto& part,
                               const auto& why) { return hold("machine", part, why); },
        .retry = std::chrono::milliseconds(20)});
    measurements_->begin();
  }
  void use(const std::string& toml, storage::TemplateScope scope = storage::TemplateScope::Program,
           const std::string& subject = "O0100") {
    const auto pushed = measurements_->push("bore", toml, "anna");
    ASSERT_TRUE(pushed) << pushed.error().what;
    const auto assigned =
        measurements_->assign({.scope = scope, .subject = subject, .name = "bore"}, "anna");
    ASSERT_TRUE(assigned) << assigned.error().what;
  }
  void make_run(const std::string& id, const std::string& machine = "lathe-1") {
    Run run = run_of(revision_, id);
    run.machine = machine;
    ASSERT_TRUE(store_->runs.create(run));
  }
  /// Stores lines of a run; `run_started` and `run_ended` are records of these kinds.
  void print(const std::vector<std::string>& lines, const std::string& run = "r1",
             const std::string& machine = "lathe-1",
             storage::RunState state = storage::RunState::Completed) {
    storage::RecordBatch batch;
    batch.machine = machine;
    batch.epoch = 7;
    for (const auto& line : lines) {
      storage::Record record;
      record.machine = machine;
      record.epoch = 7;
      record.number = ++numbers_[machine];
      record.time = clock_.now();
      record.run = run;
      record.kind = line.starts_with("run_") ? line : "output";
      record.device = "port1";
      record.text = line;
      batch.records.push_back(record);
      if (line == "run_ended") {
        storage::RunEnding ending;
        ending.run = run;
        ending.state = state;
        ending.ended = clock_.now();
        batch.endings.push_back(std::move(ending));
      }
    }
    const auto stored = store_->records.store(batch);
    ASSERT_TRUE(stored) << stored.error().what;
    if (measurements_) measurements_->note();
  }
  void wait_until_derived() {
    const auto waited = measurements_->wait(std::chrono::seconds(60));
    ASSERT_TRUE(waited) << waited.error().what;
  }
  std::vector<measurement::Measurement> all(const storage::MeasurementFilter& filter = {}) {
    return store_->measurements.list(filter, {}, 1000).value();
  }
  std::vector<std::string> findings(const storage::PartFilter& filter = {}) {
    std::vector<std::string> texts;
    const auto rows = store_->measurements.findings(filter, {});
    EXPECT_TRUE(rows);
    for (const auto& row : *rows) texts.push_back(row.kind + ": " + row.text);
    return texts;
  }
  std::vector<std::string> judged() {
    const std::lock_guard lock(mutex_);
    return judged_;
  }
  /// As soon as so many were held.
  std::vector<std::string> held(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(60), [&] { return held_.size() >= count; }));
    return held_;
  }

  Result<void> hold(const char* what, const storage::MeasuredPart& part,
                    const std::string& reason) {
    const std::lock_guard lock(mutex_);
    held_.push_back(fmt::format("{} of {}: {}", what, part.machine, reason));
    changed_.notify_all();
    return {};
  }

  storage::Revision revision_;
  std::map<std::string, std::uint64_t> numbers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> judged_, held_;
  std::vector<std::string> derived_again_;  ///< machines, of each time
  std::unique_ptr<Measurements> measurements_;
};

inline constexpr const char* kBore = R"(
[[line]]
form = "PART {serial}"
starts_part = true
[[line]]
form = "D {actual}"
characteristic = "D"
nominal = 40
tolerance = 0.02
rework = "below"
[verdict]
rework = "hold_queue"
scrap = "hold_machine"
)";

}  // namespace dripline::measurements
