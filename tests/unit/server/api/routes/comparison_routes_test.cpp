// Two revisions of a program compared, and one checked, over the API.
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class ComparisonRoutes : public ApiTest {
 protected:
  ComparisonRoutes() {
    push("O0100", "G20\nG0 X1.\nM30\n");
    push("O0100", "G20\nG0 X2.\nM30\n");
  }
};

TEST_F(ComparisonRoutes, ComparesTwoRevisions) {
  const auto response =
      get("/api/v1/programs/O0100/comparison?revision=1&other_revision=2&by=motion");
  ASSERT_EQ(response.status, 200) << response.body;
  EXPECT_EQ(json(response)["by"], "motion");
  EXPECT_EQ(json(response)["class"], "geometry");
  EXPECT_EQ(json(response)["first"]["revision"], 1);
  EXPECT_EQ(json(get("/api/v1/programs/O0100/comparison?revision=2"))["same"], true);
}

TEST_F(ComparisonRoutes, RefuseWhatTheyDoNotKnow) {
  const std::string route = "/api/v1/programs/O0100/comparison";
  expect_error(get(route + "?by=picture"), 400, "syntax", "'by' is 'picture'");
  expect_error(get(route + "?tolerance=x"), 400, "syntax", "'tolerance' is 'x'");
  EXPECT_NE(get(route + "?tolerance=1001").status, 200);
  EXPECT_NE(get(route + "?context=101").status, 200);
  EXPECT_EQ(get(route + "?other=O0999").status, 404);
  EXPECT_EQ(get(route + "?other_revision=9").status, 404);
  EXPECT_EQ(get(route + "?unknown=1").status, 400);
  EXPECT_EQ(call("GET", route, {.body = {}, .headers = {}, .token = "none"}).status, 401);
}

TEST_F(ComparisonRoutes, CheckARevision) {
  const auto response = get("/api/v1/programs/O0100/check?revision=1");
  ASSERT_EQ(response.status, 200) << response.body;
  EXPECT_EQ(json(response)["outcome"], "ended");
  EXPECT_EQ(json(response)["revision"], 1);
  EXPECT_EQ(get("/api/v1/programs/O0100/check?revision=9").status, 404);
  EXPECT_EQ(get("/api/v1/programs/O0999/check").status, 404);
  EXPECT_EQ(get("/api/v1/programs/O0100/check?unknown=1").status, 400);
  EXPECT_EQ(
      call("GET", "/api/v1/programs/O0100/check", {.body = {}, .headers = {}, .token = "none"})
          .status,
      401);
}

}  // namespace
}  // namespace dripline::server_test
