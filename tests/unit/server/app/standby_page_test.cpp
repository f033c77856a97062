#include "server/app/standby_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dripline::app {
namespace {

api::Request browser(const std::string& language = "en-US,en;q=0.9,de;q=0.8",
                     const std::string& path = "/") {
  api::Request request;
  request.method = "GET";
  request.target = *api::parse_target(path);
  request.headers = {{"accept", "text/html,application/xhtml+xml,*/*;q=0.8"},
                     {"accept-language", language}};
  return request;
}

bool holds(const api::Response& page, std::string_view text) {
  return page.body.find(text) != std::string::npos;
}

TEST(StandbyPage, IsForBrowsersAndNotForTheApi) {
  EXPECT_TRUE(wants_page(browser()));
  EXPECT_TRUE(wants_page(browser("de", "/machines/lathe-1")));
  EXPECT_FALSE(wants_page(browser("de", "/api/v1/machines")));
  auto request = browser();
  request.method = "POST";
  EXPECT_FALSE(wants_page(request));
  request = browser();
  request.headers["accept"] = "*/*";  // curl, scripts, our own client
  EXPECT_FALSE(wants_page(request));
}

TEST(StandbyPage, SaysWhatItCouldNotTakeOver) {
  const auto well = standby_page({.name = "dncd 812"}, {}, browser());
  EXPECT_FALSE(holds(well, "MTConnect"));
  EXPECT_FALSE(holds(well, "UDP"));
  EXPECT_TRUE(holds(standby_page({.name = "dncd 812"}, {.ports = "used"}, browser()),
                    "it cannot take over"));
  EXPECT_TRUE(holds(standby_page({.name = "dncd 812"}, {.agent = "used"}, browser("de")),
                    "ohne den Agenten"));
  const auto other = standby_page(
      {.name = "dncd 812"},
      {.network = "other", .settings = "other", .clock = "late", .disk = "full"}, browser());
  EXPECT_TRUE(holds(other, "Its DDS settings are not those"));
  EXPECT_TRUE(holds(other, "see its log"));
  EXPECT_TRUE(holds(other, "nearly full"));
  EXPECT_TRUE(holds(other, "Its clock is not that of the database"));
}

TEST(StandbyPage, LinksToTheServerThatHasTheLibraryAndLoadsItselfAgain) {
  const auto page = standby_page(
      {.name = "dncd 812 on srv-1, /var/lib/dripline", .url = "https://srv-1:8430"}, {}, browser());
  EXPECT_EQ(page.status, 503);
  EXPECT_EQ(page.content_type, "text/html; charset=utf-8");
  EXPECT_TRUE(holds(page, "<a href=\"https://srv-1:8430/\">https://srv-1:8430</a> (dncd 812"));
  EXPECT_TRUE(holds(page, "http-equiv=\"refresh\""));
  EXPECT_TRUE(holds(page, "<html lang=\"en\">"));
  EXPECT_FALSE(holds(page, "database"));
  EXPECT_TRUE(
      holds(standby_page({}, {.database = "away"}, browser()), "The database cannot be reached"));
}

TEST(StandbyPage, IsProtectedAsTheOthersAreAndNotKept) {
  const auto page = standby_page({}, {}, browser());
  const auto value = [&](std::string_view name) {
    const auto found = std::ranges::find_if(
        page.headers, [&](const auto& header) { return header.first == name; });
    return found == page.headers.end() ? "" : found->second;
  };
  EXPECT_NE(value("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(value("Referrer-Policy"), "no-referrer");
  EXPECT_EQ(value("Cache-Control"), "no-store");
}

/// The database says what is in it.
TEST(StandbyPage, TakesNoMarkupFromTheDatabase) {
  const auto page =
      standby_page({.name = "<script>", .url = "javascript:alert(\"1\")"}, {}, browser());
  EXPECT_FALSE(holds(page, "<script>"));
  EXPECT_FALSE(holds(page, "href"));
  EXPECT_TRUE(holds(page, "&lt;script&gt;"));
  EXPECT_FALSE(holds(standby_page({.url = "http://a\"><b>"}, {}, browser()), "<b>"));
}

struct LanguageCase {
  const char* name;
  const char* accepted;
  const char* language;
};
class StandbyPageLanguage : public testing::TestWithParam<LanguageCase> {};

TEST_P(StandbyPageLanguage, IsTheOneThatTheBrowserPrefers) {
  const auto page = standby_page({}, {}, browser(GetParam().accepted));
  EXPECT_TRUE(holds(page, std::string("<html lang=\"") + GetParam().language)) << page.body;
}

INSTANTIATE_TEST_SUITE_P(
    , StandbyPageLanguage,
    testing::Values(LanguageCase{"none", "", "en"}, LanguageCase{"german", "de", "de"},
                    LanguageCase{"austrian_first", "de-AT,de;q=0.9,en;q=0.5", "de"},
                    LanguageCase{"english_first", "en,de;q=0.9", "en"},
                    LanguageCase{"by_weight", "en;q=0.3, de;q=0.7", "de"},
                    LanguageCase{"neither", "fr-FR,fr;q=0.9", "en"},
                    LanguageCase{"german_after_french", "fr,de;q=0.2", "de"},
                    LanguageCase{"broken", ";q=,,de;q=x", "en"}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline::app
