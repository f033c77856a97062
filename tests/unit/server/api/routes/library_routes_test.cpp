// What is beside the texts of programs: fields, attachments, search, and releases with what a
// program calls.
#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class LibraryRoutes : public ApiTest {
 protected:
  api::Response put(const std::string& target, const Json& body) {
    return call("PUT", target, {.body = body.dump(), .headers = {}});
  }
  /// The answer to the upload that is begun at `target`, with its bytes.
  api::Response attach(const std::string& target, const Json& wanted, const std::string& bytes) {
    const auto upload = post(target, wanted);
    if (upload.status != 201) return upload;
    const std::string path = "/api/v1/uploads/" + json(upload).value("id", "");
    const auto sent = call("PUT", path + "/content?offset=0", {.body = bytes, .headers = {}});
    return sent.status == 200 ? call("POST", path + "/attach") : sent;
  }
  /// Waits until the search has what was pushed.
  Json search(const std::string& query) {
    EXPECT_TRUE(test_support::eventually(
        [&] { return json(get("/api/v1/search?words=x"))["to_be_indexed"] == 0; }));
    return json(get("/api/v1/search?" + query));
  }
  std::string names(const Json& answer) {
    std::string text;
    for (const auto& hit : answer["hits"]) text += hit.value("program", "") + " ";
    return text;
  }
};

TEST_F(LibraryRoutes, FieldsAreSetShownAndChosenBy) {
  push("O1", "M30\n");
  push("O2", "M31\n");
  const auto set = put("/api/v1/programs/O1/fields",
                       {{"part", "4711"}, {"operation", "20"}, {"cam_file", "o1.f3d"}});
  EXPECT_EQ(set.status, 200) << set.body;
  EXPECT_EQ(json(set)["part"], "4711");
  EXPECT_EQ(json(set)["material"], nullptr);
  EXPECT_EQ(json(set)["revisions"][0]["cam_file"], "o1.f3d");
  const Json chosen = json(get("/api/v1/programs?part=4711&state=draft&control=centurion"));
  ASSERT_EQ(chosen["programs"].size(), 1u);
  EXPECT_EQ(chosen["programs"][0]["operation"], "20");
  EXPECT_EQ(json(get("/api/v1/programs?after=O1"))["programs"][0]["name"], "O2");
  expect_error(get("/api/v1/programs?state=done"), 400, "syntax", "done");
  expect_error(put("/api/v1/programs/O1/fields", Json::object()), 400, "syntax", "at least one");
  expect_error(put("/api/v1/programs/O1/fields", {{"part", std::string(201, 'x')}}), 413,
               "limit_exceeded", "200");
  expect_error(put("/api/v1/programs/O1/fields", {{"part", "a\nb"}}), 400, "syntax", "control");
  expect_error(put("/api/v1/programs/O9/fields", {{"part", "1"}}), 404, "not_found", "O9");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["action"], "program.describe");
}

TEST_F(LibraryRoutes, FieldsComeWithAPush) {
  const auto upload =
      post("/api/v1/uploads",
           {{"program", "O1"}, {"control", "centurion"}, {"part", "4711"}, {"cam_file", "a.f3d"}});
  const std::string path = "/api/v1/uploads/" + json(upload).value("id", "");
  ASSERT_EQ(call("PUT", path + "/content?offset=0", {.body = "M30\n", .headers = {}}).status, 200);
  EXPECT_EQ(json(call("POST", path + "/commit"))["cam_file"], "a.f3d");
  EXPECT_EQ(json(get("/api/v1/programs/O1"))["part"], "4711");
}

TEST_F(LibraryRoutes, AttachmentsAreSavedAndNeverShown) {
  push("O1", "M30\n");
  const std::string target = "/api/v1/programs/O1/attachments";
  const std::string html = "<script>alert(1)</script>";
  const auto made = attach(target, {{"name", "Größe 1.html"}, {"revision", 1}}, html);
  ASSERT_EQ(made.status, 201) << made.body;
  EXPECT_EQ(json(made)["sha256"], sha256(html).hex());
  const auto got = get(target + "/Gr%C3%B6%C3%9Fe%201.html?revision=1");
  EXPECT_EQ(got.status, 200);
  EXPECT_EQ(body(got), html);
  EXPECT_EQ(got.content_type, "application/octet-stream");
  EXPECT_EQ(header(got, "X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(header(got, "Content-Security-Policy"), "sandbox; default-src 'none'");
  EXPECT_EQ(header(got, "Content-Disposition"),
            "attachment; filename=\"Gr____e 1.html\"; filename*=UTF-8''Gr%C3%B6%C3%9Fe%201.html");
  const auto part = call("GET", target + "/Gr%C3%B6%C3%9Fe%201.html?revision=1",
                         {.body = {}, .headers = {{"range", "bytes=1-6"}}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(body(part), "script");
  EXPECT_EQ(get(target + "/Gr%C3%B6%C3%9Fe%201.html").status, 404) << "not of the program";
  EXPECT_EQ(json(get(target))["attachments"].size(), 1u);
  expect_error(attach(target, {{"name", "Größe 1.html"}, {"revision", 1}}, "other"), 409,
               "conflict", "other bytes");
}

TEST_F(LibraryRoutes, HostileAttachmentNamesAreRefused) {
  push("O1", "M30\n");
  const std::string target = "/api/v1/programs/O1/attachments";
  for (const std::string name :
       {"../../etc/passwd", "a/b", "..", ".profile", "a\r\nSet-Cookie: x", "CON", "-rf", "a\"b"})
    expect_error(post(target, {{"name", name}}), 400, "syntax", "attachment name");
  EXPECT_EQ(get(target + "/..%2F..%2Fetc%2Fpasswd").status, 404);
  EXPECT_TRUE(json(get(target))["attachments"].empty());
}

TEST_F(LibraryRoutes, AttachmentsAreForProgrammers) {
  push("O1", "M30\n");
  const std::string target = "/api/v1/programs/O1/attachments";
  ASSERT_EQ(attach(target, {{"name", "a.pdf"}}, "x").status, 201);
  const std::string viewer = token_of("viewer"), programmer = token_of("programmer");
  const auto as = [&](const std::string& token, const std::string& method) {
    return call(method, target + "/a.pdf", {.body = {}, .headers = {}, .token = token}).status;
  };
  EXPECT_EQ(as(viewer, "GET"), 200);
  EXPECT_EQ(as(viewer, "DELETE"), 403);
  EXPECT_EQ(as(programmer, "DELETE"), 204);
  EXPECT_EQ(as(programmer, "GET"), 404);
}

TEST_F(LibraryRoutes, SearchNamesTheLineAndPages) {
  push("O1", "O1 (SHAFT)\nG1 X1.\nT12 (ROUGHING TOOL)\n");
  push("O2", "O2 (FLANGE)\nT12\n");
  const Json both = search("words=t12");
  EXPECT_EQ(names(both), "O2 O1 ");
  EXPECT_EQ(both["next"], nullptr);
  const Json one = search("words=T12+rough*");
  ASSERT_EQ(names(one), "O1 ") << one.dump();
  EXPECT_EQ(one["hits"][0]["line"], 3);
  EXPECT_EQ(one["hits"][0]["text"], "T12 (ROUGHING TOOL)");
  const Json first = search("words=t12&limit=1");
  EXPECT_EQ(names(first), "O2 ");
  const Json second = search("words=t12&limit=1&before=" + first["next"].dump());
  EXPECT_EQ(names(second), "O1 ");
  ASSERT_EQ(put("/api/v1/programs/O2/fields", {{"part", "4711"}}).status, 200);
  EXPECT_EQ(names(search("words=4711")), "O2 ");
  EXPECT_EQ(search("words=4711")["hits"][0]["line"], nullptr) << "it is in no line";
  EXPECT_EQ(names(search("words=t12&part=4711&control=centurion&state=draft&author=cam")), "O2 ");
  EXPECT_EQ(names(search("words=t12&author=anna")), "");
  expect_error(get("/api/v1/search"), 400, "syntax", "no word");
  expect_error(get("/api/v1/search?words=t12&limit=101"), 413, "limit_exceeded", "limit");
  expect_error(get("/api/v1/search?words=t12&state=done"), 400, "syntax", "done");
  expect_error(get("/api/v1/search?words=t12&replaced=1"), 400, "syntax", "replaced");
}

TEST_F(LibraryRoutes, AReleaseWithItsClosureShowsWhatItPins) {
  push("O1", "O1\nM98 P2\nM30\n");
  push("O0002", "O2\nM99\n");
  const auto step = [&](const std::string& revision, const std::string& name) {
    return call("POST", "/api/v1/programs/" + revision + "/" + name).status;
  };
  for (const std::string name : {"submit", "approve"}) EXPECT_EQ(step("O1/revisions/1", name), 200);
  const Json with{{"closure", true}};
  expect_error(post("/api/v1/programs/O1/revisions/1/release", with), 409, "conflict",
               "O0002 revision 1 is draft");
  for (const std::string name : {"submit", "approve"})
    EXPECT_EQ(step("O0002/revisions/1", name), 200);
  EXPECT_EQ(post("/api/v1/programs/O1/revisions/1/release", with).status, 200);
  const Json steps = json(get("/api/v1/programs/O1/revisions/1/states"))["steps"];
  EXPECT_EQ(steps[1]["closure"], nullptr);
  ASSERT_EQ(steps[2]["closure"].size(), 1u);
  EXPECT_EQ(steps[2]["closure"][0]["program"], "O0002");
  EXPECT_NE(steps[2]["text"].get<std::string>().find("calls O0002 1 "), std::string::npos);
  EXPECT_EQ(json(get("/api/v1/programs/O0002"))["state"], "released");
  const Json entries = json(get("/api/v1/audit"))["entries"];
  EXPECT_NE(entries[0]["detail"].get<std::string>().find("pins O0002@1"), std::string::npos);
  expect_error(post("/api/v1/programs/O1/revisions/1/release", {{"with", {"O2"}}}), 400, "syntax",
               "closure");
  expect_error(
      post("/api/v1/programs/O1/revisions/1/release", {{"closure", true}, {"with", {"O2@x"}}}), 400,
      "syntax", "with");
  expect_error(get("/api/v1/programs/O1/closure?with=a,,b"), 400, "syntax", "with");
}

}  // namespace
}  // namespace dripline::server_test
