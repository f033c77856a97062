#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

constexpr const char* kTemplate =
    "[[line]]\nform = 'D {actual}'\ncharacteristic = 'D, bore'\nnominal = 40\ntolerance = 0.02\n";

class MeasurementRoutes : public ApiTest {
 protected:
  ~MeasurementRoutes() override { measurements_->end(); }

  api::Response put(const std::string& target, const std::string& body = "") {
    return call("PUT", target, {.body = body, .headers = {}});
  }
  /// A run that has printed three values and a line that no template knows.
  void measure() {
    ASSERT_EQ(put("/api/v1/report-templates/bore", kTemplate).status, 200);
    ASSERT_EQ(put("/api/v1/report-template-assignments/program/O0100/bore").status, 204);
    const auto revision = push("O0100", "O0100\nM30\n");
    show_machine("lathe-1");
    ASSERT_TRUE(store_->runs.create(run_of(revision, "run-1")));
    storage::RecordBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 7;
    for (const std::string text : {"D 40.001", "D 40.010", "LOAD 3", "D 40.100", ""}) {
      storage::Record record;
      record.machine = "lathe-1";
      record.epoch = 7;
      record.number = batch.records.size() + 1;
      record.time = clock_.now() + std::chrono::seconds(record.number);
      record.run = "run-1";
      record.kind = text.empty() ? "run_ended" : "output";
      record.text = text;
      batch.records.push_back(record);
    }
    storage::RunEnding ending;
    ending.run = "run-1";
    ending.ended = clock_.now();
    batch.endings.push_back(ending);
    ASSERT_TRUE(store_->records.store(batch));
    measurements_->begin();
    const auto waited = measurements_->wait(std::chrono::seconds(60));
    ASSERT_TRUE(waited) << waited.error().what;
  }
};

TEST_F(MeasurementRoutes, ListWhatWasMeasured) {
  measure();
  const Json all = json(get("/api/v1/measurements"));
  ASSERT_EQ(all["measurements"].size(), 3u);
  EXPECT_EQ(all["next"], nullptr);
  const Json first = all["measurements"][0];
  EXPECT_EQ(first["characteristic"], "D, bore");
  EXPECT_EQ(first["actual"], 40.001);
  EXPECT_EQ(first["upper"], 40.02);
  EXPECT_EQ(first["verdict"], "good");
  EXPECT_EQ(json(get("/api/v1/measurements?order=newest&limit=1"))["measurements"][0]["verdict"],
            "scrap");
  EXPECT_EQ(json(get("/api/v1/measurements?verdict=scrap"))["measurements"].size(), 1u);
  EXPECT_EQ(json(get("/api/v1/measurements?machine=lathe-1&characteristic=D,%20bore&run=run-1"))
                ["measurements"]
                    .size(),
            3u);
  EXPECT_EQ(json(get("/api/v1/measurements?since=2100-01-01"))["measurements"].size(), 0u);
}

TEST_F(MeasurementRoutes, ContinueWhereAPageEnds) {
  measure();
  const Json first = json(get("/api/v1/measurements?limit=2"));
  ASSERT_TRUE(first["next"].is_string());
  const Json second =
      json(get("/api/v1/measurements?limit=2&after=" + first["next"].get<std::string>()));
  ASSERT_EQ(second["measurements"].size(), 1u);
  EXPECT_EQ(second["measurements"][0]["actual"], 40.1);
}

TEST_F(MeasurementRoutes, ExportAllOfThem) {
  measure();
  const auto csv = get("/api/v1/measurements?format=csv&run=run-1");
  EXPECT_EQ(csv.content_type, "text/csv; charset=utf-8");
  const std::string text = body(csv);
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
  EXPECT_NE(text.find(",\"D, bore\",40,39.98,40.02,mm,40.001,"), std::string::npos) << text;
  const std::string lines = body(get("/api/v1/measurements?format=jsonl"));
  EXPECT_EQ(std::ranges::count(lines, '\n'), 3);
  EXPECT_EQ(Json::parse(lines.substr(0, lines.find('\n')))["actual"], 40.001);
}

TEST_F(MeasurementRoutes, ShowPartsInTheRun) {
  measure();
  const Json parts = json(get("/api/v1/parts?run=run-1"));
  ASSERT_EQ(parts["parts"].size(), 1u);
  EXPECT_EQ(parts["parts"][0]["verdict"], "scrap");
  EXPECT_EQ(json(get("/api/v1/parts/1"))["template_version"], 1);
  expect_error(get("/api/v1/parts/9"), 404, "not_found", "part 9");
  EXPECT_EQ(json(get("/api/v1/runs/run-1"))["parts"],
            Json::parse(R"({"good":0,"unknown":0,"rework":0,"scrap":1})"));
  const Json findings = json(get("/api/v1/report-findings?run=run-1"));
  ASSERT_EQ(findings["findings"].size(), 1u);
  EXPECT_EQ(findings["findings"][0]["text"], "LOAD 3");
}

TEST_F(MeasurementRoutes, PublishVerdicts) {
  const auto events = events_.subscribe({});
  measure();
  const std::string text = events->take();
  EXPECT_NE(text.find("event: part\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"verdict\":\"scrap\""), std::string::npos) << text;
}

TEST_F(MeasurementRoutes, DeriveARunAgain) {
  measure();
  ASSERT_EQ(put("/api/v1/report-templates/load",
                "[[line]]\nform='LOAD {actual}'\ncharacteristic='load'\n")
                .status,
            200);
  const Json again = json(post("/api/v1/runs/run-1/measurements", {{"template", "load"}}));
  ASSERT_EQ(again["parts"].size(), 1u) << again.dump();
  EXPECT_EQ(again["parts"][0]["template"], "load");
  EXPECT_EQ(json(get("/api/v1/measurements?run=run-1"))["measurements"].size(), 1u);
  EXPECT_EQ(json(get("/api/v1/measurements?run=run-1&superseded=yes"))["measurements"].size(), 4u);
  expect_error(post("/api/v1/runs/run-9/measurements", Json::object()), 404, "not_found", "run-9");
}

TEST_F(MeasurementRoutes, RefuseWhatTheyDoNotKnow) {
  expect_error(get("/api/v1/measurements?since=yesterday"), 400, "syntax", "2026-11-21");
  expect_error(get("/api/v1/measurements?verdict=fine"), 400, "syntax", "fine");
  expect_error(get("/api/v1/measurements?after=1"), 400, "syntax", "after");
  expect_error(get("/api/v1/measurements?order=random"), 400, "syntax", "random");
  expect_error(get("/api/v1/measurements?format=pdf"), 422, "unsupported", "pdf");
  expect_error(get("/api/v1/measurements?colour=red"), 400, "syntax", "colour");
  expect_error(put("/api/v1/report-templates/bore", "[[line]]\n"), 400, "syntax",
               "line 1: a line needs a form");
  expect_error(put("/api/v1/report-templates/BORE", kTemplate), 400, "syntax", "BORE");
  expect_error(put("/api/v1/report-template-assignments/tool/T1/bore"), 400, "syntax", "tool");
  expect_error(put("/api/v1/report-template-assignments/machine/lathe-1/bore"), 404, "not_found",
               "bore");
  expect_error(call("DELETE", "/api/v1/report-templates/bore"), 404, "not_found", "bore");
}

TEST_F(MeasurementRoutes, NeedTheRightToChangeTemplates) {
  const Call operator_call{.body = kTemplate, .headers = {}, .token = token_of("operator")};
  EXPECT_EQ(call("PUT", "/api/v1/report-templates/bore", operator_call).status, 403);
  const Call programmer{.body = kTemplate, .headers = {}, .token = token_of("programmer")};
  EXPECT_EQ(call("PUT", "/api/v1/report-templates/bore", programmer).status, 200);
}

}  // namespace
}  // namespace dripline::server_test
