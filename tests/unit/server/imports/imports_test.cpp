#include "server/imports/imports.hpp"

#include <condition_variable>
#include <nlohmann/json.hpp>

#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::imports {
namespace {

using Json = nlohmann::json;
using storage::ImportState;

constexpr const char* kMilled = "O1\nG21 G90\nG0 X10.\nG1 Y5. F100.\nM30\n";
constexpr const char* kCommented = "O1\nG21 G90 (metric)\nG0 X10.\nG1 Y5. F100.\nM30\n";
constexpr const char* kFaster = "O1\nG21 G90\nG0 X10.\nG1 Y5. F120.\nM30\n";
constexpr const char* kMoved = "O1\nG21 G90\nG0 X11.\nG1 Y5. F100.\nM30\n";

class ImportsTest : public server_test::ServerTest {
 protected:
  ImportsTest() {
    catalog_.known.push_back("fanuc");
    add_machine("mill-1", "fanuc");
  }

  void start(const std::string& policy) {
    imports_.reset();
    use_policy(policy);
    paths_ = std::make_unique<paths::ProgramPaths>(
        machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_});
    imports_ = std::make_unique<Imports>(Imports::Parts{.store = *store_,
                                                        .paths = *paths_,
                                                        .policy = releases_->policy(),
                                                        .clock = clock_,
                                                        .on_change = [this](const auto& import) {
                                                          const std::lock_guard lock(mutex_);
                                                          changes_.push_back(import);
                                                          changed_.notify_all();
                                                        }});
    programs_->on_held([this](const auto& revision) { imports_->note(revision); });
  }
  storage::Revision receive(const std::string& text, const std::string& comment = "punched") {
    const auto upload =
        programs_->begin({.program = "O1", .control = "fanuc", .comment = comment, .is_held = true},
                         "machine mill-1");
    EXPECT_TRUE(upload) << upload.error().what;
    EXPECT_TRUE(programs_->append(upload->id, 0, server_test::bytes_of(text)));
    return programs_->commit(upload->id, std::nullopt, "machine mill-1")->revision;
  }
  /// As soon as this revision was compared, or decided.
  storage::Import wait(std::uint64_t revision) {
    std::unique_lock lock(mutex_);
    storage::Import found;
    const bool is_there = changed_.wait_for(lock, std::chrono::seconds(60), [&] {
      for (const auto& import : changes_) {
        if (import.revision.number == revision && import.compared) found = import;
      }
      return found.compared.has_value();
    });
    EXPECT_TRUE(is_there);
    return found;
  }
  std::uint64_t newest() { return store_->programs.revision("O1", std::nullopt)->number; }
  void set_up_machine() {
    ASSERT_TRUE(setups_->save({.machine = "mill-1",
                               .control = "fanuc",
                               .text = "[[offset]]\nname = \"G55\"\nX = 1.0\n",
                               .comment = {}},
                              {"anna", "", ""}));
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<storage::Import> changes_;
  std::unique_ptr<paths::ProgramPaths> paths_;
  std::unique_ptr<Imports> imports_;
};

TEST_F(ImportsTest, WithoutAPolicyTheClassIsFoundAndEverythingWaits) {
  start("");
  imports_->begin();
  push("O1", kMilled, "fanuc");
  receive(kCommented);
  const auto found = wait(2);
  EXPECT_EQ(found.state, ImportState::Pending);
  EXPECT_EQ(found.compared->edit, "comment");
  EXPECT_EQ(found.compared->base, 1u);
  EXPECT_EQ(found.compared->fault, "");
  EXPECT_EQ(newest(), 1u);
}

TEST_F(ImportsTest, ThePolicyAcceptsItsClassesAndLeavesTheOthers) {
  set_up_machine();
  start("[imports]\naccept_at_once = [\"comment\", \"feed_and_speed\"]");
  imports_->begin();
  push("O1", kMilled, "fanuc");
  receive(kCommented);
  const auto accepted = wait(2);
  EXPECT_EQ(accepted.state, ImportState::Accepted);
  EXPECT_TRUE(accepted.is_at_once);
  EXPECT_EQ(accepted.who, "release policy");
  EXPECT_EQ(newest(), 2u);
  receive(kFaster);
  EXPECT_EQ(wait(3).state, ImportState::Accepted);
  EXPECT_EQ(wait(3).compared->edit, "feed_and_speed");
  receive(kMoved);
  const auto waits = wait(4);
  EXPECT_EQ(waits.state, ImportState::Pending);
  EXPECT_EQ(waits.compared->edit, "geometry");
  EXPECT_NE(waits.compared->fault.find("to a person"), std::string::npos);
  EXPECT_EQ(newest(), 3u);
}

/// Not what a shop means by "feed and speed": the spindle of a cut, and the pitch of a tap.
TEST_F(ImportsTest, TheSpindleAndAPitchWaitForAPerson) {
  const std::string cut = "O1\nG21 G90 G94\nS500 M3\nG0 Z5.\nG1 Z-1. F100.\nG0 Z5.\nM5\nM30\n";
  const std::string tap = "O1\nG21 G90 G94\nS500 M3\nG0 Z5.\nG84 Z-9. R2. F500.\nG80\nM5\nM30\n";
  set_up_machine();
  start("[imports]\naccept_at_once = [\"comment\", \"feed_and_speed\"]");
  imports_->begin();
  const auto class_of = [&](const std::string& base, const std::string& from,
                            const std::string& to) {
    push("O1", base, "fanuc");
    std::string edited = base;
    const auto held = receive(edited.replace(edited.find(from), from.size(), to));
    const auto waits = wait(held.number);
    EXPECT_EQ(waits.state, ImportState::Pending) << to;
    return waits.compared->edit;
  };
  EXPECT_EQ(class_of(cut, "M3", "M4"), "other");
  EXPECT_EQ(class_of(cut, "G1 Z", "M5\nG1 Z"), "other");
  EXPECT_EQ(class_of(cut, "S500", "S0"), "other");
  EXPECT_EQ(class_of(cut, "G94", "G95"), "other");
  EXPECT_EQ(class_of(tap, "S500", "S600"), "geometry");
  EXPECT_EQ(class_of(tap, "F500.", "F450."), "geometry");
}

TEST_F(ImportsTest, WhatCannotBeComparedWaits) {
  start("[imports]\naccept_at_once = [\"comment\", \"same_motion\"]");
  imports_->begin();
  receive(kMilled);
  const auto alone = wait(1);
  EXPECT_EQ(alone.state, ImportState::Pending);
  EXPECT_EQ(alone.compared->edit, "");
  EXPECT_EQ(alone.compared->fault, "there is no revision to compare it with");
  ASSERT_TRUE(setups_->save(
      {.machine = "mill-1", .control = "fanuc", .text = "[parameters]\nP1 = 2\n", .comment = {}},
      {"anna", "", ""}));  // of another control
  push("O1", kMilled, "fanuc");
  receive(kCommented);
  const auto broken = wait(3);
  EXPECT_EQ(broken.state, ImportState::Pending);
  EXPECT_NE(broken.compared->fault, "");
}

TEST_F(ImportsTest, WhatCameWhileTheServerWasAwayIsJudgedAtItsStart) {
  start("[imports]\naccept_at_once = [\"comment\"]");
  push("O1", kMilled, "fanuc");
  receive(kCommented);
  EXPECT_EQ(newest(), 1u);
  start("[imports]\naccept_at_once = [\"comment\"]");
  imports_->begin();
  EXPECT_EQ(wait(2).state, ImportState::Accepted);
}

TEST_F(ImportsTest, IsComparedWithTheReleasedRevisionAndWaitsWhereANewerIsInForce) {
  start("[imports]\naccept_at_once = [\"comment\"]\n[release]\nfrom = [\"draft\"]");
  push("O1", kMilled, "fanuc");
  ASSERT_TRUE(releases_->decide({.program = "O1",
                                 .revision = 1,
                                 .step = storage::RevisionStep::Release,
                                 .comment = {},
                                 .who = "boss",
                                 .role = storage::Role::Approver}));
  push("O1", kMoved, "fanuc");
  imports_->begin();
  receive(kCommented);
  const auto found = wait(3);
  EXPECT_EQ(found.state, ImportState::Pending);
  EXPECT_EQ(found.compared->base, 1u);
  EXPECT_EQ(found.compared->edit, "comment");
  EXPECT_NE(found.compared->fault.find("revision 2 is newer"), std::string::npos);
  const auto shown = imports_->show("O1", 3);
  ASSERT_TRUE(shown) << shown.error().what;
  EXPECT_EQ(shown->base->number, 1u);
  EXPECT_TRUE(shown->by_motion);
  EXPECT_EQ(Json::parse(shown->comparison)["class"], "comment");
}

TEST_F(ImportsTest, IsShownByItsTextWhereMotionCannotBeCompared) {
  start("");
  catalog_.known.push_back("other");
  push("O1", "1\n", "other");
  receive("2\n");
  const auto shown = imports_->show("O1", 2);
  ASSERT_TRUE(shown) << shown.error().what;
  EXPECT_FALSE(shown->by_motion);
  EXPECT_NE(shown->fault, "");
  EXPECT_EQ(Json::parse(shown->comparison)["by"], "text");
  EXPECT_EQ(imports_->show("O1", 1).error().code, Errc::NotFound);
}

TEST_F(ImportsTest, ARejectionNeedsAReason) {
  start("");
  push("O1", kMilled, "fanuc");
  receive(kMoved);
  storage::ImportDecision decision{
      .program = "O1", .revision = 2, .state = ImportState::Rejected, .who = "boss", .time = {}};
  decision.reason = " \n";
  EXPECT_EQ(imports_->decide(decision).error().code, Errc::Syntax);
  decision.reason = std::string(Imports::kMaxReason + 1, 'x');
  EXPECT_EQ(imports_->decide(decision).error().code, Errc::LimitExceeded);
  decision.reason = "too fast";
  EXPECT_TRUE(imports_->decide(decision));
  EXPECT_EQ(changes_.back().state, ImportState::Rejected);
}

}  // namespace
}  // namespace dripline::imports
