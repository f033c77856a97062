#pragma once

#include <fmt/format.h>

#include <set>

#include "tests/support/child_process.hpp"
#include "tests/support/json_schema.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {

/// Compares the API with its description.
class OpenApi : public ApiTest {
 protected:
  OpenApi() : document_(json(get("/api/v1/openapi.json"))) {}

  /// The schema of an answer; null when it is described as something other than JSON.
  Json schema_of(const std::string& method, const std::string& pattern, int status) {
    std::string verb;
    for (const char c : method) verb += static_cast<char>(c - 'A' + 'a');
    const Json& responses = document_["paths"][pattern][verb]["responses"];
    const std::string own = std::to_string(status);
    const std::string key = status < 400 || responses.contains(own) ? own : "default";
    EXPECT_TRUE(responses.contains(key)) << method << " " << pattern << " " << status;
    const Json content = responses.value(key, Json::object()).value("content", Json::object());
    return content.value("application/json", Json::object()).value("schema", Json(nullptr));
  }
  void expect_described(const std::string& method, const std::string& pattern,
                        const api::Response& response) {
    covered_.insert(method + " " + pattern);
    const Json schema = schema_of(method, pattern, response.status);
    if (schema.is_null() || response.status == 204) return;
    const Json answer = json(response);
    EXPECT_EQ(test_support::schema_violation(document_, schema, answer), "")
        << method << " " << pattern << " " << answer.dump();
  }
  /// What comes as lines or events is described by a schema without being an answer.
  void expect_line_described(const std::string& schema, const std::string& line) {
    EXPECT_EQ(test_support::schema_violation(document_, document_["components"]["schemas"][schema],
                                             Json::parse(line)),
              "");
  }

  Json document_;
  std::set<std::string> covered_;
};

}  // namespace dripline::server_test
