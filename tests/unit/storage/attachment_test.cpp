#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class AttachmentTest : public ContractTest {
 protected:
  std::string begin_attachment(const std::string& program, const std::string& name,
                               std::optional<std::uint64_t> revision = {}) {
    Upload upload;
    upload.program = program;
    upload.comment = "first side";
    upload.author = "anna";
    upload.attachment = name;
    upload.attachment_revision = revision;
    const auto begun = store_->uploads.begin(upload);
    EXPECT_TRUE(begun) << begun.error().what;
    return begun ? begun->id : "";
  }
  Result<Attachment> attach(const std::string& program, const std::string& name,
                            std::string_view bytes, std::optional<std::uint64_t> revision = {}) {
    const std::string id = begin_attachment(program, name, revision);
    const auto appended = store_->uploads.append(id, 0, bytes_of(bytes));
    if (!appended) return fail(appended.error());
    return store_->attachments.commit(id, sha256(bytes), {"anna", "t", "192.0.2.1"});
  }
  std::vector<std::string> names(std::optional<std::uint64_t> revision = {}) {
    std::vector<std::string> found;
    const auto attachments = store_->attachments.list("p.nc", revision);
    EXPECT_TRUE(attachments) << attachments.error().what;
    for (const auto& attachment : *attachments) found.push_back(attachment.name);
    return found;
  }
  using Names = std::vector<std::string>;
};

constexpr std::string_view kPdf{"%PDF-1.7\n\0\xff\x01", 12};

TEST_P(AttachmentTest, KeepsAnyBytesAndWhoseTheyAre) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  const auto sheet = attach("p.nc", "setup.pdf", kPdf);
  ASSERT_TRUE(sheet) << sheet.error().what;
  EXPECT_EQ(sheet->size, kPdf.size());
  EXPECT_EQ(sheet->author, "anna");
  EXPECT_EQ(sheet->comment, "first side");
  EXPECT_FALSE(sheet->revision);
  EXPECT_EQ(pull(sheet->content), kPdf);
  EXPECT_EQ(store_->attachments.find({"p.nc", {}, "setup.pdf"})->content, sheet->content);
  const auto entry = store_->audit.list({.limit = 1, .offset = 0}).value().front();
  EXPECT_EQ(entry.action, "program.attach");
  EXPECT_EQ(entry.who.address, "192.0.2.1");
  EXPECT_EQ(store_->programs.revisions("p.nc")->size(), 1u) << "it is no revision";
}

TEST_P(AttachmentTest, BelongsToAProgramOrToOneRevision) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  ASSERT_TRUE(push("p.nc", "M31\n"));
  ASSERT_TRUE(attach("p.nc", "setup.pdf", "a"));
  ASSERT_TRUE(attach("p.nc", "setup.pdf", "b", 2));
  ASSERT_TRUE(attach("p.nc", "drawing.png", "c", 1));
  EXPECT_EQ(names(), (Names{"setup.pdf", "drawing.png", "setup.pdf"}));
  EXPECT_EQ(names(1), (Names{"setup.pdf", "drawing.png"}));
  EXPECT_EQ(names(2), (Names{"setup.pdf", "setup.pdf"}));
  EXPECT_EQ(store_->attachments.find({"p.nc", 1, "setup.pdf"}).error().code, Errc::NotFound);
  EXPECT_EQ(store_->attachments.list("p.nc", 3).error().code, Errc::NotFound);
  EXPECT_EQ(store_->attachments.list("q.nc", {}).error().code, Errc::NotFound);
  Upload upload;
  upload.program = "q.nc";
  upload.attachment = "x";
  EXPECT_EQ(store_->uploads.begin(upload).error().code, Errc::NotFound);
  EXPECT_FALSE(store_->programs.revisions("q.nc")) << "nothing was made by asking";
}

TEST_P(AttachmentTest, IsNotReplacedByOtherBytes) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  ASSERT_TRUE(attach("p.nc", "setup.pdf", "a"));
  EXPECT_TRUE(attach("p.nc", "setup.pdf", "a")) << "the same again";
  const auto other = attach("p.nc", "setup.pdf", "b");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, Errc::Conflict);
  EXPECT_EQ(names(), Names{"setup.pdf"});
}

TEST_P(AttachmentTest, RemovalTakesItsBytesUnlessOthersHaveThem) {
  const auto revision = push("p.nc", "M30\n");
  ASSERT_TRUE(attach("p.nc", "a.pdf", kPdf));
  ASSERT_TRUE(attach("p.nc", "b.pdf", kPdf));
  ASSERT_TRUE(attach("p.nc", "text.nc", "M30\n"));
  const Actor who{"anna", "", ""};
  ASSERT_TRUE(store_->attachments.remove({"p.nc", {}, "a.pdf"}, who));
  EXPECT_EQ(pull(sha256(kPdf)), kPdf) << "b.pdf has them";
  ASSERT_TRUE(store_->attachments.remove({"p.nc", {}, "b.pdf"}, who));
  EXPECT_EQ(query("SELECT count(*) FROM content"), 1);
  EXPECT_EQ(query("SELECT count(*) FROM chunk"), 1);
  ASSERT_TRUE(store_->attachments.remove({"p.nc", {}, "text.nc"}, who));
  EXPECT_EQ(pull(revision->content), "M30\n") << "the revision has them";
  EXPECT_EQ(store_->attachments.remove({"p.nc", {}, "text.nc"}, who).error().code, Errc::NotFound);
  EXPECT_EQ(store_->audit.list({.limit = 1, .offset = 0})->front().action, "program.detach");
}

TEST_P(AttachmentTest, UploadsAreOfOneKind) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  const std::string attachment = begin_attachment("p.nc", "a.pdf");
  ASSERT_TRUE(store_->uploads.append(attachment, 0, bytes_of("M30\n")));
  EXPECT_EQ(store_->uploads.commit(attachment, {}).error().code, Errc::Conflict);
  const std::string text = begin("p.nc");
  ASSERT_TRUE(store_->uploads.append(text, 0, bytes_of("M31\n")));
  EXPECT_EQ(store_->attachments.commit(text, {}, {}).error().code, Errc::Conflict);
  reopen();
  EXPECT_EQ(store_->uploads.find(attachment)->attachment, "a.pdf") << "over a restart";
  EXPECT_TRUE(store_->attachments.commit(attachment, sha256("M30\n"), {}));
  EXPECT_EQ(store_->attachments.commit(attachment, {}, {}).error().code, Errc::NotFound);
}

TEST_P(AttachmentTest, HasLimits) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  const std::string id = begin_attachment("p.nc", "big.step");
  damage("UPDATE content SET size = " + std::to_string(AttachmentStore::kMaxAttachmentBytes) +
         " WHERE sha256 IS NULL");
  const auto over = store_->uploads.append(id, AttachmentStore::kMaxAttachmentBytes, bytes_of("x"));
  ASSERT_FALSE(over);
  damage(
      "WITH RECURSIVE n(i) AS (VALUES (1) UNION ALL SELECT i + 1 FROM n WHERE i < 200) "
      "INSERT INTO attachment (program, name, content, sha256, comment, author, created_us) "
      "SELECT 1, 'n' || i, 1, zeroblob(32), '', '', 0 FROM n");
  EXPECT_EQ(attach("p.nc", "one-more", "x").error().code, Errc::LimitExceeded);
}

TEST_P(AttachmentTest, GoesWithItsProgram) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  ASSERT_TRUE(attach("p.nc", "a.pdf", "a"));
  ASSERT_TRUE(attach("p.nc", "b.pdf", "b", 1));
  ASSERT_TRUE(store_->programs.rename({.from = "p.nc", .to = "q.nc", .who = {}}));
  EXPECT_EQ(store_->attachments.list("q.nc", {})->size(), 2u);
  ASSERT_TRUE(store_->programs.remove("q.nc"));
  EXPECT_FALSE(store_->attachments.list("q.nc", {}));
  ASSERT_TRUE(push("q.nc", "M99\n"));
  EXPECT_TRUE(store_->attachments.list("q.nc", {})->empty()) << "another program";
}

ON_BOTH_ENGINES(AttachmentTest);

}  // namespace
}  // namespace dripline::storage
