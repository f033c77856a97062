#pragma once

#include <utility>

#include "server/offsets/offsets.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::offsets {

/// A lathe whose parts are measured: each a run of its own under the newest setup.
class OffsetsTest : public server_test::ServerTest {
 protected:
  static constexpr const char* kSetup =
      "units = \"mm\"\n\n[[tool]]\nnumber = 3\nwear = { X = 0.1 }  # by hand\n";
  static constexpr const char* kRules =
      "[[rule]]\nname = \"D40\"\ncharacteristic = \"D40\"\ntarget = \"T3.wear.X\"\nscale = 0.5\n"
      "gain = 1.0\ndead_band = 0.004\nmax_step = 0.05\nmin_count = 3\n";

  OffsetsTest() {
    add_machine("lathe-1");
    revision_ = push("O0100", "O0100\nM30\n");
    for (const char* name : {"bore", "gauge"}) {
      EXPECT_TRUE(store_->report_templates.push(
          {.name = name, .version = 0, .text = "x", .author = "anna", .created = clock_.now()},
          "anna"));
    }
    save_setup(kSetup);
    start();
  }

  void start() {
    offsets_ = std::make_unique<Offsets>(Offsets::Parts{
        .store = *store_,
        .setups = *setups_,
        .clock = clock_,
        .on_change = [this](const auto& proposal) { changes_.push_back(proposal); }});
  }
  storage::SetupRevision save_setup(const std::string& text, const std::string& comment = "first") {
    const auto saved = setups_->save(
        {.machine = "lathe-1", .control = "centurion", .text = text, .comment = comment}, "meyer");
    EXPECT_TRUE(saved) << saved.error().what;
    return saved ? saved->setup : storage::SetupRevision{};
  }
  void use_rules(const std::string& added = "") {
    const auto saved = offsets_->save_rules("lathe-1", kRules + added, "anna");
    ASSERT_TRUE(saved) << saved.error().what;
  }
  /// A run that measures one part.
  std::string measure(double actual) {
    ++measured_;
    Run run = run_of(revision_, fmt::format("run-{}", measured_));
    const auto setup = store_->setups.find("lathe-1", std::nullopt);
    if (setup) run.setup = setup->number;
    EXPECT_TRUE(store_->runs.create(run));
    storage::Record record;
    record.machine = "lathe-1";
    record.epoch = 7;
    record.number = measured_;
    record.time = clock_.now() + std::chrono::seconds(measured_);
    record.run = run.id;
    record.kind = "output";
    EXPECT_TRUE(store_->records.store(
        {.machine = "lathe-1", .epoch = 7, .records = {record}, .beginnings = {}, .endings = {}}));
    EXPECT_TRUE(store_->runs.set_state(run.id, storage::RunState::Completed, ""));
    commit(record, actual);
    return run.id;
  }
  storage::OffsetProposal only_proposal() {
    const auto looked = offsets_->look("lathe-1");
    EXPECT_TRUE(looked) << looked.error().what;
    if (!looked || looked->size() != 1 || !looked->front().proposal) {
      ADD_FAILURE() << "no proposal";
      return {};
    }
    return *looked->front().proposal;
  }
  double wear() {
    const auto setup = store_->setups.find("lathe-1", std::nullopt);
    return value_in_setup(setup->text, parse_setup_target("T3.wear.X").value()).value();
  }
  std::vector<storage::OffsetProposal> all(std::optional<storage::OffsetState> state = {}) {
    return store_->offsets.list({.machine = {}, .target = {}, .state = state}, {}).value();
  }
  std::filesystem::path file() const { return folder_.path() / "store.sqlite"; }

  storage::Revision revision_;
  std::uint64_t measured_ = 0;
  std::string program_ = "O0100", template_ = "bore", tool_ = "T3";  ///< of what is measured
  std::vector<storage::OffsetProposal> changes_;
  std::unique_ptr<Offsets> offsets_;

 private:
  void commit(const storage::Record& record, double actual) {
    storage::MeasuredPart part;
    part.id = record.number;
    part.machine = "lathe-1";
    part.run = record.run;
    part.program = program_;
    part.revision = 1;
    part.template_name = template_;
    part.template_version = 1;
    part.measurements = 1;
    part.verdict = measurement::Verdict::Good;
    part.begun = record.time;
    part.ended = record.time;
    measurement::Measurement m;
    m.part_id = part.id;
    m.characteristic = {.name = "D40", .nominal = 40, .lower = 39.95, .upper = 40.05};
    m.actual = actual;
    m.tool = tool_;
    m.time = record.time;
    m.record = {record.epoch, record.number};
    m.verdict = measurement::Verdict::Good;
    storage::DerivedBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 7;
    batch.after = std::exchange(through_, record.number);
    batch.through = record.number;
    batch.parts = {part};
    batch.measurements = {m};
    const auto done = store_->measurements.commit(batch);
    EXPECT_TRUE(done) << done.error().what;
  }

  std::uint64_t through_ = 0;  ///< the last record that was measured from
};

}  // namespace dripline::offsets
