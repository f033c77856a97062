#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// The queue of what operators punched out at controls.
class ImportQueue : public ContractTest {
 protected:
  Revision receive(const std::string& program, std::string_view text) {
    Upload upload;
    upload.program = program;
    upload.control = "fanuc";
    upload.comment = "punched by lathe-2";
    upload.author = "machine lathe-2";
    upload.is_held = true;
    const auto begun = store_->uploads.begin(upload);
    EXPECT_TRUE(begun) << begun.error().what;
    EXPECT_TRUE(store_->uploads.append(begun->id, 0, bytes_of(text)));
    return store_->uploads.commit(begun->id, sha256(text)).value();
  }
  ImportDecision decision(ImportState state, const std::string& reason = "") {
    return {.program = "p.nc",
            .revision = 2,
            .state = state,
            .who = "boss",
            .time = clock_.now(),
            .reason = reason};
  }
  Import import(std::uint64_t revision = 2) {
    const auto found = store_->imports.find("p.nc", revision);
    EXPECT_TRUE(found) << found.error().what;
    return found.value_or(Import{});
  }
};

TEST_P(ImportQueue, HasWhatCameOldestFirst) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  EXPECT_TRUE(store_->imports.list(true, {})->empty()) << "a person pushed it";
  receive("p.nc", "G00 X1.1\n");
  clock_.advance(std::chrono::seconds(1));
  receive("a.nc", "G00 X2.\n");
  const auto waiting = store_->imports.list(true, {});
  ASSERT_EQ(waiting->size(), 2u);
  EXPECT_EQ(waiting->at(0).revision.program, "p.nc");
  EXPECT_EQ(waiting->at(0).revision.number, 2u);
  EXPECT_EQ(waiting->at(0).machine, "lathe-2");
  EXPECT_FALSE(waiting->at(0).compared);
  EXPECT_EQ(store_->imports.count_pending(), 2u);
  EXPECT_EQ(store_->imports.list(true, {.limit = 1, .offset = 1})->at(0).revision.program, "a.nc");
  ASSERT_TRUE(store_->programs.remove("a.nc"));
  EXPECT_EQ(store_->imports.count_pending(), 1u);
  EXPECT_EQ(store_->imports.uncompared(10)->size(), 1u);
}

TEST_P(ImportQueue, KeepsTheClassOverARestart) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  receive("p.nc", "G00 X1.1\n");
  ASSERT_TRUE(store_->imports.set_class(
      "p.nc", 2, {.base = 1, .edit = "geometry", .fault = "why", .time = clock_.now()}));
  reopen();
  const Import found = import();
  ASSERT_TRUE(found.compared);
  EXPECT_EQ(found.compared->base, 1u);
  EXPECT_EQ(found.compared->edit, "geometry");
  EXPECT_EQ(found.compared->fault, "why");
  EXPECT_TRUE(store_->imports.uncompared(10)->empty());
}

TEST_P(ImportQueue, AcceptedIsInForceWithWhoAndWhy) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  receive("p.nc", "G00 X1.1\n");
  const auto accepted = store_->imports.decide(decision(ImportState::Accepted, "measured"));
  ASSERT_TRUE(accepted) << accepted.error().what;
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 2u);
  const Import found = import();
  EXPECT_EQ(found.state, ImportState::Accepted);
  EXPECT_EQ(found.who, "boss");
  EXPECT_EQ(found.reason, "measured");
  EXPECT_EQ(found.decided, clock_.now());
  EXPECT_FALSE(found.is_at_once);
  EXPECT_TRUE(store_->imports.list(true, {})->empty());
  EXPECT_EQ(store_->imports.list(false, {})->size(), 1u);
  const auto entry = store_->audit.list({})->front();
  EXPECT_EQ(entry.action, "program.accept");
  EXPECT_NE(entry.detail.find(": measured"), std::string::npos) << entry.detail;
  const auto again = store_->imports.decide(decision(ImportState::Rejected, "late"));
  EXPECT_EQ(again.error().code, Errc::Conflict);
}

TEST_P(ImportQueue, RejectedIsHiddenButItsDecisionStays) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  receive("p.nc", "G00 X1.1\n");
  ASSERT_TRUE(store_->imports.decide(decision(ImportState::Rejected, "too fast")));
  EXPECT_EQ(store_->programs.revision("p.nc", 2).error().code, Errc::NotFound);
  const Import found = import();
  EXPECT_EQ(found.state, ImportState::Rejected);
  EXPECT_EQ(found.reason, "too fast");
  EXPECT_EQ(store_->audit.list({})->front().action, "program.reject");
}

TEST_P(ImportQueue, AcceptedAsIsARevisionOfTheOtherProgramAlone) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  receive("p.nc", "G00 X1.1\n");
  auto wanted = decision(ImportState::AcceptedAs);
  wanted.target = "p.nc";
  EXPECT_EQ(store_->imports.decide(wanted).error().code, Errc::Conflict);
  wanted.target = "a/b";
  EXPECT_EQ(store_->imports.decide(wanted).error().code, Errc::Syntax);
  wanted.target = "q.nc";
  const auto accepted = store_->imports.decide(wanted);
  ASSERT_TRUE(accepted) << accepted.error().what;
  EXPECT_EQ(accepted->program, "q.nc");
  EXPECT_EQ(accepted->number, 1u);
  EXPECT_EQ(accepted->author, "machine lathe-2");
  EXPECT_EQ(pull(accepted->content), "G00 X1.1\n");
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 1u);
  EXPECT_EQ(store_->programs.revision("p.nc", 2).error().code, Errc::NotFound);
  EXPECT_EQ(import().state, ImportState::AcceptedAs);
  EXPECT_EQ(import().target, "q.nc");
  EXPECT_EQ(import().target_revision, 1u);
  const auto entry = store_->audit.list({})->front();
  EXPECT_EQ(entry.action, "program.accept_as");
  EXPECT_NE(entry.detail.find("as q.nc revision 1"), std::string::npos) << entry.detail;
}

TEST_P(ImportQueue, ThePolicyAcceptsOnlyAgainstWhatIsStillTheNewest) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  receive("p.nc", "G00 X1. (a)\n");
  auto at_once = decision(ImportState::Accepted, "policy");
  at_once.at_once = ImportClass{.base = 1, .edit = "comment", .fault = {}, .time = clock_.now()};
  ASSERT_TRUE(push("p.nc", "G00 X7.\n"));
  const auto refused = store_->imports.decide(at_once);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_EQ(import().state, ImportState::Pending);
  EXPECT_FALSE(import().compared) << "nothing of it was kept";
  at_once.at_once->base = 3;
  ASSERT_TRUE(store_->imports.decide(at_once));
  EXPECT_TRUE(import().is_at_once);
  EXPECT_EQ(import().compared->edit, "comment");
  const auto entry = store_->audit.list({})->front();
  EXPECT_NE(entry.detail.find("at once, class comment against revision 3"), std::string::npos)
      << entry.detail;
}

TEST_P(ImportQueue, AcceptingAtTheProgramIsTheSame) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  receive("p.nc", "G00 X1.1\n");
  ASSERT_TRUE(store_->programs.accept("p.nc", 2, "boss"));
  EXPECT_EQ(import().state, ImportState::Accepted);
  receive("p.nc", "G00 X1.2\n");
  ASSERT_TRUE(store_->programs.reject("p.nc", 3, "boss"));
  EXPECT_EQ(import(3).state, ImportState::Rejected);
  EXPECT_EQ(store_->imports.find("p.nc", 1).error().code, Errc::NotFound);
}

ON_BOTH_ENGINES(ImportQueue);

}  // namespace
}  // namespace dripline::storage
