// The import queue over the API: what is listed and shown, and what a decision leaves.
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class ImportRoutes : public ApiTest {
 protected:
  ImportRoutes() {
    push("O1", "N10 G0 X1.\nM2\n");
    receive("N10 G0 X2.\nM2\n");
  }
  void receive(const std::string& text) {
    const auto upload = programs_->begin(
        {.program = "O1", .control = "centurion", .comment = "punched", .is_held = true},
        "machine lathe-1");
    ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of(text)));
    ASSERT_TRUE(programs_->commit(upload->id, std::nullopt, "machine lathe-1"));
  }
  const std::string path_ = "/api/v1/imports/O1/2";
};

TEST_F(ImportRoutes, ListWhatWaitsAndWhatWasDecided) {
  const auto waiting = json(get("/api/v1/imports"))["imports"];
  ASSERT_EQ(waiting.size(), 1u);
  EXPECT_EQ(waiting[0]["program"], "O1");
  EXPECT_EQ(waiting[0]["revision"], 2);
  EXPECT_EQ(waiting[0]["machine"], "lathe-1");
  EXPECT_EQ(waiting[0]["state"], "pending");
  EXPECT_TRUE(json(get("/api/v1/imports?state=decided"))["imports"].empty());
  expect_error(get("/api/v1/imports?state=all"), 400, "syntax", "'all'");
}

TEST_F(ImportRoutes, ShowTheDifferencesWithBothLines) {
  const auto shown = json(get(path_));
  EXPECT_EQ(shown["compared_with"], 1);
  EXPECT_EQ(shown["comparison"]["by"], "motion");
  const auto& place = shown["comparison"]["motion"]["places"][0];
  EXPECT_EQ(place["first"]["text"], "N10 G0 X1.");
  EXPECT_EQ(place["second"]["text"], "N10 G0 X2.");
  expect_error(get("/api/v1/imports/O1/1"), 404, "not_found", "did not come from a machine");
}

TEST_F(ImportRoutes, AcceptPutsItInForce) {
  const auto accepted = post(path_ + "/accept", {{"comment", "measured"}});
  EXPECT_EQ(accepted.status, 200) << accepted.body;
  EXPECT_EQ(json(accepted)["revision"], 2);
  EXPECT_EQ(json(accepted)["held"], false);
  const auto decided = json(get("/api/v1/imports?state=decided"))["imports"];
  ASSERT_EQ(decided.size(), 1u);
  EXPECT_EQ(decided[0]["who"], "admin");
  EXPECT_EQ(decided[0]["reason"], "measured");
  expect_error(call("POST", path_ + "/accept"), 409, "conflict", "accepted already");
}

TEST_F(ImportRoutes, AcceptAsMakesItARevisionOfTheOtherProgram) {
  const auto accepted = post(path_ + "/accept", {{"as", "O2"}});
  EXPECT_EQ(accepted.status, 200) << accepted.body;
  EXPECT_EQ(json(accepted)["program"], "O2");
  EXPECT_EQ(json(get("/api/v1/imports?state=decided"))["imports"][0]["accepted_as"],
            (Json{{"program", "O2"}, {"revision", 1}}));
  EXPECT_EQ(json(get("/api/v1/programs/O1"))["revisions"].size(), 1u);
}

TEST_F(ImportRoutes, RejectNeedsAReasonAndKeepsIt) {
  expect_error(call("POST", path_ + "/reject"), 400, "syntax", "");
  expect_error(post(path_ + "/reject", {{"reason", ""}}), 400, "syntax", "reason");
  EXPECT_EQ(post(path_ + "/reject", {{"reason", "too fast"}}).status, 204);
  const auto decided = json(get("/api/v1/imports?state=decided"))["imports"];
  EXPECT_EQ(decided[0]["state"], "rejected");
  EXPECT_EQ(decided[0]["reason"], "too fast");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["action"], "program.reject");
}

TEST_F(ImportRoutes, TheReasonOfTheOtherWayToRejectIsKeptToo) {
  EXPECT_EQ(post("/api/v1/programs/O1/revisions/2/reject", {{"comment", "scrap"}}).status, 204);
  EXPECT_EQ(json(get("/api/v1/imports?state=decided"))["imports"][0]["reason"], "scrap");
}

TEST_F(ImportRoutes, PublishWhatHappens) {
  auto listener = events_.subscribe(std::nullopt);
  post(path_ + "/reject", {{"reason", "too fast"}});
  const std::string text = listener->take();
  EXPECT_NE(text.find("event: import"), std::string::npos) << text;
  EXPECT_NE(text.find("\"state\":\"rejected\""), std::string::npos) << text;
}

}  // namespace
}  // namespace dripline::server_test
