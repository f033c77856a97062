#include <random>

#include "storage/programs/chunk_codec.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class UploadTest : public ContractTest {};

struct PieceCase {
  const char* name;
  std::size_t size, piece;
  friend void PrintTo(const PieceCase& c, std::ostream* out) { *out << c.name; }
};
class AnyPieces : public ContractTestOf<PieceCase> {};

TEST_P(AnyPieces, GiveBackTheVeryBytes) {
  const std::string text = nc_text(given().size);
  const auto revision = push("p.nc", text, given().piece);
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(revision->content, sha256(text));
  EXPECT_EQ(revision->size, text.size());
  EXPECT_EQ(pull(revision->content), text);
}

TEST_P(AnyPieces, GiveTheSameChunksAsOnePiece) {
  const std::string text = nc_text(given().size);
  ASSERT_TRUE(push("p.nc", text, given().piece));
  const auto chunks = query("SELECT count(*) FROM chunk");
  ASSERT_TRUE(push("q.nc", text, text.size()));
  EXPECT_EQ(query("SELECT count(*) FROM chunk"), chunks);
  EXPECT_EQ(query("SELECT count(*) FROM content"), 1);
}

ON_BOTH_ENGINES_WITH(AnyPieces, PieceCase{"one_byte", 1, 1},
                     PieceCase{"one_chunk_exactly", 262144, 262144},
                     PieceCase{"two_chunks_in_odd_pieces", 524288, 100'003},
                     PieceCase{"one_byte_over_a_chunk", 262145, 262144},
                     PieceCase{"many_small", 300'000, 4'099},
                     PieceCase{"bigger_than_chunks", 3'000'001, 1'000'000});

TEST_P(UploadTest, ContinuesAfterARestartWhereItStopped) {
  const std::string text = nc_text(1'000'000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text).first(400'000)));
  reopen();
  const auto found = store_->uploads.find(id);
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_EQ(found->received, 400'000u);
  EXPECT_EQ(found->program, "p.nc");
  EXPECT_EQ(found->author, "cam");
  const auto appended = store_->uploads.append(id, 400'000, bytes_of(text).subspan(400'000));
  ASSERT_TRUE(appended) << appended.error().what;
  EXPECT_EQ(appended->received, text.size());
  const auto revision = store_->uploads.commit(id, sha256(text));
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(pull(revision->content), text);
}

TEST_P(UploadTest, CanBeCommittedAfterARestart) {
  const std::string text = nc_text(600'000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text)));
  reopen();
  EXPECT_TRUE(store_->uploads.commit(id, sha256(text)));
}

TEST_P(UploadTest, PieceSentAgainIsNoError) {
  const std::string text = nc_text(700'000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text).first(500'000)));
  const auto again = store_->uploads.append(id, 100'000, bytes_of(text).subspan(100'000, 400'000));
  ASSERT_TRUE(again) << again.error().what;
  EXPECT_EQ(again->received, 500'000u);
  ASSERT_TRUE(store_->uploads.append(id, 500'000, bytes_of(text).subspan(500'000)));
  EXPECT_TRUE(store_->uploads.commit(id, sha256(text)));
}

/// What failed in the middle was stored up to some place.
TEST_P(UploadTest, APieceOfWhichAPartIsStoredIsCompleted) {
  const std::string text = nc_text(1'000'000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text).first(500'000)));
  const auto again = store_->uploads.append(id, 200'000, bytes_of(text).subspan(200'000));
  ASSERT_TRUE(again) << again.error().what;
  EXPECT_EQ(again->received, text.size());
  ASSERT_TRUE(store_->uploads.commit(id, sha256(text)));
  EXPECT_EQ(pull(sha256(text)), text);
}

/// Records of machines and the lease are not kept waiting by a big piece.
TEST_P(UploadTest, APieceIsStoredInTransactionsOfFewBytes) {
  std::mt19937 random(7);  // nothing of it is compressed
  std::string text(2 << 20, '\0');
  for (char& c : text) c = static_cast<char>(random() & 0xff);
  change(engine_ == sql::Engine::Sqlite
             ? "CREATE TRIGGER full BEFORE INSERT ON content_chunk WHEN (SELECT count(*) FROM "
               "content_chunk) >= 5 BEGIN SELECT RAISE(ABORT, 'full'); END"
             : "CREATE FUNCTION be_full() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN IF (SELECT "
               "count(*) FROM content_chunk) >= 5 THEN RAISE 'full'; END IF; RETURN NEW; END $$; "
               "CREATE TRIGGER full_up BEFORE INSERT ON content_chunk FOR EACH ROW EXECUTE "
               "FUNCTION be_full()");
  const std::string id = begin("p.nc");
  ASSERT_FALSE(store_->uploads.append(id, 0, bytes_of(text)));
  EXPECT_EQ(store_->uploads.find(id)->received, 5 * kChunkBytes) << "what was before it is there";
}

TEST_P(UploadTest, RefusesGapsAndOtherBytes) {
  const std::string text = nc_text(1000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text).first(500)));
  for (const auto& [offset, piece] :
       {std::pair(501, text.substr(501)), std::pair(499, text.substr(500)),
        std::pair(0, std::string("other"))}) {
    const auto refused =
        store_->uploads.append(id, static_cast<std::uint64_t>(offset), bytes_of(piece));
    ASSERT_FALSE(refused) << offset;
    EXPECT_EQ(refused.error().code, Errc::Conflict) << refused.error().what;
  }
  EXPECT_EQ(store_->uploads.find(id)->received, 500u);
}

TEST_P(UploadTest, WrongExpectedDigestIsCorruptAndChangesNothing) {
  const std::string text = nc_text(1000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text)));
  const auto refused = store_->uploads.commit(id, sha256("something else"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Corrupt);
  EXPECT_NE(refused.error().what.find(sha256(text).hex()), std::string::npos);
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt).error().code, Errc::NotFound);
  EXPECT_TRUE(store_->uploads.commit(id, sha256(text)));
}

TEST_P(UploadTest, EmptyUploadIsRefused) {
  EXPECT_EQ(store_->uploads.commit(begin("p.nc"), std::nullopt).error().code, Errc::Syntax);
}

TEST_P(UploadTest, NamesThatLeaveTheirFolderAreRefused) {
  for (const char* name : {"../etc/passwd", "..", "a/b", "", ".hidden", "a\nb"}) {
    Upload upload;
    upload.program = name;
    EXPECT_EQ(store_->uploads.begin(upload).error().code, Errc::Syntax) << name;
  }
  Upload upload;
  upload.program = std::string(129, 'a');
  EXPECT_EQ(store_->uploads.begin(upload).error().code, Errc::LimitExceeded);
  EXPECT_EQ(query("SELECT count(*) FROM upload"), 0);
}

TEST_P(UploadTest, UnknownOnesAreNotFound) {
  EXPECT_EQ(store_->uploads.find("x").error().code, Errc::NotFound);
  EXPECT_EQ(store_->uploads.append("x", 0, bytes_of("a")).error().code, Errc::NotFound);
  EXPECT_EQ(store_->uploads.read("x", 0, 1).error().code, Errc::NotFound);
  EXPECT_EQ(store_->uploads.set_control("x", "tnc155").error().code, Errc::NotFound);
  EXPECT_EQ(store_->uploads.commit("x", std::nullopt).error().code, Errc::NotFound);
  EXPECT_EQ(store_->uploads.abandon("x").error().code, Errc::NotFound);
}

TEST_P(UploadTest, TooBigAPieceIsRefused) {
  const std::vector<std::byte> huge((16 << 20) + 1);
  EXPECT_EQ(store_->uploads.append(begin("p.nc"), 0, huge).error().code, Errc::LimitExceeded);
}

TEST_P(UploadTest, CanBeReadAndGivenAControlBeforeItIsCommitted) {
  const std::string text = nc_text(300'000);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(text)));
  EXPECT_EQ(text_of(store_->uploads.read(id, 262'000, 1000).value()), text.substr(262'000, 1000));
  EXPECT_EQ(text_of(store_->uploads.read(id, 299'990, 1000).value()), text.substr(299'990));
  EXPECT_TRUE(store_->uploads.read(id, 300'000, 1)->empty());
  ASSERT_TRUE(store_->uploads.set_control(id, "tnc155"));
  EXPECT_EQ(store_->uploads.commit(id, std::nullopt)->control, "tnc155");
}

TEST_P(UploadTest, AbandonedOneLeavesNoChunkButThoseOthersHold) {
  const std::string shared = nc_text(262'144, 1);
  const auto kept = push("kept.nc", shared);
  const std::string id = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of(shared + nc_text(500'000, 2))));
  EXPECT_GT(query("SELECT count(*) FROM chunk"), 1);
  ASSERT_TRUE(store_->uploads.abandon(id));
  EXPECT_EQ(query("SELECT count(*) FROM chunk"), 1);
  EXPECT_EQ(query("SELECT count(*) FROM content"), 1);
  EXPECT_EQ(pull(kept->content), shared);
  EXPECT_EQ(store_->uploads.append(id, 0, bytes_of("a")).error().code, Errc::NotFound);
}

TEST_P(UploadTest, ForgottenOnesAreDroppedByTheirLastPiece) {
  using std::chrono::hours;
  const std::string forgotten = begin("a.nc");
  ASSERT_TRUE(store_->uploads.append(forgotten, 0, bytes_of("G0 X1\n")));
  const std::string living = begin("b.nc");
  EXPECT_EQ(store_->uploads.drop_idle(hours(24), hours(24)), 0u);
  ASSERT_TRUE(store_->uploads.append(living, 0, bytes_of("G0 X2\n")));
  clock_.advance(hours(55));  // a step of the time of day is no time that passes
  EXPECT_EQ(store_->uploads.drop_idle(hours(0), hours(24)), 0u);
  EXPECT_EQ(store_->uploads.drop_idle(hours(1), hours(24)), 1u);
  EXPECT_EQ(store_->uploads.find(forgotten).error().code, Errc::NotFound);
  EXPECT_TRUE(store_->uploads.append(living, 6, bytes_of("M30\n")));
  EXPECT_EQ(query("SELECT count(*) FROM chunk"), 1);
}

TEST_P(UploadTest, RepeatedBytesAreStoredOnce) {
  const auto revision = push("nul.nc", std::string(8 << 20, '\0'), 4 << 20);
  ASSERT_TRUE(revision);
  EXPECT_EQ(query("SELECT count(*) FROM chunk"), 1);
  EXPECT_EQ(pull(revision->content), std::string(8 << 20, '\0'));
}

ON_BOTH_ENGINES(UploadTest);

}  // namespace
}  // namespace dripline::storage
