// Programs over the API: kept through uploads, listed, given, copied, renamed and removed.
#include "tests/unit/server/api/api_fixture.hpp"

#include "server/api/views.hpp"

namespace dripline::server_test {
namespace {

TEST_F(ApiHandlers, TakeAProgramThroughAnUpload) {
  const auto upload = post("/api/v1/uploads", {{"program", "O1"}, {"control", "centurion"}});
  ASSERT_EQ(upload.status, 201) << upload.body;
  EXPECT_EQ(json(upload)["max_piece"], api::Api::kMaxPiece);
  const std::string path = "/api/v1/uploads/" + json(upload).value("id", "");
  const auto piece = call("PUT", path + "/content?offset=0", {.body = "O1\nM30\n", .headers = {}});
  ASSERT_EQ(piece.status, 200) << piece.body;
  EXPECT_EQ(json(get(path))["received"], 7);
  const auto commit = post(path + "/commit", {{"sha256", sha256("O1\nM30\n").hex()}});
  ASSERT_EQ(commit.status, 201) << commit.body;
  EXPECT_EQ(json(commit)["revision"], 1);
  EXPECT_EQ(json(commit)["author"], "admin");
  EXPECT_FALSE(json(commit).contains("unchanged"));
}

TEST_F(ApiHandlers, SayThatACommitChangedNothing) {
  push("O1", "O1\n");
  const auto upload = post("/api/v1/uploads", {{"program", "O1"}, {"control", "centurion"}});
  const std::string path = "/api/v1/uploads/" + json(upload).value("id", "");
  call("PUT", path + "/content?offset=0", {.body = "O1\n", .headers = {}});
  const auto commit = call("POST", path + "/commit");
  EXPECT_EQ(commit.status, 200) << commit.body;
  EXPECT_EQ(json(commit)["unchanged"], true);
}

TEST_F(ApiHandlers, RefusePiecesThatAreTooLongOrWithoutAPlace) {
  const auto upload = post("/api/v1/uploads", {{"program", "O1"}, {"control", "centurion"}});
  const std::string path = "/api/v1/uploads/" + json(upload).value("id", "") + "/content";
  expect_error(call("PUT", path, {.body = "X", .headers = {}}), 400, "syntax", "offset");
  expect_error(call("PUT", path + "?offset=-1", {.body = "X", .headers = {}}), 400, "syntax", "-1");
  expect_error(call("PUT", path + "?offset=0",
                    {.body = std::string(api::Api::kMaxPiece + 1, 'X'), .headers = {}}),
               413, "limit_exceeded", "4194304");
}

TEST_F(ApiHandlers, ListAndShowPrograms) {
  push("O1", "one\n");
  push("O1", "two\n");
  push("O2", "three\n");
  const Json list = json(get("/api/v1/programs"))["programs"];
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["name"], "O1");
  EXPECT_EQ(list[0]["revisions"], 2);
  EXPECT_EQ(json(get("/api/v1/programs?limit=1&offset=1"))["programs"][0]["name"], "O2");
  const Json program = json(get("/api/v1/programs/O1"));
  EXPECT_EQ(program["revisions"].size(), 2u);
  expect_error(get("/api/v1/programs/O9"), 404, "not_found", "O9");
}

TEST_F(ApiHandlers, RefuseListingsWithBadPages) {
  expect_error(get("/api/v1/programs?limit=1001"), 413, "limit_exceeded", "1000");
  expect_error(get("/api/v1/programs?limit=x"), 400, "syntax", "limit");
  expect_error(get("/api/v1/programs?color=red"), 400, "syntax", "color");
}

TEST_F(ApiHandlers, RemoveAProgramAndAuditIt) {
  push("O1", "one\n");
  EXPECT_EQ(call("DELETE", "/api/v1/programs/O1").status, 204);
  expect_error(get("/api/v1/programs/O1"), 404, "not_found", "O1");
  expect_error(call("DELETE", "/api/v1/programs/O1"), 404, "not_found", "O1");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["action"], "program.remove");
}

TEST_F(ApiHandlers, GiveContentInPieces) {
  std::string text;
  while (text.size() < 700'000) text += fmt::format("N{} G01 X1\n", text.size());
  push("O1", text);
  const auto response = get("/api/v1/programs/O1/content");
  EXPECT_EQ(response.source_length, text.size());
  EXPECT_EQ(header(response, "Dripline-Sha256"), sha256(text).hex());
  EXPECT_EQ(header(response, "Dripline-Revision"), "1");
  EXPECT_EQ(header(response, "Dripline-Size"), std::to_string(text.size()));
  EXPECT_EQ(body(response), text);
}

TEST_F(ApiHandlers, GiveARangeOfTheContent) {
  push("O1", "0123456789");
  const auto response = call("GET", "/api/v1/programs/O1/content?revision=1",
                             {.body = {}, .headers = {{"range", "bytes=3-5"}}});
  EXPECT_EQ(response.status, 206);
  EXPECT_EQ(header(response, "Content-Range"), "bytes 3-5/10");
  EXPECT_EQ(body(response), "345");
  const auto outside =
      call("GET", "/api/v1/programs/O1/content", {.body = {}, .headers = {{"range", "bytes=10-"}}});
  expect_error(outside, 416, "limit_exceeded", "10 bytes");
  EXPECT_EQ(header(outside, "Content-Range"), "bytes */10");
}

/// CEN-211.
TEST_F(ApiTest, CopiesAndRenamesPrograms) {
  push("O0001", "O0001 (BUSH)\nM30\n");
  const auto copied = post("/api/v1/programs/O0001/copy", {{"to", "O0002"}});
  ASSERT_EQ(copied.status, 201) << copied.body;
  EXPECT_EQ(json(copied)["program"], "O0002");
  EXPECT_EQ(json(copied)["revision"], 1);
  EXPECT_EQ(json(copied)["comment"], "copy of O0001 revision 1");
  const auto renamed = post("/api/v1/programs/O0001/rename", {{"to", "O0003"}});
  ASSERT_EQ(renamed.status, 200) << renamed.body;
  EXPECT_EQ(json(renamed)["name"], "O0003");
  EXPECT_EQ(json(renamed)["revisions"].size(), 1u);
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["who"], "admin");
  expect_error(post("/api/v1/programs/O0003/copy", {{"to", "O0002"}}), 409, "conflict",
               "O0002 exists already");
  expect_error(post("/api/v1/programs/O0009/rename", {{"to", "O0010"}}), 404, "not_found", "O0009");
  expect_error(post("/api/v1/programs/O0003/rename", {{"to", ".hidden"}}), 400, "syntax",
               ".hidden");
  expect_error(post("/api/v1/programs/O0003/copy", Json::object()), 400, "syntax", "'to'");
}

/// CEN-212.
TEST_F(ApiTest, ShowsWhatProgramsCallThemselves) {
  push("O0001", "O0001 (BUSH 12)\nM30\n");
  push("O0002", "O0002\nM30\n");
  const Json list = json(get("/api/v1/programs"))["programs"];
  EXPECT_EQ(list[0]["title"], "BUSH 12");
  EXPECT_TRUE(list[1]["title"].is_null());
  EXPECT_EQ(json(get("/api/v1/programs/O0001"))["revisions"][0]["title"], "BUSH 12");
}

/// CEN-213: for operators who know the control's messages.
TEST_F(ApiTest, RefusesMovesOfProgramsInTheWordsOfTheirControlToo) {
  push("O0001", "O0001\n");
  push("O0002", "O0002\n");
  push("1.h", "0 BEGIN PGM 1 MM\n", "tnc155");
  const auto message = [&](const std::string& from, const std::string& to) {
    const auto refused = post("/api/v1/programs/" + from + "/rename", {{"to", to}});
    return json(refused)["error"].value("message", "");
  };
  EXPECT_EQ(message("O0001", "O0002"),
            "program O0002 exists already, with 1 revision (centurion error 300: program already "
            "exists)");
  EXPECT_NE(message("O0001", "O0001").find("(centurion error 309: can't copy or rename"),
            std::string::npos);
  EXPECT_EQ(message("1.h", "O0002"), "program O0002 exists already, with 1 revision")
      << "another control has no such number";
}

}  // namespace
}  // namespace dripline::server_test
