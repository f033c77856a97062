#include "server/web/page.hpp"

#include <algorithm>
#include <array>

namespace dripline::web {
namespace {

constexpr std::array kAssets{
    Asset{.path = "", .content_type = "text/html", .etag = "\"11\"", .gzip = "PAGE"},
    Asset{.path = "assets/a-1.js",
          .content_type = "text/javascript",
          .etag = "\"22\"",
          .gzip = "JS"}};

api::Request request(const std::string& path, const std::string& method = "GET") {
  api::Request head;
  head.method = method;
  head.target = api::parse_target(path).value();
  head.headers["accept-encoding"] = "gzip, br";
  return head;
}

std::string header(const api::Response& response, std::string_view name) {
  const auto found = std::ranges::find(
      response.headers, name, [](const auto& field) { return std::string_view(field.first); });
  return found == response.headers.end() ? "" : found->second;
}

class PageTest : public testing::Test {
 protected:
  Page page_{kAssets};
};

TEST_F(PageTest, IsSentCompressedAndAskedForEachTime) {
  const auto answer = page_.answer(request("/"));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->body, "PAGE");
  EXPECT_EQ(header(*answer, "Content-Encoding"), "gzip");
  EXPECT_EQ(header(*answer, "Cache-Control"), "no-cache");
}

TEST_F(PageTest, AssetsAreKeptForever) {
  const auto answer = page_.answer(request("/assets/a-1.js"));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->body, "JS");
  EXPECT_EQ(answer->content_type, "text/javascript");
  EXPECT_EQ(header(*answer, "Cache-Control"), "public, max-age=31536000, immutable");
}

TEST_F(PageTest, WhatTheBrowserHasIsNotSentAgain) {
  auto head = request("/");
  head.headers["if-none-match"] = R"("00", W/"11")";
  const auto answer = page_.answer(head);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 304);
  EXPECT_EQ(answer->body, "");
  EXPECT_EQ(header(*answer, "Content-Encoding"), "");
  head.headers["if-none-match"] = R"("22")";
  EXPECT_EQ(page_.answer(head)->status, 200);
}

TEST_F(PageTest, EveryAnswerForbidsForeignScripts) {
  for (const char* path : {"/", "/assets/a-1.js", "/assets/absent.js"}) {
    const auto answer = page_.answer(request(path));
    ASSERT_TRUE(answer) << path;
    const std::string policy = header(*answer, "Content-Security-Policy");
    EXPECT_NE(policy.find("default-src 'none'"), std::string::npos) << path;
    EXPECT_NE(policy.find("script-src 'self';"), std::string::npos) << path;
    EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos) << path;
    EXPECT_EQ(policy.find("unsafe"), std::string::npos) << path;
  }
}

TEST_F(PageTest, AnUnknownAssetIsNotFoundAndNotTheApis) {
  const auto answer = page_.answer(request("/assets/%2e%2e%2ftoken"));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 404);
}

TEST_F(PageTest, TheRestIsTheApis) {
  EXPECT_FALSE(page_.answer(request("/api/v1/machines")));
  EXPECT_FALSE(page_.answer(request("/index.html")));
  EXPECT_FALSE(page_.answer(request("//")));
  EXPECT_FALSE(page_.answer(request("/assets/a/b")));
  EXPECT_FALSE(page_.answer(request("/", "POST")));
  EXPECT_TRUE(page_.answer(request("/", "HEAD")));
}

TEST_F(PageTest, WithoutGzipItExplainsItself) {
  auto head = request("/");
  head.headers.clear();
  const auto answer = page_.answer(head);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 406);
  EXPECT_NE(answer->body.find("--compressed"), std::string::npos);
}

TEST(PageThatWasNotBuilt, SaysHowToAddIt) {
  const Page page{{}};
  auto head = request("/");
  head.headers.clear();
  const auto answer = page.answer(head);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_NE(answer->body.find("deploy/packages/install web"), std::string::npos);
  EXPECT_EQ(page.answer(request("/assets/a-1.js"))->status, 404);
}

}  // namespace
}  // namespace dripline::web
