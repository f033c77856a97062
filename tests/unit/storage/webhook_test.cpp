#include <algorithm>

#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// Events come to be in the transaction of the change.
class WebhookEvents : public ContractTest {
 protected:
  Webhook add(const std::string& name, std::vector<std::string> kinds = {}) {
    Webhook webhook;
    webhook.name = name;
    webhook.url = "https://erp.example/hook";
    webhook.secret = "s3cret";
    webhook.kinds = std::move(kinds);
    webhook.author = "admin";
    webhook.created = clock_.now();
    auto added = store_->webhooks.add(webhook, "admin");
    EXPECT_TRUE(added) << added.error().what;
    return added.value_or(Webhook{});
  }
  std::vector<Event> events(std::uint64_t after = 0) {
    return store_->webhooks.events(after, 1000).value();
  }
  std::string kinds() {
    std::string all;
    for (const auto& event : events()) all += event.kind + " ";
    return all;
  }
};

TEST_P(WebhookEvents, AreNoneWithoutAWebhook) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  EXPECT_TRUE(events().empty());
  EXPECT_EQ(add("erp").delivered, 0u);
  EXPECT_TRUE(events().empty()) << "it gets what happens from now on";
}

TEST_P(WebhookEvents, AreWrittenByEveryKindOfChange) {
  add("erp");
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  auto batch = make_batch(1, 2);
  batch.records[0].kind = "alarm";
  batch.records[0].text = "CEN0042 \"tool\"";
  batch.records[1].kind = "run_ended";
  RunEnding ending;
  ending.run = "r1";
  ending.state = RunState::Alarmed;
  ending.ended = clock_.now();
  batch.endings.push_back(ending);
  ASSERT_TRUE(store_->records.store(batch));
  Job job;
  job.machine = "m1";
  job.program = "p.nc";
  ASSERT_TRUE(store_->jobs.add(job, "anna", {}));
  ASSERT_TRUE(store_->jobs.hold({"m1", "anna", "wide", clock_.now()}, "anna"));
  ASSERT_TRUE(store_->jobs.release("m1", "anna", clock_.now()));
  EXPECT_EQ(kinds(), "revision run alarm run job job job ");
  const auto all = events();
  EXPECT_NE(all.at(0).data.find(R"("change":"stored","program":"p.nc","revision":1)"),
            std::string::npos);
  EXPECT_NE(all.at(2).data.find(R"("text":"CEN0042 \"tool\"")"), std::string::npos);
  EXPECT_NE(all.at(3).data.find(R"("run":"r1","state":"alarmed","machine":"m1")"),
            std::string::npos);
  EXPECT_NE(all.at(5).data.find(R"("reason":"wide")"), std::string::npos);
  ASSERT_TRUE(store_->records.store(batch)) << "sent again";
  EXPECT_EQ(events().size(), all.size());
}

TEST_P(WebhookEvents, OfAJobCountItsParts) {
  add("erp", {"job"});
  auto run = make_run("r1");
  Job job;
  job.machine = "m1";
  job.program = "p.nc";
  run.job = store_->jobs.add(job, "anna", {})->id;
  ASSERT_TRUE(store_->runs.create(run));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Completed, ""));
  const auto all = events();
  const auto done = std::ranges::find_if(all, [](const Event& event) {
    return event.data.find(R"("change":"done")") != std::string::npos;
  });
  ASSERT_NE(done, all.end());
  EXPECT_NE(done->data.find(R"("completed":1)"), std::string::npos);
}

/// A job that counts good parts is done when the last of them is known: after its run.
TEST_P(WebhookEvents, OfAJobThatCountsGoodPartsWaitForTheVerdict) {
  ASSERT_TRUE(store_->report_templates.push(
      {.name = "bore", .version = 0, .text = "x", .author = "anna", .created = clock_.now()},
      "anna"));
  auto run = make_run("r1");
  Job job;
  job.machine = "m1";
  job.program = "p.nc";
  job.counts = JobCount::Good;
  run.job = store_->jobs.add(job, "anna", {})->id;
  add("erp", {"job"});
  ASSERT_TRUE(store_->runs.create(run));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Completed, ""));
  const auto changes = [&] {
    std::string all;
    for (const Event& event : events()) {
      if (event.kind != "job") continue;
      all += event.data.find(R"("change":"done")") != std::string::npos ? "done " : "progress ";
    }
    return all;
  };
  EXPECT_EQ(changes(), "progress ");
  DerivedBatch derived;
  derived.machine = "m1";
  derived.epoch = 99;
  derived.through = 1;
  MeasuredPart part;
  part.id = 1;
  part.machine = "m1";
  part.run = "r1";
  part.template_name = "bore";
  part.template_version = 1;
  part.verdict = measurement::Verdict::Good;
  part.begun = clock_.now();
  derived.parts = {part};
  ASSERT_TRUE(store_->measurements.commit(derived));
  EXPECT_EQ(changes(), "progress ") << "so far: lines may follow";
  derived.after = 1;
  derived.through = 2;
  derived.parts[0].ended = clock_.now();
  ASSERT_TRUE(store_->measurements.commit(derived));
  EXPECT_EQ(changes(), "progress done ");
  derived.after = 2;
  derived.through = 3;
  derived.parts[0].id = 2;
  ASSERT_TRUE(store_->measurements.commit(derived));
  EXPECT_EQ(changes(), "progress done done ") << "a part that is over at once";
}

TEST_P(WebhookEvents, OfAPartComeAtItsVerdictOrItsEnd) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  ASSERT_TRUE(store_->report_templates.push(
      {.name = "bore", .version = 0, .text = "x", .author = "anna", .created = clock_.now()},
      "anna"));
  ASSERT_TRUE(store_->records.store(make_batch(1, 4)));
  add("erp", {"part"});
  DerivedBatch derived;
  derived.machine = "m1";
  derived.epoch = make_batch(1, 1).epoch;
  MeasuredPart part;
  part.id = 1;
  part.machine = "m1";
  part.run = "r1";
  part.template_name = "bore";
  part.template_version = 1;
  part.serial = "S7";
  part.begun = clock_.now();
  const auto commit = [&](std::uint64_t through, measurement::Verdict verdict, bool is_complete) {
    part.verdict = verdict;
    if (is_complete) part.ended = clock_.now();
    derived.after = derived.through;
    derived.through = through;
    derived.parts = {part};
    const auto committed = store_->measurements.commit(derived);
    ASSERT_TRUE(committed) << committed.error().what;
  };
  commit(1, measurement::Verdict::Good, false);
  EXPECT_EQ(kinds(), "") << "it may become worse";
  commit(2, measurement::Verdict::Rework, false);
  EXPECT_EQ(kinds(), "part ");
  commit(3, measurement::Verdict::Rework, true);
  EXPECT_EQ(kinds(), "part ") << "reported already";
  part.id = 2;
  part.ended.reset();
  commit(4, measurement::Verdict::Good, true);
  EXPECT_EQ(kinds(), "part part ");
  EXPECT_NE(events().at(0).data.find(R"("serial":"S7","verdict":"rework")"), std::string::npos);
}

TEST_P(WebhookEvents, OfRevisionsAndImportsFollowTheirStates) {
  add("erp");
  Upload upload;
  upload.program = "p.nc";
  upload.author = "machine m1";
  upload.is_held = true;
  const auto id = store_->uploads.begin(upload)->id;
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of("G0\n")));
  ASSERT_TRUE(store_->uploads.commit(id, std::nullopt));
  ASSERT_TRUE(store_->imports.decide({.program = "p.nc", .revision = 1, .who = "boss"}));
  EXPECT_EQ(kinds(), "revision import import ");
  EXPECT_NE(events().at(0).data.find(R"("held":true)"), std::string::npos);
  EXPECT_NE(events().at(2).data.find(R"("state":"accepted")"), std::string::npos);
}

TEST_P(WebhookEvents, AreKeptUntilEveryWebhookHasThem) {
  const auto one = add("one"), two = add("two", {"run"});
  make_run("r1");
  ASSERT_TRUE(push("q.nc", "G0\n"));
  const auto all = events();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(store_->webhooks.find("one")->waiting, 2u);
  EXPECT_EQ(store_->webhooks.find("two")->waiting, 0u) << "revisions are not for it";
  ASSERT_TRUE(store_->webhooks.set_delivered(one.id, all.back().id, clock_.now()));
  EXPECT_EQ(events().size(), 2u);
  reopen();
  EXPECT_EQ(store_->webhooks.find("one")->delivered, all.back().id);
  ASSERT_TRUE(store_->webhooks.set_delivered(two.id, all.front().id, clock_.now()));
  EXPECT_EQ(events().size(), 1u);
  ASSERT_TRUE(store_->webhooks.remove("two", "admin", clock_.now()));
  EXPECT_TRUE(events().empty());
  EXPECT_EQ(add("three").delivered, all.back().id) << "numbers are never used twice";
}

/// Who reads the audit trail is not to know what a path or query may hold.
TEST_P(WebhookEvents, AreAuditedWithoutTheSecretsOfAUrl) {
  Webhook webhook;
  webhook.name = "chat";
  webhook.secret = "s3cret";
  webhook.author = "admin";
  for (const char* rest : {"/hooks/T0KEN", "?key=T0KEN", ""}) {
    webhook.url = std::string("https://chat.example:8443") + rest;
    ASSERT_TRUE(store_->webhooks.add(webhook, "admin"));
    const auto added = store_->audit.list({.limit = 1})->at(0);
    EXPECT_EQ(added.action, "webhook.add");
    EXPECT_EQ(added.detail, "https://chat.example:8443");
    ASSERT_TRUE(store_->webhooks.remove("chat", "admin", clock_.now()));
    const auto removed = store_->audit.list({.limit = 1})->at(0);
    EXPECT_EQ(removed.action, "webhook.remove");
    EXPECT_EQ(removed.detail, "https://chat.example:8443");
  }
}

TEST_P(WebhookEvents, OfAFailingWebhookSayHowItFails) {
  const auto hook = add("erp");
  const UtcTime since = clock_.now();
  ASSERT_TRUE(store_->webhooks.set_failing(hook.id, "status 500", clock_.now()));
  clock_.advance(std::chrono::seconds(9));
  ASSERT_TRUE(store_->webhooks.set_failing(hook.id, "status 503", clock_.now()));
  auto found = store_->webhooks.find("erp");
  EXPECT_EQ(found->failures, 2u);
  EXPECT_EQ(found->failing_since, since);
  EXPECT_EQ(found->fault, "status 503");
  ASSERT_TRUE(store_->webhooks.set_delivered(hook.id, 0, clock_.now()));
  found = store_->webhooks.find("erp");
  EXPECT_EQ(found->failures, 0u);
  EXPECT_FALSE(found->failing_since);
}

TEST_P(WebhookEvents, AreBoundedAndWhatWasDroppedIsCounted) {
  add("erp");
  make_run("r1");
  damage(
      "UPDATE event SET id = 150000; INSERT INTO event (id, time_us, kind, data) VALUES (7, 1, "
      "'run', '{}')");
  ASSERT_TRUE(store_->webhooks.trim());
  EXPECT_EQ(events().size(), 1u);
  EXPECT_EQ(store_->webhooks.find("erp")->lost, 1u);
  EXPECT_EQ(store_->webhooks.find("erp")->delivered, 150000u - WebhookStore::kMaxEvents);
}

TEST_P(WebhookEvents, WebhooksHaveNamesOfTheirOwnAndALimit) {
  add("erp");
  Webhook again;
  again.name = "erp";
  EXPECT_EQ(store_->webhooks.add(again, "admin").error().code, Errc::Conflict);
  for (std::uint64_t i = 1; i < WebhookStore::kMaxWebhooks; ++i) add(fmt::format("h{}", i));
  again.name = "more";
  EXPECT_EQ(store_->webhooks.add(again, "admin").error().code, Errc::LimitExceeded);
  EXPECT_EQ(store_->webhooks.list()->front().name, "erp");
  EXPECT_EQ(store_->webhooks.remove("none", "admin", clock_.now()).error().code, Errc::NotFound);
}

ON_BOTH_ENGINES(WebhookEvents);

}  // namespace
}  // namespace dripline::storage
