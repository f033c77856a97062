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
  void measure() { measure({"D 40.001", "D 40.010", "LOAD 3", "D 40.100"}); }
  void measure(const std::vector<std::string>& lines,
               storage::RunState state = storage::RunState::Completed) {
    ASSERT_EQ(put("/api/v1/report-templates/bore", kTemplate).status, 200);
    ASSERT_EQ(put("/api/v1/report-template-assignments/program/O0100/bore").status, 204);
    const auto revision = push("O0100", "O0100\nM30\n");
    show_machine("lathe-1");
    ASSERT_TRUE(store_->runs.create(run_of(revision, "run-1")));
    storage::RecordBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 7;
    std::vector<std::string> texts = lines;
    texts.emplace_back();  // the run's end
    for (const std::string& text : texts) {
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
    ending.state = state;
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
  EXPECT_NE(text.find(",\"D, bore\",40.000,39.980,40.020,mm,40.001,"), std::string::npos) << text;
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
  EXPECT_EQ(
      json(get("/api/v1/runs/run-1"))["parts"],
      Json::parse(R"({"good":0,"unknown":0,"rework":0,"scrap":1,"archived":0,"archives":[]})"));
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

TEST_F(MeasurementRoutes, StudyTheCapabilityOfACharacteristic) {
  measure({"D 40.001", "D 40.003", "D 39.998", "D 40.002", "D 39.999", "D 40.000"});
  const std::string path = "/api/v1/measurements/capability?characteristic=D,%20bore";
  const Json study = json(get(path));
  ASSERT_EQ(study["count"], 6) << study.dump();
  EXPECT_EQ(study["lower"], 39.98);
  EXPECT_EQ(study["upper"], 40.02);
  EXPECT_NEAR(study["mean"], 40.0005, 1e-9);
  EXPECT_NEAR(study["pp"]["value"], 0.04 / (6 * 0.0018708287), 1e-4);
  EXPECT_LT(study["ppk"]["low"], study["ppk"]["value"]);
  EXPECT_LT(study["ppk"]["value"], study["ppk"]["high"]);
  EXPECT_TRUE(study["anderson_darling"].is_null());
  const Json of_last = json(get(path + "&last=5&upper=40.01&confidence=0.9"));
  EXPECT_EQ(of_last["count"], 5);
  EXPECT_EQ(of_last["upper"], 40.01);
  EXPECT_EQ(of_last["confidence"], 0.9);
  EXPECT_TRUE(json(get(path + "&shape=empirical"))["cp"].is_null());
  expect_error(get("/api/v1/measurements/capability"), 400, "syntax", "characteristic");
  expect_error(get("/api/v1/measurements/capability?characteristic=E"), 404, "not_found", "E");
  expect_error(get(path + "&lower=wide"), 400, "syntax", "wide");
  expect_error(get(path + "&last=4"), 413, "limit_exceeded", "5");
  expect_error(get(path + "&shape=round"), 400, "syntax", "round");
}

TEST_F(MeasurementRoutes, StudyAGauge) {
  measure({"D 40.001"});
  const std::string path = "/api/v1/measurements/gauge?characteristic=D,%20bore";
  expect_error(get(path), 413, "limit_exceeded", "appraisers");
  expect_error(get(path + "&tolerance=0"), 413, "limit_exceeded", "tolerance");
  expect_error(get(path + "&method=guess"), 400, "syntax", "guess");
}

TEST_F(MeasurementRoutes, ExportFilesForOthers) {
  measure();
  const auto dfq = get("/api/v1/measurements?format=dfq");
  EXPECT_EQ(dfq.status, 200);
  EXPECT_EQ(header(dfq, "Content-Disposition"), "attachment");
  EXPECT_EQ(body(dfq).substr(0, 6), "K0100 ");
  const auto utf8 = get("/api/v1/measurements?format=dfq-utf8");
  EXPECT_EQ(utf8.status, 200);
  EXPECT_EQ(utf8.content_type, "text/plain; charset=utf-8");
  EXPECT_NE(body(get("/api/v1/measurements?format=qif&part=1")).find("<QIFDocument"),
            std::string::npos);
  const auto page = get("/api/v1/measurements?format=html&part=1");
  EXPECT_EQ(page.content_type, "text/html; charset=utf-8");
  EXPECT_NE(body(page).find("D, bore"), std::string::npos);
  expect_error(get("/api/v1/measurements?format=points"), 404, "not_found", "X, Y or Z");
  for (const char* format :
       {"dfq", "dfd", "dfx", "dfq-utf8", "dfd-utf8", "qif", "html", "points", "dxf", "stl"}) {
    SCOPED_TRACE(format);
    expect_error(get(fmt::format("/api/v1/measurements?format={}&machine=none", format)), 404,
                 "not_found", "measurement");
  }
}

TEST_F(MeasurementRoutes, TryATemplateOnARun) {
  measure();
  const std::string path = "/api/v1/runs/run-1/template-trial";
  const auto try_it = [&](const std::string& query, const std::string& text = kTemplate) {
    return call("POST", path + query, {.body = text, .headers = {}});
  };
  const Json trial = json(try_it(""));
  EXPECT_EQ(trial["lines"], 4) << trial.dump();
  EXPECT_EQ(trial["unmatched"], 1);
  EXPECT_EQ(trial["measurements"], 3);
  ASSERT_EQ(trial["shown"].size(), 4u);
  EXPECT_EQ(trial["shown"][0]["fields"]["actual"], "40.001");
  EXPECT_EQ(trial["shown"][0]["template_line"], 1);
  EXPECT_EQ(trial["shown"][2]["understood"], false);
  const Json page = json(try_it("?limit=1&offset=3"));
  ASSERT_EQ(page["shown"].size(), 1u);
  EXPECT_EQ(page["shown"][0]["line"], "D 40.100");
  EXPECT_EQ(page["lines"], 4);
  const Json unmatched = json(try_it("?unmatched=yes"));
  ASSERT_EQ(unmatched["shown"].size(), 1u);
  EXPECT_EQ(unmatched["shown"][0]["line"], "LOAD 3");
  // Nothing was stored of it, whatever the text made of the run.
  EXPECT_EQ(
      json(try_it("", "[[line]]\nform='LOAD {actual}'\ncharacteristic='load'\n"))["measurements"],
      1);
  EXPECT_EQ(json(get("/api/v1/measurements"))["measurements"].size(), 3u);
  expect_error(try_it("", "[[line]]\n"), 400, "syntax", "line 1: a line needs a form");
  expect_error(
      call("POST", "/api/v1/runs/run-9/template-trial", {.body = kTemplate, .headers = {}}), 404,
      "not_found", "run-9");
}

TEST_F(MeasurementRoutes, TryATemplateOnARunThatAlarmed) {
  measure({"D 40.001"}, storage::RunState::Alarmed);
  const Json trial =
      json(call("POST", "/api/v1/runs/run-1/template-trial", {.body = kTemplate, .headers = {}}));
  ASSERT_EQ(trial["at_end"].size(), 2u) << trial.dump();
  EXPECT_EQ(trial["at_end"][0]["text"], "the part's end did not come: its run ended alarmed");
  EXPECT_EQ(trial["at_end"][1]["verdict"], "unknown");
  EXPECT_EQ(json(get("/api/v1/parts?run=run-1"))["parts"][0]["verdict"], "unknown");
}

TEST_F(MeasurementRoutes, ReadAnArchiveBack) {
  measure();
  measurements_->end();
  expect_error(get("/api/v1/archives"), 404, "not_found", "--archives");
  set_up_archives();
  const Json before = json(get("/api/v1/archives"));
  EXPECT_EQ(before["retention"]["records"]["days"], 1);
  EXPECT_TRUE(before["retention"]["records"]["rows"].is_null());
  clock_.advance(std::chrono::hours(48));
  ASSERT_EQ(call("POST", "/api/v1/archives").status, 200);
  const Json archives = json(get("/api/v1/archives"))["archives"];
  const auto records = std::ranges::find_if(
      archives, [](const Json& archive) { return archive["kind"] == "records"; });
  ASSERT_NE(records, archives.end()) << archives.dump();
  const std::string path = fmt::format("/api/v1/archives/{}/rows", (*records)["id"].dump());
  const Json rows = json(get(path + "?contains=40.0&limit=1"));
  EXPECT_EQ(rows["found"], 2);
  ASSERT_EQ(rows["rows"].size(), 1u);
  EXPECT_EQ(rows["rows"][0]["text"], "D 40.001");
  expect_error(get("/api/v1/archives/99/rows"), 404, "not_found", "99");
  const auto file = folder_.path() / (*records)["file"].get<std::string>();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  expect_error(get(path), 500, "corrupt", "");
  const Call operator_call{.body = "", .headers = {}, .token = token_of("operator")};
  EXPECT_EQ(call("GET", path, operator_call).status, 403);
}

TEST_F(MeasurementRoutes, NeedTheRightToChangeTemplates) {
  const Call operator_call{.body = kTemplate, .headers = {}, .token = token_of("operator")};
  EXPECT_EQ(call("PUT", "/api/v1/report-templates/bore", operator_call).status, 403);
  const Call programmer{.body = kTemplate, .headers = {}, .token = token_of("programmer")};
  EXPECT_EQ(call("PUT", "/api/v1/report-templates/bore", programmer).status, 200);
}

}  // namespace
}  // namespace dripline::server_test
