#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class SetupTest : public ContractTest {
 protected:
  Result<SetupRevision> save(const std::string& text, const std::string& machine = "mill-3",
                             std::optional<std::uint64_t> base = std::nullopt) {
    SetupRevision setup;
    setup.machine = machine;
    setup.text = text;
    setup.comment = "why";
    setup.author = "admin";
    return store_->setups.save(setup, base);
  }
};

TEST_P(SetupTest, IsKeptInVersions) {
  EXPECT_EQ(save("[[tool]]\nnumber = 1\n")->number, 1u);
  EXPECT_EQ(save("[[tool]]\nnumber = 2\n")->number, 2u);
  EXPECT_EQ(save("other", "mill-4")->number, 1u) << "each machine counts for itself";
  reopen();
  const auto newest = store_->setups.find("mill-3", std::nullopt);
  ASSERT_TRUE(newest) << newest.error().what;
  EXPECT_EQ(newest->number, 2u);
  EXPECT_EQ(newest->text, "[[tool]]\nnumber = 2\n");
  EXPECT_EQ(newest->sha256, sha256(newest->text));
  EXPECT_EQ(newest->size, newest->text.size());
  EXPECT_EQ(newest->comment, "why");
  EXPECT_EQ(newest->author, "admin");
  EXPECT_EQ(store_->setups.find("mill-3", 1)->text, "[[tool]]\nnumber = 1\n");
  const auto all = store_->setups.list("mill-3", {});
  ASSERT_EQ(all->size(), 2u);
  EXPECT_EQ(all->at(0).number, 2u);
  EXPECT_TRUE(all->at(0).text.empty()) << "listings are short";
  EXPECT_EQ(store_->setups.list("mill-3", {.limit = 1, .offset = 1})->at(0).number, 1u);
}

TEST_P(SetupTest, TheSameTextAgainIsTheSameRevision) {
  ASSERT_TRUE(save("a = 1"));
  EXPECT_EQ(save("a = 1")->number, 1u);
  ASSERT_EQ(save("a = 2")->number, 2u);
  EXPECT_EQ(save("a = 1")->number, 3u) << "going back is a new revision";
}

TEST_P(SetupTest, DoesNotGoOverANewerOne) {
  ASSERT_EQ(save("a = 1", "mill-3", 0)->number, 1u);
  ASSERT_EQ(save("a = 2", "mill-3", 1)->number, 2u);
  const auto late = save("a = 3", "mill-3", 1);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, Errc::Conflict);
  EXPECT_EQ(late.error().what,
            "machine mill-3: this setup was made from 1, and 2 is the newest by now; nothing was "
            "stored");
  EXPECT_EQ(save("a = 3", "mill-3", 0).error().what,
            "machine mill-3: this setup was made before there was one, and 2 is the newest by now; "
            "nothing was stored");
  EXPECT_EQ(save("a = 3", "mill-4", 7).error().what,
            "machine mill-4: this setup was made from 7, and there is none");
  EXPECT_EQ(store_->setups.find("mill-3", std::nullopt)->text, "a = 2");
  EXPECT_EQ(save("a = 2", "mill-3", 1)->number, 2u) << "an answer that was lost is asked for again";
}

TEST_P(SetupTest, SizesCountBytes) {
  EXPECT_EQ(save("# Fräser")->size, 9u);
  EXPECT_EQ(store_->setups.list("mill-3", {})->at(0).size, 9u);
}

TEST_P(SetupTest, RefusesWhatIsTooLongAndUnknownMachines) {
  EXPECT_TRUE(save(std::string(kMaxSetup, ' ')));
  EXPECT_EQ(save(std::string(kMaxSetup + 1, ' ')).error().code, Errc::LimitExceeded);
  EXPECT_EQ(save("a = 1", "no/machine").error().code, Errc::Syntax);
  EXPECT_EQ(store_->setups.find("mill-9", std::nullopt).error().code, Errc::NotFound);
  EXPECT_EQ(store_->setups.find("mill-3", 7).error().code, Errc::NotFound);
}

TEST_P(SetupTest, ARunRemembersItsSetup) {
  ASSERT_TRUE(save("a = 1"));
  Run run = make_run("r1");
  run.setup = 1;
  ASSERT_TRUE(store_->runs.create(run)) << "the fixture's machine and program";
  EXPECT_EQ(store_->runs.find("r1")->setup, 1u);
}

TEST_P(SetupTest, WhichIsInTheControlIsKeptWithWhoSaidSo) {
  ASSERT_TRUE(save("[[tool]]\nnumber = 1\n"));
  ASSERT_TRUE(save("[[tool]]\nnumber = 2\n"));
  EXPECT_FALSE(store_->setups.loaded("mill-3")->has_value()) << "never stated";
  const auto noted = store_->setups.note_loaded("mill-3", 1, Actor("olga", "token", "10.0.0.7"));
  ASSERT_TRUE(noted) << noted.error().what;
  reopen();
  const auto loaded = store_->setups.loaded("mill-3");
  ASSERT_TRUE(loaded && *loaded);
  EXPECT_EQ((*loaded)->number, 1u) << "the newest is another one";
  EXPECT_EQ((*loaded)->who, "olga");
  EXPECT_EQ((*loaded)->time, noted->time);
  EXPECT_FALSE(store_->setups.loaded("mill-4")->has_value()) << "each machine for itself";
  const auto audit = store_->audit.list({.limit = 1});
  ASSERT_EQ(audit->size(), 1u);
  EXPECT_EQ(audit->at(0).action, "setup.loaded");
  EXPECT_EQ(audit->at(0).subject, "mill-3");
  EXPECT_EQ(audit->at(0).detail, "setup 1 is in the control");
  EXPECT_EQ(audit->at(0).who.name, "olga");
}

TEST_P(SetupTest, WhichIsInTheControlCanBeUnknownAgain) {
  ASSERT_TRUE(save("[[tool]]\nnumber = 1\n"));
  ASSERT_TRUE(store_->setups.note_loaded("mill-3", 1, "olga"));
  ASSERT_TRUE(store_->setups.note_loaded("mill-3", std::nullopt, "olga"));
  const auto loaded = store_->setups.loaded("mill-3");
  ASSERT_TRUE(loaded && *loaded);
  EXPECT_EQ((*loaded)->number, std::nullopt);
}

TEST_P(SetupTest, NothingIsSaidOfAMachineWithoutAny) {
  const auto noted = store_->setups.note_loaded("mill-3", std::nullopt, "olga");
  ASSERT_FALSE(noted);
  EXPECT_EQ(noted.error().what, "machine mill-3 has no setup on the server");
}

TEST_P(SetupTest, OneThatIsNotThereIsNotInTheControl) {
  ASSERT_TRUE(save("[[tool]]\nnumber = 1\n"));
  ASSERT_TRUE(store_->setups.note_loaded("mill-3", 1, "olga"));
  const auto noted = store_->setups.note_loaded("mill-3", 2, "olga");
  ASSERT_FALSE(noted);
  EXPECT_EQ(noted.error().code, Errc::NotFound);
  EXPECT_EQ(noted.error().what, "machine mill-3 has no setup 2");
  EXPECT_EQ((*store_->setups.loaded("mill-3"))->number, 1u) << "nothing has changed";
}

ON_BOTH_ENGINES(SetupTest);

}  // namespace
}  // namespace dripline::storage
