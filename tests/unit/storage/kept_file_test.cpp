#include <fstream>
#include <sstream>

#include "protocol/audit/verifier.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// Opens the kept file of an older version (tests/golden/storage) as the server would.
class KeptFile : public StoreTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    new_schema_ = schema_of(options_.file);
    std::stringstream sql;
    sql << std::ifstream(std::string("tests/golden/storage/") + GetParam()).rdbuf();
    options_.file = directory_ / "kept.sqlite";
    auto kept = sqlite::Database::open(options_.file);
    ASSERT_TRUE(kept) << kept.error().what;
    const auto loaded = kept->execute(sql.str());
    ASSERT_TRUE(loaded) << loaded.error().what;
    ASSERT_GT(kept->integer("PRAGMA user_version").value(), 0);
  }
  static int version() { return std::stoi(std::string(GetParam()).substr(1)); }
  static std::string schema_of(const std::filesystem::path& file) {
    auto database = sqlite::Database::open(file);
    return database
        ->text(
            "SELECT group_concat(sql, x'0a') FROM "
            "(SELECT sql FROM sqlite_schema ORDER BY type, name)")
        .value_or("no schema");
  }
  std::string new_schema_;
};

TEST_P(KeptFile, BecomesTheSchemaOfANewFile) {
  reopen();
  EXPECT_EQ(schema_of(options_.file), new_schema_) << "a released migration was edited?";
}

TEST_P(KeptFile, KeepsEverythingInIt) {
  reopen();
  const auto run = store_->runs.find("r1");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->state, RunState::Completed);
  EXPECT_EQ(run->counters.executed, 2u);
  EXPECT_EQ(run->content_verified, true);
  EXPECT_EQ(run->outputs, 1u);
  EXPECT_EQ(pull(run->content), "G00 X1.\nM30\n");
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 2u);
  EXPECT_EQ(store_->programs.revision("gone.nc", std::nullopt).error().code, Errc::NotFound);
  const auto records = store_->records.of_run("r1", "", {});
  ASSERT_EQ(records->size(), 3u);
  EXPECT_EQ(records->at(1).text, "X2");
  EXPECT_EQ(store_->machines.find("m1")->last_record, 3u);
  EXPECT_EQ(store_->audit.list({})->back().action, "push");
}

TEST_P(KeptFile, CanBeGoneOnWith) {
  reopen();
  ASSERT_TRUE(store_->uploads.append("u1", 5, bytes_of("9.\n")));
  const auto revision = store_->uploads.commit("u1", sha256("G01 X9.\n"));
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(pull(revision->content), "G01 X9.\n");
  EXPECT_EQ(store_->records.store(make_batch(4, 6)), 6u);
  EXPECT_EQ(push("gone.nc", "M2\n")->number, 2u);
}

/// What came with a later version is there when the file is of that version.
TEST_P(KeptFile, HasPortsAndHeldRevisionsSinceVersion2) {
  reopen();
  const bool has_them = version() > 1;
  EXPECT_EQ(store_->ports.list()->size(), has_them ? 1u : 0u);
  EXPECT_EQ(store_->programs.list({})->at(0).held, has_them ? 1u : 0u);
  EXPECT_EQ(store_->programs.revision("p.nc", 3).has_value(), has_them);
  if (!has_them) return;
  EXPECT_TRUE(store_->programs.revision("p.nc", 3)->is_held);
  const auto port = store_->ports.list()->at(0);
  EXPECT_EQ(port.name, "line-1");
  ASSERT_EQ(port.settings.size(), 2u);
  EXPECT_EQ(port.settings[1].second, "xonxoff");
}

TEST_P(KeptFile, HasSetupsSinceVersion3) {
  reopen();
  const bool has_them = version() >= 3;
  EXPECT_EQ(store_->setups.list("m1", {})->size(), has_them ? 2u : 0u);
  EXPECT_EQ(store_->runs.find("r1")->setup.has_value(), has_them);
  if (!has_them) return;
  EXPECT_EQ(store_->setups.find("m1", 1)->text, "[[tool]]\nnumber = 4\n");
}

TEST_P(KeptFile, HasAccountsSinceVersion7) {
  reopen();
  const auto accounts = store_->accounts.load();
  ASSERT_TRUE(accounts) << accounts.error().what;
  const bool has_them = version() >= 7;
  EXPECT_EQ(accounts->users.size(), has_them ? 3u : 0u);
  EXPECT_EQ(accounts->credentials.size(), has_them ? 2u : 0u);
  EXPECT_EQ(accounts->groups.at(0).name, kAllMachines) << "always there";
  EXPECT_EQ(store_->audit.list({})->back().who.address, "");
  if (!has_them) return;
  const User& anna = accounts->users.at(1);
  EXPECT_EQ(anna.role, Role::Operator);
  EXPECT_EQ(anna.state, UserState::Locked);
  EXPECT_EQ(anna.groups, std::set<std::string>{"lathes"});
  EXPECT_EQ(accounts->users.at(2).state, UserState::Removed);
  EXPECT_EQ(accounts->groups.at(1).machines, std::set<std::string>{"m1"});
}

TEST_P(KeptFile, HasStatesOfRevisionsSinceVersion8) {
  reopen();
  const bool has_them = version() >= 8;
  const auto first = store_->programs.revision("p.nc", 1);
  EXPECT_EQ(first->state, has_them ? RevisionState::Withdrawn : RevisionState::Draft);
  EXPECT_EQ(store_->programs.revision("p.nc", 2)->state, RevisionState::Draft);
  EXPECT_EQ(store_->runs.find("r1")->allowed_as, RunAllowance::Open);
  const auto decisions = store_->releases.decisions("p.nc", 1);
  ASSERT_EQ(decisions->size(), has_them ? 1u : 0u);
  if (!has_them) return;
  EXPECT_EQ(decisions->front().comment, "scrap");
  const auto after = version() >= 25 ? std::optional<std::uint64_t>(4) : std::nullopt;
  EXPECT_EQ(first->withdrawn_after, after);
  EXPECT_EQ(first->was_withdrawn_for(store_->runs.find("r1")->number), version() < 25);
}

/// What was there before version 9 is chained when the file becomes one.
TEST_P(KeptFile, HasAChainOfItsEntriesAndRuns) {
  reopen();
  const auto entries = store_->audit.chained(0, 100);
  ASSERT_TRUE(entries) << entries.error().what;
  ASSERT_EQ(entries->size(), 2u);
  EXPECT_EQ(entries->at(1).entry.action, "run.end");
  EXPECT_EQ(entries->at(1).run_fault, "");
  // The test run of version 21 was put beside the others by rows alone: nothing reported its end.
  const auto without_end = version() >= 21 ? std::optional<std::string>("r3") : std::nullopt;
  EXPECT_EQ(store_->audit.run_without_end().value(), without_end);
  audit::Verifier verifier(store_->identity().value(), {});
  for (const auto& chained : *entries) verifier.take(chained.entry, chained.digest);
  EXPECT_FALSE(verifier.first_fault()) << verifier.first_fault()->what;
  const bool has_checkpoint = version() >= 9;
  EXPECT_EQ(store_->audit.checkpoints(0, 10)->size(), has_checkpoint ? 1u : 0u);
}

/// What waited before version 10 is left to a person, whatever the policy is.
TEST_P(KeptFile, HasAnImportQueue) {
  reopen();
  const auto waiting = store_->imports.list(true, {});
  ASSERT_EQ(waiting->size(), version() > 1 ? 1u : 0u);
  EXPECT_TRUE(store_->imports.uncompared(10)->empty());
  if (version() == 1) return;
  EXPECT_EQ(waiting->front().machine, "m1");
  ASSERT_TRUE(waiting->front().compared);
  EXPECT_EQ(waiting->front().compared->edit, version() >= 10 ? "geometry" : "");
  EXPECT_EQ(waiting->front().compared->fault.empty(), version() >= 10);
}

/// What was reported before version 11 is passed over: no template was there for it.
TEST_P(KeptFile, HasMeasurementsSinceVersion11) {
  reopen();
  const bool has_them = version() >= 11;
  EXPECT_EQ(store_->measurements.list({.run = "r1"}, {}, 10)->size(), has_them ? 1u : 0u);
  EXPECT_TRUE(store_->measurements.underived()->empty());
  EXPECT_EQ(store_->measurements.next_part_id(), has_them ? 2u : 1u);
  EXPECT_EQ(store_->report_templates.assignments()->size(), has_them ? 1u : 0u);
  EXPECT_EQ(store_->archives.list({})->size(), version() >= 17 ? 2u : has_them ? 1u : 0u);
  if (!has_them) return;
  const auto measured = store_->measurements.list({.run = "r1"}, {}, 10)->front();
  EXPECT_EQ(measured.actual, 1.5);
  EXPECT_EQ(measured.verdict, measurement::Verdict::Rework);
  EXPECT_EQ(measured.serial, "S7");
}

TEST_P(KeptFile, HasCorrectionsSinceVersion12) {
  reopen();
  const bool has_them = version() >= 12;
  EXPECT_EQ(store_->offsets.rules("m1").has_value(), has_them);
  const auto corrections = store_->offsets.list({.machine = "m1"}, {});
  ASSERT_EQ(corrections->size(), has_them ? 2u : 0u);
  if (!has_them) return;
  EXPECT_EQ(corrections->at(0).state, OffsetState::Pending);
  EXPECT_EQ(corrections->at(1).setup, 2u);
}

TEST_P(KeptFile, HasFieldsAndAttachmentsSinceVersion13) {
  reopen();
  const bool has_them = version() >= 13;
  EXPECT_EQ(store_->programs.fields("p.nc")->part, has_them ? "4711" : "");
  EXPECT_EQ(store_->programs.revision("p.nc", 2)->cam_file, has_them ? "p.f3d" : "");
  EXPECT_EQ(store_->attachments.list("p.nc", std::nullopt)->size(), has_them ? 1u : 0u);
}

TEST_P(KeptFile, HasHotFoldersJobsAndWebhooksSinceVersion14) {
  reopen();
  const bool has_them = version() >= 14;
  EXPECT_EQ(store_->folders.unfinished("cam")->size(), has_them ? 1u : 0u);
  EXPECT_EQ(store_->jobs.list("m1", true, {})->size(), version() >= 17 ? 2u : has_them ? 1u : 0u);
  EXPECT_EQ(store_->webhooks.list()->size(), has_them ? 1u : 0u);
  if (!has_them) return;
  EXPECT_EQ(store_->folders.unfinished("cam")->at(0).target, "done/p.nc");
  EXPECT_EQ(store_->jobs.find(1)->completed, 1u);
  EXPECT_EQ(store_->jobs.hold_of("m1").value()->reason, "bore is wide");
  EXPECT_EQ(store_->webhooks.find("erp")->waiting, version() >= 23   ? 3u
                                                   : version() >= 21 ? 2u
                                                                     : 1u);
}

TEST_P(KeptFile, HasCallsOfRunsSinceVersion15) {
  reopen();
  const bool has_them = version() >= 15;
  EXPECT_EQ(store_->runs.find("r2").has_value(), has_them);
  EXPECT_FALSE(store_->runs.find("r1")->gateway_setup);
  if (!has_them) return;
  EXPECT_EQ(store_->runs.find("r2")->gateway_setup, std::string(64, 'a'));
  const auto calls = store_->runs.calls("r2");
  ASSERT_EQ(calls->size(), 1u);
  EXPECT_EQ(calls->at(0).program, "p.nc");
}

TEST_P(KeptFile, HasReadersOfTheRecordsSinceVersion16) {
  reopen();
  const auto unread = store_->record_readers.unread("mqtt");
  EXPECT_EQ(unread->size(), version() < 16 ? 0u : 1u);
  if (version() < 16) return;
  EXPECT_EQ(unread->at(0).cursor.number, 2u);
  EXPECT_EQ(unread->at(0).last, 3u);
}

TEST_P(KeptFile, HasCountsOfArchivedPartsSinceVersion17) {
  reopen();
  const bool has_them = version() >= 17;
  const auto parts = store_->measurements.parts_of_run("r1");
  ASSERT_TRUE(parts) << parts.error().what;
  EXPECT_EQ(parts->archived, has_them ? 2u : 0u);
  EXPECT_EQ(parts->all(), (version() >= 11 ? 1u : 0u) + (has_them ? 2u : 0u));
  EXPECT_TRUE(store_->archives.uncounted()->empty()) << "an archive of records has no parts";
}

TEST_P(KeptFile, HasReasonsOfHoldsAndWhatJobsCountSinceVersion17) {
  reopen();
  const auto holds = store_->machines.holds();
  ASSERT_TRUE(holds) << holds.error().what;
  EXPECT_EQ(holds->size(), version() >= 17 ? 1u : 0u);
  if (version() >= 14) {
    EXPECT_EQ(store_->jobs.find(1)->counts, JobCount::Made);
  }
  if (version() < 17) return;
  EXPECT_EQ(holds->at(0).reason, "part 1 S7 is scrap");
  EXPECT_EQ(holds->at(0).run, "r2");
  EXPECT_EQ(store_->jobs.find(2)->counts, JobCount::Good);
}

TEST_P(KeptFile, HasTheSetupInTheControlSinceVersion18) {
  reopen();
  const auto loaded = store_->setups.loaded("m1");
  ASSERT_TRUE(loaded) << loaded.error().what;
  ASSERT_EQ(loaded->has_value(), version() >= 18);
  if (version() < 18) return;
  EXPECT_EQ((*loaded)->number, 1u);
  EXPECT_EQ((*loaded)->who, "anna");
}

TEST_P(KeptFile, HasTheTimeAndThePathOfARunSinceVersion19) {
  reopen();
  const auto run = store_->runs.find("r1");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_EQ(run->statistics.has_value(), version() >= 19);
  if (version() >= 19) {
    EXPECT_EQ(*run->statistics, (RunStatistics{12.5, 250.75}));
  }
}

TEST_P(KeptFile, HasTheComputerOfAPortSinceVersion20) {
  reopen();
  const auto ports = store_->ports.list();
  ASSERT_TRUE(ports) << ports.error().what;
  if (version() < 2) return;
  ASSERT_EQ(ports->size(), 1u);
  EXPECT_EQ(ports->front().host, version() >= 20 ? "srv-1" : "");
}

TEST_P(KeptFile, HasTransfersOfAPortSinceVersion22) {
  reopen();
  const auto ports = store_->ports.list();
  ASSERT_TRUE(ports) << ports.error().what;
  if (version() < 2) return;
  const auto transfers = store_->ports.transfers(ports->front().name);
  ASSERT_TRUE(transfers) << transfers.error().what;
  ASSERT_EQ(transfers->size(), version() >= 22 ? 2u : 0u);
  if (version() < 22) return;
  EXPECT_EQ(transfers->front().state, TransferState::Active);
  EXPECT_EQ(transfers->front().programs.size(), 2u);
  EXPECT_EQ(transfers->back().reason, "the line is lost");
  const auto& sent = transfers->front().direction == TransferDirection::Send ? transfers->front()
                                                                             : transfers->back();
  EXPECT_EQ(sent.after_run, version() >= 24 ? std::optional<std::string>("r1") : std::nullopt);
}

TEST_P(KeptFile, KnowsATestRunThatWasCutOffSinceVersion23) {
  reopen();
  EXPECT_FALSE(store_->runs.find("r1")->is_test);
  if (version() < 23) return;
  const auto run = store_->runs.find("r4");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->state, RunState::Interrupted);
  EXPECT_TRUE(run->is_test);
}

INSTANTIATE_TEST_SUITE_P(, KeptFile,
                         testing::Values("v1.sql", "v2.sql", "v3.sql", "v4.sql", "v5.sql", "v6.sql",
                                         "v7.sql", "v8.sql", "v9.sql", "v10.sql", "v11.sql",
                                         "v12.sql", "v13.sql", "v14.sql", "v15.sql", "v16.sql",
                                         "v17.sql", "v18.sql", "v19.sql", "v20.sql", "v21.sql",
                                         "v22.sql", "v23.sql", "v24.sql", "v25.sql", "v26.sql"),
                         [](const auto& i) {
                           return std::string(i.param, std::string_view(i.param).find('.'));
                         });

}  // namespace
}  // namespace dripline::storage
