// Promise 6: bad input gets a clear error and changes nothing, in bounded memory.
#include <gtest/gtest.h>

#include "tests/integration/system.hpp"
#include "tests/support/sanitized.hpp"

namespace dripline::integration {
namespace {

constexpr std::uint64_t kMemoryBound = 64ull << 20;

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    system.start_server();
    client.emplace(system.rest());
  }
  void TearDown() override {
    EXPECT_EQ(client->get("/api/v1/programs").json()["programs"].size(), 0u)
        << "something was stored";
    EXPECT_EQ(client->get("/api/v1/runs").json()["runs"].size(), 0u) << "a run was made";
    EXPECT_TRUE(system.server().is_running());
    if (test_support::kIsSanitized) return;  // shadow memory is not the server's
    EXPECT_LT(system.server().peak_memory(), kMemoryBound);
  }

  /// Begins an upload and returns its path.
  std::string upload_path() {
    const auto reply =
        client->post("/api/v1/uploads", {{"program", "O1"}, {"control", "centurion"}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return "/api/v1/uploads/" + reply.json().value("id", "none");
  }
  /// Sends all of `text` in one piece and commits; returns the first answer that is an error.
  test_support::RestClient::Reply push(const std::string& text) {
    const std::string path = upload_path();
    if (!text.empty()) {
      const auto piece = client->put_bytes(path + "/content?offset=0", text);
      if (piece.status != 200) return piece;
    }
    return client->post(path + "/commit", nlohmann::json::object());
  }
  static void expect_error(const test_support::RestClient::Reply& reply, int status,
                           const std::string& part) {
    EXPECT_EQ(reply.status, status) << reply.body;
    const auto json = reply.json();
    ASSERT_TRUE(json.is_object() && json.contains("error")) << reply.body;
    EXPECT_NE(json["error"].value("message", "").find(part), std::string::npos) << reply.body;
  }

  System system;
  std::optional<test_support::RestClient> client;
};

TEST_F(BadInput, AGibibyteOfNulsIsRefusedAtItsFirstPiece) {
  const std::string piece(4 << 20, '\0');
  const std::string path = upload_path();
  expect_error(client->put_bytes(path + "/content?offset=0", piece), 400, "NUL");
  for (std::uint64_t offset = piece.size(); offset < (1ull << 30); offset += piece.size()) {
    ASSERT_NE(client->put_bytes(path + "/content?offset=" + std::to_string(offset), piece).status,
              200);
  }
  EXPECT_NE(client->post(path + "/commit", nlohmann::json::object()).status, 201);
}

TEST_F(BadInput, ALineOfAMebibyte) {
  expect_error(push("O1\n" + std::string(1 << 20, 'X') + "\nM30\n"), 413, "line 2");
}

TEST_F(BadInput, TextThatIsNotUtf8) {
  expect_error(push("O1\n(CAF\xe9)\nM30\n"), 400, "UTF-8");
}

TEST_F(BadInput, AnEmptyFile) {
  expect_error(push(""), 400, "empty");
}

TEST_F(BadInput, AnUnknownControl) {
  expect_error(client->post("/api/v1/uploads", {{"program", "O1"}, {"control", "fagor"}}), 422,
               "fagor");
}

TEST_F(BadInput, AProgramNameThatLeavesItsFolder) {
  expect_error(client->post("/api/v1/uploads", {{"program", "../O1"}, {"control", "centurion"}}),
               400, "../O1");
}

TEST_F(BadInput, JsonNestedTenThousandDeep) {
  const std::string deep = std::string(10'000, '[') + std::string(10'000, ']');
  expect_error(client->post_text("/api/v1/uploads", deep), 400, "nest");
  expect_error(client->post_text("/api/v1/runs", R"({"machine":)" + deep + "}"), 400, "nest");
}

TEST_F(BadInput, AnOrderForAMachineThatDoesNotExist) {
  expect_error(client->post("/api/v1/runs", {{"machine", "lathe-9"}, {"program", "O1"}}), 404,
               "lathe-9");
  expect_error(client->post("/api/v1/runs/no-such-run/commands", {{"action", "hold"}}), 404,
               "no-such-run");
}

TEST_F(BadInput, AWrongToken) {
  const auto location = client->get("/api/v1/server");
  ASSERT_EQ(location.status, 200);
  const test_support::RestClient stranger(system.url(), "wrong");
  expect_error(stranger.get("/api/v1/server"), 401, "token");
  expect_error(stranger.post("/api/v1/uploads", {{"program", "O1"}}), 401, "token");
}

}  // namespace
}  // namespace dripline::integration
