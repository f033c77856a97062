#include "storage/sqlite/database.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

/// Until it is broken, the real one.
class BreakableAudit final : public storage::AuditStore {
 public:
  explicit BreakableAudit(storage::AuditStore& inner) : inner_(inner) {}

  Result<void> add(const storage::AuditEntry& entry) override {
    if (is_broken) return fail(Errc::Io, "disk full");
    return inner_.add(entry);
  }
  Result<std::vector<storage::AuditEntry>> list(storage::Page page) override {
    return inner_.list(page);
  }
  Result<std::vector<storage::ChainedEntry>> chained(std::uint64_t after,
                                                     std::uint64_t limit) override {
    return inner_.chained(after, limit);
  }
  Result<std::vector<audit::Checkpoint>> checkpoints(std::uint64_t after,
                                                     std::uint64_t limit) override {
    return inner_.checkpoints(after, limit);
  }
  Result<void> add_checkpoint(const audit::Checkpoint& checkpoint) override {
    return inner_.add_checkpoint(checkpoint);
  }
  Result<std::optional<storage::ChainedEntry>> run_end(const std::string& run) override {
    return inner_.run_end(run);
  }
  Result<std::optional<std::string>> run_without_end() override { return inner_.run_without_end(); }

  bool is_broken = false;

 private:
  storage::AuditStore& inner_;
};

class AuditRoutes : public ApiTest {
 protected:
  AuditRoutes() : breakable_(store_->audit) {
    real_ = std::exchange(audit_, std::make_unique<library::AuditTrail>(breakable_, clock_));
    make_api(&ports_);
  }
  Json newest() { return json(get("/api/v1/audit"))["entries"][0]; }
  Json audit_state() { return json(get("/api/v1/audit/verification")); }

  BreakableAudit breakable_;
  std::unique_ptr<library::AuditTrail> real_;  ///< of the library and the accounts
};

// -- the entry comes first ------------------------------------------------------------------------

TEST_F(AuditRoutes, NothingIsStartedWithoutItsEntry) {
  stored_run(0);
  breakable_.is_broken = true;
  const Json start{{"machine", "lathe-1"}, {"program", "O0100"}};
  const auto refused = post("/api/v1/runs", start);
  EXPECT_GE(refused.status, 500) << refused.body;
  EXPECT_NE(refused.body.find("nothing is done: disk full"), std::string::npos) << refused.body;
  EXPECT_EQ(machines_.sent, 0);
  EXPECT_NE(post("/api/v1/runs/run-1/restart", {{"at", "executed"}}).status, 201);
  EXPECT_EQ(machines_.sent, 0);
  breakable_.is_broken = false;
  EXPECT_EQ(post("/api/v1/runs", start).status, 201);
  EXPECT_EQ(machines_.sent, 1);
}

TEST_F(AuditRoutes, OnlyWhatStopsGoesOutWithoutItsEntry) {
  const std::string run = stored_run(0);
  machines_.views.front().status.emplace().feed_override = 0.8;
  breakable_.is_broken = true;
  const std::string of_run = "/api/v1/runs/" + run + "/commands";
  const std::string of_machine = "/api/v1/machines/lathe-1/commands";
  const auto goes_out = [&](const std::string& path, const Json& command) {
    const auto before = machines_.commands.size();
    const int status = post(path, command).status;
    EXPECT_EQ(status == 200, machines_.commands.size() > before) << command;
    return status == 200;
  };
  EXPECT_TRUE(goes_out(of_run, {{"action", "hold"}}));
  EXPECT_TRUE(goes_out(of_run, {{"action", "abort"}}));
  EXPECT_TRUE(goes_out(of_run, {{"action", "feed_override"}, {"value", 0.5}}));
  EXPECT_FALSE(goes_out(of_run, {{"action", "feed_override"}, {"value", 1.0}}));
  EXPECT_FALSE(goes_out(of_run, {{"action", "resume"}}));
  const auto stop = [](int value) {
    return Json{{"action", "switch"}, {"name", "emergency_stop"}, {"value", value}};
  };
  EXPECT_TRUE(goes_out(of_machine, stop(1)));
  EXPECT_FALSE(goes_out(of_machine, stop(0)));
  ports::PortView line;
  line.port.name = "line-1";
  ports_.views.push_back(line);
  const Json programs{{"programs", {"O0100"}}};
  EXPECT_GE(post("/api/v1/ports/line-1/transfers", programs).status, 500);
  breakable_.is_broken = false;
  EXPECT_EQ(post("/api/v1/ports/line-1/transfers", programs).status, 201);
}

TEST_F(AuditRoutes, ACommandThatWasRefusedHasItsReasonToo) {
  const std::string run = stored_run(0);
  machines_.refusal = Error{Errc::Busy, "the door is open"};
  post("/api/v1/runs/" + run + "/commands", {{"action", "resume"}});
  EXPECT_EQ(newest()["action"], "run.resume");
  EXPECT_EQ(newest()["detail"], "refused, the door is open");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][1]["action"], "run.resume");
}

// -- verification ---------------------------------------------------------------------------------

TEST_F(AuditRoutes, VerifyTheTrailAndNameTheFirstPlace) {
  EXPECT_TRUE(audit_state()["verification"].is_null()) << "not yet";
  EXPECT_EQ(get("/api/v1/metrics").body.find("dripline_audit_chain_ok"), std::string::npos);
  for (const char* program : {"O1", "O2"}) push(program, "M30\n");
  const Json good = json(call("POST", "/api/v1/audit/verification"));
  EXPECT_EQ(good["verification"]["intact"], true) << good;
  EXPECT_EQ(good["checkpoint"]["entry"], good["verification"]["entries"]);
  EXPECT_EQ(audit_state(), good);
  EXPECT_NE(get("/api/v1/metrics").body.find("\ndripline_audit_chain_ok 1\n"), std::string::npos);
  const auto kept = audit::parse_kept_checkpoint(good["checkpoint"]["text"].get<std::string>());
  ASSERT_TRUE(kept) << kept.error().what;

  auto database = storage::sqlite::Database::open(folder_.path() / "store.sqlite");
  ASSERT_TRUE(database->execute("UPDATE audit SET who = 'stranger' WHERE id = 2"));
  const Json changed = json(call("POST", "/api/v1/audit/verification"));
  EXPECT_EQ(changed["verification"]["intact"], false);
  EXPECT_EQ(changed["verification"]["fault"]["entry"], 2) << changed;
  EXPECT_NE(get("/api/v1/metrics").body.find("\ndripline_audit_chain_ok 0\n"), std::string::npos);
  const std::string exported = body(get("/api/v1/audit/export"));
  audit::TrailReader reader(*kept);
  ASSERT_TRUE(reader.feed(exported));
  EXPECT_EQ(reader.verifier()->first_fault()->entry, 2u);
}

TEST_F(AuditRoutes, VerifyTheArchivesAndNameThem) {
  EXPECT_TRUE(json(call("POST", "/api/v1/audit/verification"))["archives"].is_null());
  set_up_archives();
  stored_run(3);
  ASSERT_TRUE(store_->runs.set_state("run-1", storage::RunState::Aborted, "test"));
  EXPECT_EQ(get("/api/v1/metrics").body.find("dripline_archives"), std::string::npos);
  clock_.advance(std::chrono::hours(48));
  ASSERT_EQ(json(call("POST", "/api/v1/archives"))["made"], 1);
  Json state = json(call("POST", "/api/v1/audit/verification"));
  EXPECT_EQ(state["archives"]["archives"], 1) << state;
  EXPECT_EQ(state["archives"]["intact"], true) << state;
  EXPECT_NE(get("/api/v1/metrics").body.find("\ndripline_archives_damaged 0\n"), std::string::npos);
  const std::string file = json(get("/api/v1/archives"))["archives"][0]["file"];
  std::filesystem::remove(folder_.path() / file);
  state = json(call("POST", "/api/v1/audit/verification"));
  EXPECT_EQ(state["verification"]["intact"], true) << "the trail itself is";
  EXPECT_EQ(state["archives"]["intact"], false);
  EXPECT_EQ(state["archives"]["faults"],
            Json::parse(R"([{"file":")" + file + R"(","what":"it is missing"}])"));
  EXPECT_EQ(audit_state(), state);
  EXPECT_NE(get("/api/v1/metrics").body.find("\ndripline_archives_damaged 1\n"), std::string::npos);
}

}  // namespace
}  // namespace dripline::server_test
