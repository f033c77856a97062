#include "clients/lib/client.hpp"

#include <gtest/gtest.h>

#include "tests/unit/clients/support/fake_server.hpp"

namespace dripline::client {
namespace {

/// Answers everything with one response and keeps the last request.
class CannedHttp final : public Http {
 public:
  CannedHttp(int status, std::string body, HttpRequest* last) : last_(last) {
    response_.status = status;
    response_.body = std::move(body);
  }
  Reply<HttpResponse> send(const HttpRequest& request) override {
    body_ = request.body;
    *last_ = request;
    last_->body = body_;
    if (request.on_body) request.on_body(response_.body);
    return response_;
  }
  void stop() override {}

 private:
  HttpResponse response_;
  HttpRequest* last_;
  std::string body_;
};

class ClientCall : public testing::Test {
 protected:
  Client& answering(int status, const std::string& body) {
    client.emplace(ServerAddress{"http://shop:1", "t", {}},
                   std::make_unique<CannedHttp>(status, body, &last));
    return *client;
  }
  HttpRequest last;
  std::optional<Client> client;
};

TEST_F(ClientCall, EncodesNamesIntoThePath) {
  const auto removed = answering(204, "").remove_program("a b+c.nc");
  EXPECT_TRUE(removed);
  EXPECT_EQ(last.method, "DELETE");
  EXPECT_EQ(last.path, "/api/v1/programs/a%20b%2Bc.nc");
}

TEST_F(ClientCall, AsksForRunsWithItsFilters) {
  ASSERT_TRUE(answering(200, R"({"runs":[]})").runs({"lathe-1", "", "active", {5, 10}}));
  EXPECT_EQ(last.path, "/api/v1/runs?limit=5&offset=10&machine=lathe-1&state=active");
}

TEST_F(ClientCall, StartsARunWithTheRevisionOnlyWhenGiven) {
  [[maybe_unused]] auto latest = answering(404, "{}").start_run({"lathe-1", "O1", {}});
  EXPECT_EQ(last.body, R"({"machine":"lathe-1","program":"O1"})");
  [[maybe_unused]] auto third = answering(404, "{}").start_run({"lathe-1", "O1", 3});
  EXPECT_EQ(last.body, R"({"machine":"lathe-1","program":"O1","revision":3})");
}

TEST_F(ClientCall, SendsOrdersWithWhatBelongsToThem) {
  ASSERT_TRUE(answering(200, R"({"accepted":true})").command("r1", {"feed_override", {}, {}, 0.5}));
  EXPECT_EQ(last.path, "/api/v1/runs/r1/commands");
  EXPECT_EQ(last.body, R"({"action":"feed_override","value":0.5})");
}

TEST_F(ClientCall, SavesASetupOverTheOneItWasMadeFrom) {
  [[maybe_unused]] auto any = answering(404, "{}").save_setup({"mill-3", "a = 1", "why", ""});
  EXPECT_EQ(last.path, "/api/v1/machines/mill-3/setup?comment=why");
  [[maybe_unused]] auto first = answering(404, "{}").save_setup({"mill-3", "a = 1", "", "", 0});
  EXPECT_EQ(last.path, "/api/v1/machines/mill-3/setup?base=0");
  const auto late =
      answering(409, R"({"error":{"code":"conflict","message":"5 is the newest by now"}})")
          .save_setup({"mill-3", "a = 1", "", "tnc155", 4});
  EXPECT_EQ(last.path, "/api/v1/machines/mill-3/setup?base=4&control=tnc155");
  EXPECT_EQ(last.method, "PUT");
  EXPECT_EQ(last.body, "a = 1");
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, Errc::Conflict);
  EXPECT_EQ(late.error().what, "5 is the newest by now");
}

TEST_F(ClientCall, SendsOrdersToAMachinesPanel) {
  ASSERT_TRUE(answering(200, R"({"accepted":true})")
                  .command_machine("mill 1", {"switch", {}, "emergency_stop", 1}));
  EXPECT_EQ(last.path, "/api/v1/machines/mill%201/commands");
  EXPECT_EQ(last.body, R"({"action":"switch","name":"emergency_stop","value":1.0})");
}

TEST_F(ClientCall, PassesOnTheServersError) {
  const auto run = answering(409, R"({"error":{"code":"busy","message":"lathe-1 has run r1"}})")
                       .start_run({"lathe-1", "O1", {}});
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, Failure::Kind::Refused);
  EXPECT_EQ(run.error().code, Errc::Busy);
  EXPECT_EQ(run.error().what, "lathe-1 has run r1");
}

TEST_F(ClientCall, DistinguishesAStrangerFromAServer) {
  const auto machines = answering(500, "<html>proxy</html>").machines();
  ASSERT_FALSE(machines);
  EXPECT_EQ(machines.error().kind, Failure::Kind::BadReply);
}

TEST_F(ClientCall, NamesTheMemberThatIsWrong) {
  const auto upload =
      answering(200, R"({"id":"u","program":"p","received":-1,"max_piece":1})").upload("u");
  ASSERT_FALSE(upload);
  EXPECT_EQ(upload.error().kind, Failure::Kind::BadReply);
  EXPECT_NE(upload.error().what.find("\"received\" is not a whole number >= 0"), std::string::npos)
      << upload.error().what;
}

TEST_F(ClientCall, GivesAReportToTheSink) {
  std::string text;
  ASSERT_TRUE(answering(200, "X1\n").export_report("r1", "text", [&](std::string_view bytes) {
    text += bytes;
    return true;
  }));
  EXPECT_EQ(last.path, "/api/v1/reports/r1?format=text");
  EXPECT_EQ(text, "X1\n");
}

TEST(ClientConnection, ReportsThatNoServerAnswers) {
  Client unreachable{ServerAddress{"http://127.0.0.1:1", "t", {}}};
  const auto health = unreachable.health();
  ASSERT_FALSE(health);
  EXPECT_EQ(health.error().kind, Failure::Kind::Unreachable);
  EXPECT_NE(health.error().what.find("http://127.0.0.1:1"), std::string::npos);
}

TEST(ClientConnection, RefusesContentLongerThanAsked) {
  test_support::FakeServer server;
  server.add_program("O1", std::string(100, 'x'));
  Client client{ServerAddress{server.url(), test_support::FakeServer::kToken, {}}};
  const auto content = client.content({"O1", 1, 10, 20});
  ASSERT_TRUE(content) << content.error().what;
  EXPECT_EQ(content->bytes.size(), 20u);
  EXPECT_EQ(content->size, 100u);
}

}  // namespace
}  // namespace dripline::client
