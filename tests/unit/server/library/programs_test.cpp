#include "server/library/programs.hpp"

#include "server/library/control_catalog.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

using namespace std::string_literals;

class ProgramsTest : public ServerTest {};

TEST_F(ProgramsTest, StoreAnUploadAsARevisionAndAuditIt) {
  const auto revision = push("O1.nc", "O1\nM30\n");
  EXPECT_EQ(revision.number, 1u);
  EXPECT_EQ(revision.control, "centurion");
  EXPECT_EQ(revision.content, sha256("O1\nM30\n"));
  const auto entries = audit_->entries({});
  ASSERT_TRUE(entries && entries->size() == 1);
  EXPECT_EQ(entries->front().who.name, "cam");
  EXPECT_EQ(entries->front().action, "program.store");
  EXPECT_EQ(entries->front().subject, "O1.nc");
}

TEST_F(ProgramsTest, ReportThatTheContentIsTheLatestAlready) {
  push("O1", "O1\n");
  const std::string id = begin("O1");
  ASSERT_TRUE(programs_->append(id, 0, bytes_of("O1\n")));
  const auto again = programs_->commit(id, std::nullopt, "cam");
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->is_unchanged);
  EXPECT_EQ(again->revision.number, 1u);
}

TEST_F(ProgramsTest, DropTheUploadAtItsFirstBadByteAndChangeNothing) {
  const std::string id = begin("O1");
  ASSERT_TRUE(programs_->append(id, 0, bytes_of("O1\n")));
  const auto bad = programs_->append(id, 3, bytes_of("X\0"s));
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, Errc::Syntax);
  EXPECT_NE(bad.error().what.find("offset 4, line 2"), std::string::npos) << bad.error().what;
  EXPECT_EQ(programs_->append(id, 3, bytes_of("Y")).error().code, Errc::NotFound);
  EXPECT_TRUE(programs_->list({}, {})->empty());
}

TEST_F(ProgramsTest, RefuseAnEmptyUploadAtCommit) {
  const std::string id = begin("O1");
  const auto committed = programs_->commit(id, std::nullopt, "cam");
  ASSERT_FALSE(committed);
  EXPECT_EQ(committed.error().code, Errc::Syntax);
  EXPECT_NE(committed.error().what.find("empty"), std::string::npos);
  EXPECT_FALSE(programs_->upload(id, "cam"));
}

TEST_F(ProgramsTest, GoOnCheckingAnUploadAfterARestart) {
  const std::string id = begin("O1");
  ASSERT_TRUE(programs_->append(id, 0, bytes_of("O1\n" + std::string(40'000, 'X'))));
  reopen();
  const auto bad = programs_->append(id, 40'003, bytes_of(std::string(40'000, 'X')));
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, Errc::LimitExceeded);
  EXPECT_NE(bad.error().what.find("line 2"), std::string::npos) << bad.error().what;
}

TEST_F(ProgramsTest, TakeAPieceTwice) {
  const std::string id = begin("O1");
  ASSERT_TRUE(programs_->append(id, 0, bytes_of("O1\n")));
  ASSERT_TRUE(programs_->append(id, 0, bytes_of("O1\n")));
  const auto upload = programs_->append(id, 3, bytes_of("M30\n"));
  ASSERT_TRUE(upload) << upload.error().what;
  EXPECT_EQ(upload->received, 7u);
  EXPECT_EQ(programs_->append(id, 9, bytes_of("X")).error().code, Errc::Conflict);
}

TEST_F(ProgramsTest, NameTheKnownControlsWhenOneIsUnknown) {
  const auto upload = programs_->begin({.program = "O1", .control = "fagor", .comment = {}}, "cam");
  ASSERT_FALSE(upload);
  EXPECT_EQ(upload.error().code, Errc::Unsupported);
  EXPECT_NE(upload.error().what.find("centurion, tnc155"), std::string::npos);
}

TEST_F(ProgramsTest, FindTheControlInTheText) {
  EXPECT_EQ(push("a", "%C\nM30\n", "").control, "centurion");
}

TEST_F(ProgramsTest, AskForAControlWhenTheTextDoesNotTell) {
  for (const std::string text : {"M30\n", "%2\nM30\n"}) {
    const std::string id = begin("a", "");
    ASSERT_TRUE(programs_->append(id, 0, bytes_of(text)));
    const auto committed = programs_->commit(id, std::nullopt, "cam");
    ASSERT_FALSE(committed);
    EXPECT_EQ(committed.error().code, Errc::Unsupported);
    EXPECT_NE(committed.error().what.find("name"), std::string::npos);
  }
  EXPECT_TRUE(programs_->list({}, {})->empty());
}

TEST_F(ProgramsTest, AskForAControlAsSoonAsTheHeadIsThere) {
  const std::string id = begin("a", "");
  std::string head;
  while (head.size() < library::Programs::kHead) head += "G01 X1.0 Z2.0\n";
  const auto refused = programs_->append(id, 0, bytes_of(head));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
}

TEST_F(ProgramsTest, RefuseNamesThatLeaveTheirFolder) {
  const auto upload = programs_->begin({.program = "../O1", .control = {}, .comment = {}}, "cam");
  ASSERT_FALSE(upload);
  EXPECT_EQ(upload.error().code, Errc::Syntax);
  EXPECT_NE(upload.error().what.find("../O1"), std::string::npos);
}

// HD-056: the control refuses to change or erase such a program.
TEST_F(ProgramsTest, KeepAProtectedProgramUntilTheCallerInsists) {
  push("7", "%2 LOCKED\nA\n", "tnc155");
  const auto replace = [&](std::string_view text, library::Protection protection) {
    const std::string id = begin("7", "tnc155");
    EXPECT_TRUE(programs_->append(id, 0, bytes_of(text)));
    return programs_->commit(id, sha256(text), "cam", protection);
  };
  const auto refused = replace("%2 LOCKED\nB\n", library::Protection::Respect);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_EQ(refused.error().what,
            "program '7' is refused: revision 1 is protected against change and erasure; force "
            "overrides that; nothing was changed");
  EXPECT_EQ(programs_->revision("7", std::nullopt)->number, 1u);
  EXPECT_TRUE(replace("%2 LOCKED\nA\n", library::Protection::Respect)->is_unchanged);
  EXPECT_EQ(programs_->remove("7", "cam").error().code, Errc::Conflict);

  EXPECT_TRUE(replace("%2 free\n", library::Protection::Override));
  EXPECT_TRUE(replace("%2 LOCKED\n", library::Protection::Respect));
  EXPECT_TRUE(programs_->remove("7", "cam", library::Protection::Override));
}

// HD-056
TEST(DialectCatalog, KnowsTheMarksOfProtectedPrograms) {
  const library::DialectCatalog catalog;
  EXPECT_TRUE(catalog.is_protected("tnc155", "0 BEGIN PGM 7 MM P\n1 CC\n"));
  EXPECT_FALSE(catalog.is_protected("tnc155", "0 BEGIN PGM 7 MM\n1 CC\n"));
  EXPECT_TRUE(catalog.is_protected("tnc155", "%7 G71 G50 *\nN1 G29 *\n"));
  EXPECT_FALSE(catalog.is_protected("tnc155", "%7 G71 *\nN1 G29 *\n"));
  EXPECT_FALSE(catalog.is_protected("centurion", "O7 P\n"));
  EXPECT_FALSE(catalog.is_protected("", ""));
}

TEST_F(ProgramsTest, StayForTheirControlUnlessItIsNamed) {
  push("P", "%C 1\n", "tnc155");
  EXPECT_EQ(push("P", "nothing shows it\n", "").control, "tnc155");
  const std::string id = begin("P", "");
  ASSERT_TRUE(programs_->append(id, 0, bytes_of("%C 2\n")));
  const auto refused = programs_->commit(id, std::nullopt, "cam");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("is for control tnc155, this text looks like one for "
                                      "centurion"),
            std::string::npos)
      << refused.error().what;
  const auto other = push("P", "nothing shows it\n", "centurion");
  EXPECT_EQ(other.number, 3u) << "the same text for another control is no repetition";
  EXPECT_EQ(other.control, "centurion");
}

}  // namespace
}  // namespace dripline::server_test
