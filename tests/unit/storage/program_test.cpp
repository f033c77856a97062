#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class ProgramTest : public ContractTest {};

TEST_P(ProgramTest, EveryPushIsANewRevisionAndTheOldOnesStay) {
  const auto first = push("p.nc", "G00 X1.\n");
  clock_.advance(std::chrono::seconds(1));
  const auto second = push("p.nc", "G00 X2.\n");
  EXPECT_EQ(first->number, 1u);
  EXPECT_EQ(second->number, 2u);
  EXPECT_EQ(second->control, "centurion");
  EXPECT_EQ(second->comment, "a comment");
  EXPECT_EQ(second->author, "cam");
  EXPECT_EQ(second->created, clock_.now());
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 2u);
  EXPECT_EQ(store_->programs.revision("p.nc", 1)->content, first->content);
  const auto all = store_->programs.revisions("p.nc");
  ASSERT_EQ(all->size(), 2u);
  EXPECT_EQ(all->front().number, 2u);
  EXPECT_EQ(pull(first->content), "G00 X1.\n");
}

TEST_P(ProgramTest, SameContentAgainIsTheLatestRevision) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  EXPECT_EQ(push("p.nc", "G00 X1.\n")->number, 1u);
  ASSERT_TRUE(push("p.nc", "G00 X2.\n"));
  EXPECT_EQ(push("p.nc", "G00 X1.\n")->number, 3u) << "back to old content is a change";
  EXPECT_EQ(query("SELECT count(*) FROM content"), 2);
  EXPECT_EQ(query("SELECT count(*) FROM upload"), 0);
}

TEST_P(ProgramTest, ListingIsByNameAndPaged) {
  for (const char* name : {"c.nc", "a.nc", "b.nc"}) ASSERT_TRUE(push(name, "M30\n"));
  ASSERT_TRUE(push("a.nc", "M2\n"));
  EXPECT_EQ(store_->programs.count().value_or(0), store_->programs.list({})->size());
  const auto page = store_->programs.list({.limit = 2, .offset = 0});
  ASSERT_TRUE(page) << page.error().what;
  ASSERT_EQ(page->size(), 2u);
  EXPECT_EQ(page->at(0).latest.program, "a.nc");
  EXPECT_EQ(page->at(0).latest.number, 2u);
  EXPECT_EQ(page->at(0).revisions, 2u);
  EXPECT_EQ(page->at(1).latest.program, "b.nc");
  EXPECT_EQ(store_->programs.list({.limit = 2, .offset = 2})->at(0).latest.program, "c.nc");
}

TEST_P(ProgramTest, RemovedOneIsGoneButItsBytesStay) {
  const auto revision = push("p.nc", "G00 X1.\n");
  ASSERT_TRUE(store_->programs.remove("p.nc"));
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt).error().code, Errc::NotFound);
  EXPECT_EQ(store_->programs.revision("p.nc", 1).error().code, Errc::NotFound);
  EXPECT_EQ(store_->programs.revisions("p.nc").error().code, Errc::NotFound);
  EXPECT_EQ(store_->programs.remove("p.nc").error().code, Errc::NotFound);
  EXPECT_TRUE(store_->programs.list({})->empty());
  EXPECT_EQ(store_->programs.count().value_or(99), 0u);
  EXPECT_EQ(pull(revision->content), "G00 X1.\n");
}

TEST_P(ProgramTest, PushedAgainAfterRemovalContinuesItsNumbers) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  ASSERT_TRUE(store_->programs.remove("p.nc"));
  EXPECT_EQ(push("p.nc", "G00 X1.\n")->number, 2u);
  EXPECT_EQ(store_->programs.revisions("p.nc")->size(), 1u);
  EXPECT_EQ(store_->programs.list({})->at(0).revisions, 1u);
  EXPECT_FALSE(store_->programs.revision("p.nc", 1));
}

TEST_P(ProgramTest, CannotBeRemovedUnderARun) {
  const Run run = make_run("r1");
  ASSERT_TRUE(store_->runs.create(run));
  const auto refused = store_->programs.remove("p.nc");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  EXPECT_NE(refused.error().what.find("r1"), std::string::npos);
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, "operator"));
  EXPECT_TRUE(store_->programs.remove("p.nc"));
  EXPECT_EQ(store_->runs.find("r1")->program, "p.nc") << "runs keep their revision";
}

TEST_P(ProgramTest, AnyRangeOfContentIsRead) {
  const std::string text = nc_text(1'000'000);
  const Digest content = push("p.nc", text)->content;
  for (const auto& [offset, length] :
       {std::pair(0, 1), std::pair(262'143, 2), std::pair(262'144, 262'144),
        std::pair(100, 999'000), std::pair(999'999, 10), std::pair(786'431, 2)}) {
    const auto bytes = store_->programs.read_content(content, static_cast<std::uint64_t>(offset),
                                                     static_cast<std::uint64_t>(length));
    ASSERT_TRUE(bytes) << bytes.error().what;
    EXPECT_EQ(text_of(*bytes),
              text.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)));
  }
  EXPECT_TRUE(store_->programs.read_content(content, 1'000'000, 1)->empty());
  EXPECT_TRUE(store_->programs.read_content(content, ~0ull, ~0ull)->empty());
  EXPECT_TRUE(store_->programs.read_content(content, 5, 0)->empty());
  EXPECT_EQ(store_->programs.read_content(sha256("x"), 0, 1).error().code, Errc::NotFound);
}

struct DamageCase {
  const char* name;
  const char* sql;
  friend void PrintTo(const DamageCase& c, std::ostream* out) { *out << c.name; }
};
class Damage : public ContractTestOf<DamageCase> {};

TEST_P(Damage, IsRefusedByNameAndHealedByPushingAgain) {
  const std::string text = nc_text(800'000);
  const Digest content = push("p.nc", text)->content;
  damage(given().sql);
  EXPECT_EQ(text_of(store_->programs.read_content(content, 0, 1000).value()), text.substr(0, 1000))
      << "the chunks before are sound";
  const auto refused = store_->programs.read_content(content, 300'000, 10);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Corrupt);
  EXPECT_NE(refused.error().what.find(content.hex()), std::string::npos) << refused.error().what;
  EXPECT_NE(refused.error().what.find("chunk 1"), std::string::npos) << refused.error().what;
  EXPECT_FALSE(store_->programs.read_content(content, 0, 800'000));
  ASSERT_TRUE(push("p.nc", text));
  EXPECT_EQ(pull(content), text);
}

ON_BOTH_ENGINES_WITH(
    Damage,
    DamageCase{"one_byte_of_the_frame",
               "UPDATE chunk SET data = CAST(substr(data, 1, 50000) || x'00' || "
               "substr(data, 50002) AS BLOB) WHERE id = (SELECT chunk FROM content_chunk WHERE "
               "position = 1)"},
    DamageCase{"another_chunks_frame",
               "UPDATE chunk SET data = (SELECT data FROM chunk WHERE id = (SELECT chunk FROM "
               "content_chunk WHERE position = 0)) WHERE id = (SELECT chunk FROM content_chunk "
               "WHERE position = 1)"},
    DamageCase{"cut_off",
               "UPDATE chunk SET data = substr(data, 1, 100) WHERE id = (SELECT "
               "chunk FROM content_chunk WHERE position = 1)"},
    DamageCase{"no_frame_at_all",
               "UPDATE chunk SET data = x'' WHERE id = (SELECT chunk FROM "
               "content_chunk WHERE position = 1)"},
    DamageCase{"wrong_size",
               "UPDATE chunk SET size = 17 WHERE id = (SELECT chunk FROM "
               "content_chunk WHERE position = 1)"});

/// Rows that are well-formed and name sound chunks, but not the ones that were stored there. Each
/// chunk passes the check of its own bytes.
class WrongList : public ContractTestOf<DamageCase> {};

TEST_P(WrongList, IsRefusedBeforeAByteIsReadAndHealedByPushingAgain) {
  const std::string text = nc_text(800'000);
  const Digest content = push("p.nc", text)->content;
  ASSERT_TRUE(push("other.nc", nc_text(800'000, 7)));
  EXPECT_TRUE(store_->programs.verify_content(content));
  damage(given().sql);
  const auto refused = store_->programs.verify_content(content);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Corrupt);
  EXPECT_NE(refused.error().what.find(content.hex()), std::string::npos) << refused.error().what;
  const bool is_named = std::string_view(given().name) != "both_rows_swapped";
  if (is_named) {
    EXPECT_NE(refused.error().what.find("chunk 2 (bytes from 524288)"), std::string::npos)
        << refused.error().what;
  }
  EXPECT_FALSE(store_->programs.read_content(content, 0, 10))
      << "not even what comes before the damage";
  ASSERT_TRUE(push("p.nc", text));
  EXPECT_TRUE(store_->programs.verify_content(content));
  EXPECT_EQ(pull(content), text);
}

ON_BOTH_ENGINES_WITH(
    WrongList,
    DamageCase{"another_programs_chunk",
               "UPDATE content_chunk SET chunk = (SELECT chunk FROM content_chunk WHERE "
               "content = (SELECT max(id) FROM content) AND position = 2) "
               "WHERE content = (SELECT min(id) FROM content) AND position = 2"},
    DamageCase{"a_chunk_of_another_place",
               "UPDATE content_chunk SET chunk = (SELECT chunk FROM content_chunk WHERE "
               "content = (SELECT min(id) FROM content) AND position = 0) "
               "WHERE content = (SELECT min(id) FROM content) AND position = 2"},
    DamageCase{"its_own_digest_too",
               "UPDATE content_chunk SET sha256 = (SELECT sha256 FROM content_chunk WHERE "
               "content = (SELECT max(id) FROM content) AND position = 2) "
               "WHERE content = (SELECT min(id) FROM content) AND position = 2"},
    DamageCase{"both_rows_swapped",
               "UPDATE content_chunk SET position = 100 + 2 - position "
               "WHERE content = (SELECT min(id) FROM content) AND position < 3;"
               "UPDATE content_chunk SET position = position - 100 "
               "WHERE content = (SELECT min(id) FROM content) AND position >= 100"},
    DamageCase{"a_row_is_gone",
               "DELETE FROM content_chunk WHERE position = 2 AND "
               "content = (SELECT min(id) FROM content)"});

/// A revision's row names another content, and both contents are sound.
TEST_P(ProgramTest, ARevisionWhoseRowNamesAnotherContentIsRefused) {
  const auto first = push("p.nc", "G1 X1.\n");
  const auto other = push("other.nc", "G1 X999.\n");
  Run run = make_run("r2");  // p.nc of its own text
  run.revision = store_->programs.revision("p.nc", std::nullopt)->number;
  damage(
      "UPDATE revision SET content = (SELECT id FROM content WHERE size = 9) "
      "WHERE program = (SELECT id FROM program WHERE name = 'p.nc')");
  const auto refused = store_->programs.revision("p.nc", first->number);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Corrupt);
  EXPECT_NE(refused.error().what.find("p.nc revision 1"), std::string::npos);
  EXPECT_NE(refused.error().what.find(first->content.hex()), std::string::npos);
  EXPECT_NE(refused.error().what.find(other->content.hex()), std::string::npos);
  EXPECT_FALSE(store_->programs.revision("p.nc", std::nullopt));
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::Corrupt);
  // A list shows what was stored, not what the row names.
  EXPECT_EQ(store_->programs.revisions("p.nc")->back().content, first->content);
  const auto healed = push("p.nc", "G1 X1.\n");
  ASSERT_TRUE(healed) << healed.error().what;
  EXPECT_GT(healed->number, first->number);
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->content, first->content);
}

TEST_P(ProgramTest, ARevisionWhoseOwnDigestIsDamagedIsRefused) {
  ASSERT_TRUE(push("p.nc", "G1 X1.\n"));
  damage("UPDATE revision SET sha256 = CAST(x'00' || substr(sha256, 2) AS BLOB)");
  EXPECT_EQ(store_->programs.revision("p.nc", 1).error().code, Errc::Corrupt);
}

/// A run keeps the content it was created with, whatever happens to the rows of its revision.
TEST_P(ProgramTest, ARunKeepsItsContentWhenItsRevisionNamesAnother) {
  const auto run = make_run("r1");
  ASSERT_TRUE(store_->runs.create(run));
  ASSERT_TRUE(push("other.nc", "G1 X999.\n"));
  damage("UPDATE revision SET content = (SELECT id FROM content WHERE size = 9)");
  const auto stored = store_->runs.find("r1");
  EXPECT_EQ(stored->content, run.content);
  EXPECT_EQ(stored->size, run.size);
  EXPECT_EQ(pull(stored->content).size(), run.size);
}

TEST_P(ProgramTest, ARunWhoseRowNamesAnotherRevisionWasNotVerified) {
  ASSERT_TRUE(push("p.nc", "G1 X999.\n"));
  auto run = make_run("r1");
  run.content_verified = true;
  run.state = RunState::Completed;
  ASSERT_TRUE(store_->runs.create(run));
  EXPECT_EQ(store_->runs.find("r1")->content_verified, true);
  damage("UPDATE run SET revision = CASE revision WHEN 1 THEN 2 ELSE 1 END");
  EXPECT_EQ(store_->runs.find("r1")->content_verified, false);
  EXPECT_EQ(store_->runs.list({}, {})->at(0).content_verified, false);
}

TEST_P(ProgramTest, AChunkExchangedWhileItIsReadIsRefused) {
  const std::string text = nc_text(800'000);
  const Digest content = push("p.nc", text)->content;
  ASSERT_TRUE(store_->programs.read_content(content, 0, 10));
  change(
      "UPDATE content_chunk SET chunk = (SELECT chunk FROM content_chunk WHERE position = 0), "
      "sha256 = (SELECT sha256 FROM content_chunk WHERE position = 0) WHERE position = 1");
  const auto refused = store_->programs.read_content(content, 300'000, 10);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("chunk 1"), std::string::npos) << refused.error().what;
}

TEST_P(ProgramTest, ADamagedChunkRefusesItselfAlone) {
  const std::string text = nc_text(1'300'000);
  const Digest content = push("p.nc", text)->content;
  damage(
      "UPDATE chunk SET data = substr(data, 1, 100) WHERE id = (SELECT chunk FROM content_chunk "
      "WHERE position = 3)");
  for (const std::uint64_t position : {0, 1, 2, 3, 4}) {  // in order, as it is fed
    const auto bytes = store_->programs.read_content(content, position * 262'144, 10);
    if (position == 3) {
      ASSERT_FALSE(bytes);
      EXPECT_NE(bytes.error().what.find("chunk 3"), std::string::npos) << bytes.error().what;
    } else {
      EXPECT_EQ(text_of(bytes.value()), text.substr(position * 262'144, 10));
    }
  }
}

/// As a version before 4 left it.
TEST_P(ProgramTest, ContentOfAnOlderVersionIsComparedAsAWholeOnce) {
  const std::string text = nc_text(800'000);
  const Digest content = push("p.nc", text)->content;
  damage("UPDATE content SET seal = NULL; UPDATE content_chunk SET sha256 = NULL");
  EXPECT_EQ(text_of(store_->programs.read_content(content, 300'000, 10).value()),
            text.substr(300'000, 10));
  EXPECT_EQ(query("SELECT count(*) FROM content WHERE seal IS NULL"), 0);
  EXPECT_EQ(query("SELECT count(*) FROM content_chunk WHERE sha256 IS NULL"), 0);
  EXPECT_TRUE(store_->programs.verify_content(content));
}

TEST_P(ProgramTest, ContentOfAnOlderVersionWithAnotherListIsRefused) {
  const Digest content = push("p.nc", nc_text(800'000))->content;
  damage(
      "UPDATE content SET seal = NULL; UPDATE content_chunk SET sha256 = NULL;"
      "UPDATE content_chunk SET chunk = (SELECT chunk FROM content_chunk WHERE position = 0) "
      "WHERE position = 1");
  const auto refused = store_->programs.verify_content(content);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Corrupt);
  EXPECT_FALSE(store_->programs.read_content(content, 0, 10));
  EXPECT_EQ(query("SELECT count(*) FROM content WHERE seal IS NOT NULL"), 0);
}

TEST_P(ProgramTest, SequentialReadingDecompressesEveryChunkOnce) {
  const std::string text = nc_text(600'000);
  const Digest content = push("p.nc", text)->content;
  ASSERT_TRUE(store_->programs.read_content(content, 0, 10));
  change("UPDATE chunk SET data = x''");
  EXPECT_TRUE(store_->programs.read_content(content, 10, 10)) << "from the cache";
  EXPECT_FALSE(store_->programs.read_content(content, 262'144, 10)) << "from the file";
}

ON_BOTH_ENGINES(ProgramTest);

}  // namespace
}  // namespace dripline::storage
