// The description of the API against the API: every route is described, and everything described is
// a route. The answers: openapi_answers_test.cpp.
#include "tests/unit/server/api/openapi_fixture.hpp"

namespace dripline::server_test {
namespace {

TEST_F(OpenApi, NamesThePermissionOfEveryRoute) {
  std::size_t operations = 0;
  for (const auto& [path, item] : document_["paths"].items()) {
    for (const auto& [verb, operation] : item.items()) {
      std::string method;
      for (const char c : verb) method += static_cast<char>(c - 'a' + 'A');
      const auto* const row = api::find_permission(method, path);
      ASSERT_NE(row, nullptr) << method << " " << path << " has no row in route_permissions";
      EXPECT_EQ(operation.value("x-permission", ""), identity::to_string(row->permission))
          << method << " " << path;
      const bool is_open = operation.contains("security") && operation["security"].empty();
      EXPECT_EQ(is_open, row->permission == identity::Permission::Open) << method << " " << path;
      ++operations;
    }
  }
  EXPECT_EQ(operations, api::route_permissions().size()) << "a row without a route";
}

TEST_F(OpenApi, DescribesEveryRouteAndNothingElse) {
  std::set<std::string> described;
  for (const auto& [path, item] : document_["paths"].items()) {
    for (const auto& [verb, operation] : item.items()) {
      std::string method;
      for (const char c : verb) method += static_cast<char>(c - 'a' + 'A');
      described.insert(fmt::format("{} {}", method, path));
      EXPECT_TRUE(operation.contains("summary")) << method << " " << path;
    }
  }
  std::set<std::string> routed;
  for (const auto& route : api_->router().routes())
    routed.insert(route.method + " " + route.pattern);
  EXPECT_EQ(described, routed);
}

TEST_F(OpenApi, ListsTheWordsOfEveryEnumeration) {
  const auto expect_words = [this](const std::string& schema, const std::string& member,
                                   std::span<const std::string_view> words) {
    Json expected = Json::array();
    for (const std::string_view word : words) {
      if (word != "unknown") expected.push_back(word);  // shown as null
    }
    EXPECT_EQ(document_["components"]["schemas"][schema]["properties"][member]["enum"], expected)
        << schema << "." << member;
  };
  expect_words("Status", "execution", words_of(dds::Execution{}));
  expect_words("Status", "mode", words_of(dds::ControllerMode{}));
  expect_words("Status", "remote_enable", words_of(dds::RemoteEnable{}));
  expect_words("Status", "waits_for", words_of(dds::WaitsFor{}));
  expect_words("ActiveModes", "motion", words_of(dds::MotionKind{}));
  expect_words("ActiveModes", "compensation", words_of(dds::CompensationSide{}));
  expect_words("ActiveModes", "feed_unit", words_of(dds::FeedUnit{}));
  expect_words("ActiveModes", "spindle", words_of(dds::SpindleState{}));
  for (const char* name :
       {"optional_stop", "block_skip", "dry_run", "machine_lock", "test_run", "handwheel"})
    expect_words("PanelSwitches", name, words_of(dds::SwitchState{}));
  expect_words("Record", "kind", words_of(dds::RecordKind{}));
}

TEST_F(OpenApi, FitsTheErrorsOfEveryStatus) {
  expect_described("GET", "/api/v1/server",
                   call("GET", "/api/v1/server", {.body = {}, .headers = {}, .token = "wrong"}));
  expect_described("GET", "/api/v1/runs/{id}", get("/api/v1/runs/none"));
  expect_described("POST", "/api/v1/runs", call("POST", "/api/v1/runs"));
  expect_described("POST", "/api/v1/uploads",
                   post("/api/v1/uploads", {{"program", "O1"}, {"control", "fagor"}}));
}

TEST_F(OpenApi, IsRefusedWithAKeywordThatIsNotChecked) {
  EXPECT_NE(test_support::schema_violation(document_, Json{{"type", "string"}, {"oneOf", 1}}, "x"),
            "");
}

}  // namespace
}  // namespace dripline::server_test
