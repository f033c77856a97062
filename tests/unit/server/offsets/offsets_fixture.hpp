#pragma once

#include <map>
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
    Run run = run_of(revision_, fmt::format("run-{}", measured_ + 1));
    const auto setup = store_->setups.find("lathe-1", std::nullopt);
    if (setup && has_setup_) run.setup = setup->number;
    EXPECT_TRUE(store_->runs.create(run));
    measure_in(run.id, actual);
    EXPECT_TRUE(store_->runs.set_state(run.id, storage::RunState::Completed, ""));
    return run.id;
  }
  /// One more part of a run.
  void measure_in(const std::string& run, double actual) {
    ++measured_;
    storage::Record record;
    record.machine = "lathe-1";
    record.epoch = 7;
    record.number = measured_;
    record.time = clock_.now() + std::chrono::seconds(measured_);
    record.run = run;
    record.kind = "output";
    EXPECT_TRUE(store_->records.store(
        {.machine = "lathe-1", .epoch = 7, .records = {record}, .beginnings = {}, .endings = {}}));
    commit(record, actual);
  }
  /// As another template reads the run: what was measured is superseded.
  void derive_again(const std::string& run, double actual) {
    const storage::Record record = records_.at(run);
    const auto done = store_->measurements.replace(run, batch_of(record, actual));
    EXPECT_TRUE(done) << done.error().what;
  }
  /// Evaluates, expects nothing to be proposed, and returns the reasons.
  std::string why_nothing() {
    const auto looked = offsets_->look("lathe-1");
    EXPECT_TRUE(looked) << looked.error().what;
    if (!looked || looked->size() != 1) return {};
    EXPECT_FALSE(looked->front().proposal);
    return fmt::format("{}", fmt::join(looked->front().outcome.reasons, "\n"));
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
  std::string part_, unit_ = "mm";
  measurement::Verdict verdict_ = measurement::Verdict::Good;  ///< of the part
  std::uint64_t findings_ = 0;
  std::string finding_ = "doubled";  ///< their kind
  bool has_setup_ = true;            ///< the server's, of a run
  bool is_ended_ = true;             ///< the part
  std::vector<storage::OffsetProposal> changes_;
  std::unique_ptr<Offsets> offsets_;

 private:
  void commit(const storage::Record& record, double actual) {
    const auto done = store_->measurements.commit(batch_of(record, actual));
    EXPECT_TRUE(done) << done.error().what;
  }
  storage::DerivedBatch batch_of(const storage::Record& record, double actual) {
    records_[record.run] = record;
    storage::MeasuredPart part;
    part.id = store_->measurements.next_part_id().value_or(0);
    part.machine = "lathe-1";
    part.run = record.run;
    part.program = program_;
    part.revision = 1;
    part.template_name = template_;
    part.template_version = 1;
    part.measurements = 1;
    part.number = part_;
    part.findings = findings_;
    part.verdict = verdict_;
    part.begun = record.time;
    if (is_ended_) part.ended = record.time;
    measurement::Measurement m;
    m.part_id = part.id;
    m.characteristic = {
        .name = "D40", .nominal = 40, .lower = 39.95, .upper = 40.05, .unit = unit_};
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
    for (std::uint64_t i = 0; i < findings_; ++i) {
      storage::ReportFinding finding;
      finding.machine = batch.machine;
      finding.run = record.run;
      finding.part_id = part.id;
      finding.record = m.record;
      finding.time = record.time;
      finding.kind = finding_;
      batch.findings.push_back(finding);
    }
    return batch;
  }

  std::map<std::string, storage::Record> records_;  ///< the newest of each run
  std::uint64_t through_ = 0;                       ///< the last record that was measured from
};

}  // namespace dripline::offsets
