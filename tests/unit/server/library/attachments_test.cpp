#include "server/library/attachments.hpp"

#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

TEST(AttachmentName, IsOneForEverySystem) {
  for (const std::string_view good :
       {"setup.pdf", "Zeichnung Größe 4.dxf", "a", "O0200.setup.2.png", "CONSOLE.txt", "com.step"})
    EXPECT_TRUE(library::check_attachment_name(good)) << good;
  for (const std::string_view bad :
       {"",        ".",    "..",          ".htaccess", "../../etc/passwd",
        "a/b",     "a\\b", "C:setup.pdf", "-rf",       " a",
        "a ",      "a.",   "a\nb",        "a\x7f",     "a\"b",
        "a<b>",    "a|b",  "a*",          "a?",        "CON",
        "con.txt", "Lpt1", "\xff\xfe",    "\xc0\xaf",  "gpj\u202Eexe.scr"})
    EXPECT_FALSE(library::check_attachment_name(bad)) << bad;
  EXPECT_FALSE(library::check_attachment_name(std::string_view("a\0b", 3)));
  EXPECT_EQ(library::check_attachment_name(std::string(201, 'a')).error().code,
            Errc::LimitExceeded);
}

TEST(ContentDisposition, SavesUnderTheNameAndEndsNoHeader) {
  EXPECT_EQ(library::content_disposition("setup 1.pdf"),
            "attachment; filename=\"setup 1.pdf\"; filename*=UTF-8''setup%201.pdf");
  EXPECT_EQ(library::content_disposition("Größe;x=\"1\".pdf"),
            "attachment; filename=\"Gr____e_x__1_.pdf\"; "
            "filename*=UTF-8''Gr%C3%B6%C3%9Fe%3Bx%3D%221%22.pdf");
  EXPECT_EQ(library::content_disposition("a\r\nX: 1").find('\n'), std::string::npos);
}

class AttachmentsTest : public ServerTest {};

TEST_F(AttachmentsTest, AnyBytesPassAndAProgramsTextIsStillChecked) {
  push("O1", "M30\n");
  const auto upload =
      attachments_->begin({.name = {"O1", {}, "a.bin"}, .comment = {}}, "anna").value();
  const std::string bytes("\0\xff\x01 binary", 10);
  ASSERT_TRUE(programs_->append(upload.id, 0, bytes_of(bytes.substr(0, 4))));
  ASSERT_TRUE(programs_->append(upload.id, 4, bytes_of(bytes.substr(4))));
  EXPECT_EQ(programs_->commit(upload.id, {}, "anna").error().code, Errc::Conflict);
  const auto attached = attachments_->commit(upload.id, sha256(bytes), "anna");
  ASSERT_TRUE(attached) << attached.error().what;
  EXPECT_EQ(attached->size, bytes.size());
  const std::string id = begin("O2");
  EXPECT_FALSE(programs_->append(id, 0, bytes_of(bytes)));
}

}  // namespace
}  // namespace dripline::server_test
