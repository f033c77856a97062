// MDI with real processes: a server and a gateway in real time, `dnc` as its users type it.
#include <gtest/gtest.h>
#include <array>
#include <fstream>
#include <thread>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;
using Reply = test_support::RestClient::Reply;

class MdiSystem : public testing::Test {
 protected:
  void begin(const std::string& speed = "1x", const std::string& setup = "",
             const std::string& control = "fanuc") {
    std::vector<std::string> arguments;
    if (!setup.empty()) {
      const std::string file = folder_.path() / "setup.toml";
      std::ofstream(file) << setup;
      arguments = {"--setup", file};
    }
    system.emplace(System::Options{.speed = speed,
                                   .server_arguments = {},
                                   .gateway_arguments = std::move(arguments),
                                   .control = control});
    system->start_server();
    system->start_gateway();
    system->wait_connected();
  }
  Reply key_in(const std::string& text) {
    return system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", text}});
  }
  /// Its run; empty where it is refused.
  std::string run_of(const std::string& text) {
    const Reply reply = key_in(text);
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.status == 201 ? reply.json().value("id", "") : "";
  }
  json mdi(const std::string& text) {
    const std::string id = run_of(text);
    return id.empty() ? json() : system->wait_ended(id);
  }
  json status() { return system->rest().get("/api/v1/machines/lathe-1").json()["status"]; }
  double x() {
    const json now = status();
    return now.is_object() ? now["position"].value("X", -1e9) : -1e9;
  }
  void command(const std::string& id, const char* action) {
    const Reply reply =
        system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
    EXPECT_EQ(reply.status, 200) << reply.body;
  }
  std::size_t runs_in(const std::string& state) {
    return system->rest().get("/api/v1/runs?machine=lathe-1&state=" + state).json()["runs"].size();
  }
  /// Details of the audit trail's entries of this action, newest first.
  std::vector<std::string> audited(const std::string& action) {
    json trail = system->rest().get("/api/v1/audit?limit=1000").json();
    std::vector<std::string> details;
    for (const json& entry : trail["entries"])
      if (entry.value("action", "") == action) details.push_back(entry.value("detail", ""));
    return details;
  }
  void ends_idle() {
    json now;
    EXPECT_TRUE(eventually([&] {
      now = status();
      return now.is_object() && now["run"].is_null();
    })) << now.dump();
  }

  test_support::TemporaryFolder folder_;
  std::optional<System> system;
};

TEST_F(MdiSystem, MovesTheAxesAndIsOnRecordWithItsText) {
  begin("max");
  const json run = mdi("G21 G90 G0 X12.5\n");
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("program", ""), "MDI lathe-1");
  EXPECT_EQ(run.value("executed", 0), 1);
  EXPECT_TRUE(eventually([&] { return x() == 12.5; })) << status().dump();
  EXPECT_EQ(mdi("G91 X1.\n").value("state", ""), "completed");
  EXPECT_EQ(mdi("X1.\n").value("state", ""), "completed") << "G91 is in force";
  EXPECT_TRUE(eventually([&] { return x() == 14.5; })) << status().dump();
  const auto details = audited("run.mdi");
  ASSERT_EQ(details.size(), 3U);
  EXPECT_NE(details.back().find("lathe-1: G21 G90 G0 X12.5"), std::string::npos);
}

TEST_F(MdiSystem, IsRefusedWhileARunIsActiveAndChangesNothing) {
  begin();
  system->push("O1", "O1\nG21 G90 G1 X5. F100\nM30\n");
  const std::string run = system->start_run("O1");
  const Reply refused = key_in("G0 X50.\n");
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("busy with run " + run), std::string::npos) << refused.body;
  EXPECT_EQ(system->rest().get("/api/v1/programs/MDI%20lathe-1").status, 404) << "not kept";
  EXPECT_EQ(system->wait_ended(run).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return x() == 5; })) << status().dump();
}

/// Starts and blocks keyed in at the same moment, again and again: each is a run that ends, or is
/// refused, and never two at once.
TEST_F(MdiSystem, OneOfManyAtOnceRunsAndTheOthersAreRefused) {
  begin("max");
  system->push("O1", "O1\nG21 G91 G0 X100.\nM30\n");
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    std::array<Reply, 4> replies;
    std::vector<std::thread> senders;
    for (std::size_t i = 0; i < replies.size(); ++i) {
      senders.emplace_back([&, i] {
        replies[i] = i == 0 ? system->rest().post("/api/v1/runs",
                                                  {{"machine", "lathe-1"}, {"program", "O1"}})
                            : key_in("G21 G91 G1 X1. F6000\n");
      });
    }
    for (auto& sender : senders) sender.join();
    int accepted = 0;
    for (const Reply& reply : replies) {
      if (reply.status == 201) {
        ++accepted;
        EXPECT_EQ(system->wait_ended(reply.json().value("id", "")).value("state", ""), "completed")
            << reply.body;
      } else {
        EXPECT_EQ(reply.status, 409) << reply.body;
      }
    }
    EXPECT_GE(accepted, 1);
    ends_idle();
    EXPECT_EQ(runs_in("active") + runs_in("ordered"), 0U);
  }
  EXPECT_EQ(mdi("G90 G0 X0\n").value("state", ""), "completed");
}

TEST_F(MdiSystem, AnAbortStopsItsMotionAndTheNextBeginsWhereTheAxesAre) {
  begin();
  const std::string id = run_of("G21 G91 G1 X500. F3000\n");
  ASSERT_TRUE(eventually([&] { return x() > 1; })) << status().dump();
  EXPECT_EQ(status().value("mode", ""), "MANUAL_DATA_INPUT");
  command(id, "abort");
  const json run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "aborted") << run.dump();
  ends_idle();
  const double at = x();
  EXPECT_LT(at, 500);
  const std::string next = run_of("G91 G0 X1.\n");
  EXPECT_EQ(system->wait_ended(next).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return std::abs(x() - at - 1) < 0.001; })) << at << " " << x();
  const auto records = system->rest().get("/api/v1/runs/" + next + "/records").body;
  EXPECT_NE(records.find("MDI begins with the modes of power on"), std::string::npos) << records;
}

TEST_F(MdiSystem, AKilledServerFindsItsEndAndAKilledGatewayRepeatsNothing) {
  begin();
  const std::string first = run_of("G21 G91 G1 X5. F300\n");
  system->server().kill();
  system->start_server();
  system->wait_connected();
  const json run = system->wait_ended(first);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(eventually([&] { return x() == 5; })) << status().dump();

  const std::string second = run_of("G1 X400. F3000\n");
  ASSERT_TRUE(eventually([&] { return x() > 6; }));
  system->gateway().kill();
  system->start_gateway();
  system->wait_connected();
  EXPECT_EQ(system->wait_ended(second).value("state", ""), "interrupted");
  EXPECT_TRUE(eventually([&] { return x() == 0; })) << "a simulated machine begins at its start";
  EXPECT_EQ(system->rest().post("/api/v1/runs/" + second + "/restart", json::object()).status / 100,
            4)
      << "what was keyed in is not restarted";
  EXPECT_EQ(x(), 0);
}

/// What it changes in the control's memory is reported, and the next program finds it.
TEST_F(MdiSystem, OffsetsAndToolsChangedByItAreKept) {
  begin("max", "[[offset]]\nname = \"G54\"\nX = 100.0\n\n[[tool]]\nnumber = 3\nlength = 50.0\n");
  const std::string id = run_of("G21 G90 G10 L2 P1 X40.\nG10 L10 P3 R51.5\n");
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed");
  const auto memory =
      system->rest().get("/api/v1/machines/lathe-1/memory?run=" + id).json()["memories"];
  ASSERT_EQ(memory.size(), 1U);
  EXPECT_NE(memory.dump().find(R"({"name":"G54.X","setup":100.0,"value":40.0})"), std::string::npos)
      << memory.dump();
  EXPECT_NE(memory.dump().find(R"({"name":"tool.3.length","setup":50.0,"value":51.5})"),
            std::string::npos)
      << memory.dump();
  system->gateway().kill();
  system->start_gateway();
  system->wait_connected();
  system->push("O1", "O1\nG21 G90 G54 G0 X1.\nM30\n");
  EXPECT_EQ(system->wait_ended(system->start_run("O1")).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return x() == 41; })) << status().dump();
}

TEST_F(MdiSystem, ObeysLimitsAndTheBoundsOfItsText) {
  begin("max", "[control]\nstroke_limits = [{ X = 0.0 }, { X = 200.0 }]\n");
  const json run = mdi("G21 G90 G0 X-1.\n");
  EXPECT_EQ(run.value("state", ""), "alarmed") << run.dump();
  EXPECT_EQ(x(), 0);
  std::string many;
  for (int i = 0; i < 11; ++i) many += "G4 X0\n";
  const Reply refused = key_in(many);
  EXPECT_EQ(refused.status, 413) << refused.body;
  EXPECT_NE(refused.body.find("11 blocks: MDI of control fanuc takes 10"), std::string::npos);
  EXPECT_EQ(key_in(std::string(100'000, 'G')).status / 100, 4);
  EXPECT_EQ(key_in("").status, 400);
  EXPECT_EQ(x(), 0);
}

/// Datum and touch-off, as `dnc` has them: kept over kills at both ends, known to the server.
TEST_F(MdiSystem, ADatumSetFromThePositionIsKeptAndOnRecord) {
  begin("max", "[[tool]]\nnumber = 3\nlength = 50.0\n");
  EXPECT_EQ(mdi("G21 G91 G0 X25. Z-40.\n").value("state", ""), "completed");
  const auto set = [&](const char* what, const json& body) {
    return system->rest().post(std::string("/api/v1/machines/lathe-1/") + what, body);
  };
  const json datum{{"offset", "G54"}, {"axis", "X"}, {"value", 5}, {"unit", "mm"}};
  const Reply done = set("datum", datum);
  ASSERT_EQ(done.status, 200) << done.body;
  EXPECT_EQ(done.json().value("text", ""),
            "G54.X is 20.000 mm, it was 0.000 (no tool's length in force along X)");
  EXPECT_EQ(done.json()["what"], "datum G54 X 5 mm");
  EXPECT_EQ(done.json()["cells"].dump(),
            R"([{"before":0.0,"name":"G54.X","unit":"mm","value":20.0}])");
  EXPECT_EQ(done.json()["length"], 0);
  EXPECT_TRUE(done.json()["zero"].is_null());
  system->gateway().kill();  // it was on disk before it was answered
  system->server().kill();
  system->start_server();
  system->start_gateway();
  system->wait_connected();
  const std::string change = done.json().value("change", "");
  json memories;
  EXPECT_TRUE(eventually([&] {
    memories = system->rest().get("/api/v1/machines/lathe-1/memory?run=" + change).json();
    return memories.contains("memories") && memories["memories"].size() == 1;
  })) << memories.dump();
  EXPECT_EQ(memories["memories"][0]["change"]["what"], "datum G54 X 5 mm");
  EXPECT_EQ(memories["memories"][0]["change"]["who"], "admin");
  const json history =
      system->rest().get("/api/v1/machines/lathe-1/offset-history?target=G54").json();
  ASSERT_EQ(history["at_machine"].size(), 1U) << history.dump();
  EXPECT_EQ(history["at_machine"][0]["target"], "G54.X");
  EXPECT_EQ(history["at_machine"][0]["unit"], "mm");
  EXPECT_EQ(history["at_machine"][0]["length"], 0);
  system->push("O1", "O1\nG21 G90 G54 G0 X7.\nM30\n");
  EXPECT_EQ(system->wait_ended(system->start_run("O1")).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return x() == 27; })) << status().dump();
  EXPECT_EQ(audited("machine.datum").size(), 2U) << "asked, and done";
}

/// Touch off X, move, touch off Z; the answer of MDI says that the tool is lost, and what that
/// does.
TEST_F(MdiSystem, ATouchOffAfterMdiWithoutTheToolIsByTheAxes) {
  begin("max", "[[tool]]\nnumber = 3\nlength = 10.0\n");
  const auto notice = [&](const std::string& text) {
    const Reply reply = key_in(text);
    EXPECT_EQ(reply.status, 201) << reply.body;
    EXPECT_EQ(system->wait_ended(reply.json().value("id", "")).value("state", ""), "completed");
    return reply.json()["notice"];
  };
  EXPECT_TRUE(notice("G21 G43 H3 G91 G1 Z-180. F9000\n").is_string());
  const auto set = [&](const char* what, const json& body) {
    return system->rest().post(std::string("/api/v1/machines/lathe-1/") + what, body);
  };
  EXPECT_EQ(set("datum", {{"offset", "G54"}, {"axis", "X"}, {"value", 0}}).status, 200);
  const json moved = notice("G21 G91 G1 X1. F9000\n");
  EXPECT_NE(moved.dump().find("from here on: Z 10 mm"), std::string::npos) << moved;
  const json tool{{"tool", 3}, {"offset", "G54"}, {"axis", "Z"}, {"value", -179.5}, {"unit", "mm"}};
  const Reply done = set("touch-off", tool);
  ASSERT_EQ(done.status, 200) << done.body;
  EXPECT_EQ(done.json()["cells"][0]["value"], 9.5) << done.body;
  EXPECT_EQ(done.json()["length"], 0) << done.body;
  EXPECT_EQ(done.json()["zero"], 0) << done.body;
  EXPECT_TRUE(notice("G21 G91 G1 X1. F9000\n").is_string()) << "the memory was changed";
  EXPECT_TRUE(notice("X1.\n").is_null());
}

/// Who learns that a run has ended finds the machine where it is.
TEST_F(MdiSystem, TheStatusIsThatOfTheEndWhenTheRunHasEnded) {
  begin("max");
  for (int i = 1; i <= 10; ++i) {
    EXPECT_EQ(mdi("G21 G91 G0 X1.\n").value("state", ""), "completed");
    EXPECT_EQ(x(), i);
  }
}

TEST_F(MdiSystem, ValuesAreThoseOfTheSetupBeforeTheFirstRun) {
  begin("max", "[[offset]]\nname = \"G54\"\nX = 100.0\n");
  const auto values = [&] {
    return system->rest().get("/api/v1/machines/lathe-1/values?beginning=G54.X").body;
  };
  EXPECT_NE(values().find(R"({"name":"G54.X","value":100.0})"), std::string::npos) << values();
  const Reply saved = system->rest().put_bytes("/api/v1/machines/lathe-1/setup",
                                               "[[offset]]\nname = \"G54\"\nX = 40.0\n");
  EXPECT_EQ(saved.status / 100, 2) << saved.body;
  EXPECT_NE(values().find(R"({"name":"G54.X","value":40.0})"), std::string::npos) << values();
}

TEST_F(MdiSystem, ARotaryAxisTakesDegrees) {
  begin("max");
  const auto datum = [&](const json& unit) {
    json body{{"offset", "G54"}, {"axis", "A"}, {"value", 90}};
    if (!unit.is_null()) body["unit"] = unit;
    return system->rest().post("/api/v1/machines/lathe-1/datum", body);
  };
  const Reply refused = datum("in");
  EXPECT_EQ(refused.status, 400) << refused.body;
  EXPECT_NE(refused.body.find("its value is in degrees"), std::string::npos) << refused.body;
  for (const json& unit : {json("deg"), json(nullptr)}) {
    const Reply done = datum(unit);
    ASSERT_EQ(done.status, 200) << done.body;
    EXPECT_EQ(done.json()["cells"][0]["value"], -90) << done.body;
    EXPECT_EQ(done.json()["cells"][0]["unit"], "deg") << done.body;
  }
}

TEST_F(MdiSystem, NothingIsSetWhileAProgramRuns) {
  begin();
  system->push("O1", "O1\nG21 G90 G1 X5. F100\nM30\n");
  const std::string run = system->start_run("O1");
  const Reply refused =
      system->rest().post("/api/v1/machines/lathe-1/touch-off",
                          {{"tool", 3}, {"offset", "G54"}, {"axis", "Z"}, {"value", 0}});
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("busy with run " + run), std::string::npos) << refused.body;
  EXPECT_EQ(system->wait_ended(run).value("state", ""), "completed");
  EXPECT_TRUE(system->rest().get("/api/v1/machines/lathe-1/memory").json()["memories"].empty());
}

/// A tool that is changed by hand: who waits for the end sees how to continue, and not for ever.
TEST_F(MdiSystem, WhoWaitsAtAToolChangeIsToldHowToGoOn) {
  begin("max", "[[tool]]\nnumber = 2\nX = 1.0\n", "centurion");
  const auto dnc = [&](const std::string& arguments) {
    return test_support::run_to_end(
        {"/bin/sh", "-c",
         program_path("dnc") + " --server " + system->url() + " --state " +
             system->server_state().string() + " " + arguments},
        system->folder() / "dnc.out");
  };
  const auto waited = dnc("machine mdi lathe-1 'T0202 M6' --timeout 2");
  EXPECT_EQ(waited.status, 124) << waited.output;
  EXPECT_NE(waited.output.find("tool change"), std::string::npos) << waited.output;
  EXPECT_NE(waited.output.find("dnc run resume"), std::string::npos) << waited.output;
  EXPECT_NE(waited.output.find("has not ended in 2 s"), std::string::npos) << waited.output;
  const auto resumed = dnc("run resume latest");
  EXPECT_EQ(resumed.status, 0) << resumed.output;
  EXPECT_TRUE(eventually([&] { return runs_in("active") == 0; }));
  const auto done = dnc("machine mdi lathe-1 'G0 X1' --timeout 30");
  EXPECT_EQ(done.status, 0) << done.output;
}

TEST_F(MdiSystem, NeedsAnOperator) {
  begin("max");
  const auto dnc = [&](const std::string& home, const std::string& arguments,
                       const std::string& typed = "") {
    return test_support::run_to_end(
        {"/bin/sh", "-c",
         "printf '%s\\n' '" + typed + "' | env -u DRIPLINE_TOKEN -u XDG_CONFIG_HOME HOME=" +
             (system->folder() / home).string() + " " + program_path("dnc") + " --server " +
             system->url() +
             (home == "admin" ? " --state " + system->server_state().string() : "") + " " +
             arguments},
        system->folder() / "dnc.out");
  };
  for (const char* user : {"viewer", "operator"}) {
    const std::string name = user;
    const auto added =
        dnc("admin", "user add " + name + "-1 --role " + name + " --group all --password",
            "correct horse");
    ASSERT_EQ(added.status, 0) << added.output;
    ASSERT_EQ(dnc(name, "login " + name + "-1", "correct horse").status, 0);
  }
  const auto denied = dnc("viewer", "machine mdi lathe-1 'G21 G90 G0 X3.' --wait");
  EXPECT_EQ(denied.status, 4) << denied.output;
  EXPECT_EQ(x(), 0);
  const auto datum = dnc("viewer", "machine datum lathe-1 X 0 --offset G54");
  EXPECT_EQ(datum.status, 4) << datum.output;
  const auto set = dnc("operator", "machine datum lathe-1 X -2 --unit mm --offset G54");
  EXPECT_EQ(set.status, 0) << set.output;
  EXPECT_EQ(set.output,
            "lathe-1: G54.X is 2.000 mm, it was 0.000 (no tool's length in force along X)\n");
  const auto back = dnc("operator", "machine datum lathe-1 X 0 --offset G54");
  EXPECT_EQ(back.status, 0) << back.output;
  const auto done = dnc("operator", "machine mdi lathe-1 'G21 G90 G0 X3.' --wait");
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_TRUE(eventually([&] { return x() == 3; })) << status().dump();
}

}  // namespace
}  // namespace dripline::integration
