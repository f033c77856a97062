#include <gtest/gtest.h>
#include <csignal>
#include <mutex>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::FakeServer;
using test_support::machine_json;
using test_support::run_json;

class DncOnline : public testing::Test {
 protected:
  DncOnline() {
    dnc.environment["DRIPLINE_SERVER"] = server.url();
    dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
  }
  FakeServer server;
  test_support::Dnc dnc{DNC_PATH};
};

TEST_F(DncOnline, PushesPullsListsAndShows) {
  dnc.write("shaft.nc", "G1 X1\nM30\n");
  const auto pushed = dnc({"program", "push", "shaft.nc", "--name", "O 1"});
  EXPECT_EQ(pushed.status, 0) << pushed.err;
  EXPECT_TRUE(pushed.out.starts_with("Pushed O 1 revision 1: 10 B, sha256 ")) << pushed.out;
  EXPECT_EQ(pushed.err, "");
  EXPECT_EQ(server.content("O 1"), "G1 X1\nM30\n");

  EXPECT_EQ(dnc({"program", "pull", "O 1", "-o", "back.nc"}).status, 0);
  EXPECT_EQ(dnc.read("back.nc"), "G1 X1\nM30\n");
  EXPECT_EQ(dnc({"program", "pull", "O 1", "-o", "-"}).out, "G1 X1\nM30\n");

  const auto list = json::parse(dnc({"program", "list", "--json"}).out);
  EXPECT_EQ(list.at("programs").at(0).at("name"), "O 1");
  const auto shown = json::parse(dnc({"program", "show", "O 1", "--json"}).out);
  EXPECT_EQ(shown.at("revisions").size(), 1u);
  EXPECT_EQ(shown.at("revisions").at(0).at("size"), 10);
}

TEST_F(DncOnline, SaysThatAProgramIsUnchanged) {
  server.add_program("shaft.nc", "M30\n");
  dnc.write("shaft.nc", "M30\n");
  const auto pushed = dnc({"program", "push", "shaft.nc"});
  EXPECT_EQ(pushed.status, 0);
  EXPECT_EQ(pushed.out, "shaft.nc is unchanged: revision 1 already has this content\n");
}

TEST_F(DncOnline, ListsEveryPage) {
  for (int i = 0; i < 250; ++i) server.add_program("P" + std::to_string(i), "M30\n");
  const auto list = json::parse(dnc({"program", "list", "--json"}).out);
  EXPECT_EQ(list.at("programs").size(), 250u);
}

TEST_F(DncOnline, ListsMoreMachinesThanOneAnswerHolds) {
  for (int i = 0; i < 1001; ++i) server.set_machine(machine_json(fmt::format("m{:04}", i)));
  const auto list = json::parse(dnc({"machine", "list", "--json"}).out);
  ASSERT_EQ(list.at("machines").size(), 1001u);
  EXPECT_EQ(list.at("machines").back().at("name"), "m1000");
}

TEST_F(DncOnline, RemovesAMachine) {
  server.set_answer("DELETE /api/v1/machines/lathe-9", 204, "");
  const auto removed = dnc({"machine", "remove", "lathe-9"});
  EXPECT_EQ(removed.status, 0) << removed.err;
  EXPECT_EQ(removed.out, "lathe-9 is removed; its runs and records stay.\n");
  EXPECT_EQ(dnc({"machine", "remove", "lathe-8"}).status, 1);
}

TEST_F(DncOnline, TablesHaveNoColorsInAPipe) {
  server.set_machine(machine_json("lathe-1"));
  const auto list = dnc({"machine", "list"});
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_NE(list.out.find("lathe-1  centurion  yes"), std::string::npos) << list.out;
  EXPECT_EQ(list.out.find('\x1b'), std::string::npos);
}

TEST_F(DncOnline, ExitsWithOneWhenTheServerSaysNo) {
  const auto result = dnc({"machine", "status", "no-such"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "dnc: fake: not_found\n");
}

TEST_F(DncOnline, ExitsWithFourWhenTheTokenIsWrong) {
  dnc.environment["DRIPLINE_TOKEN"] = "wrong";
  const auto result = dnc({"machine", "list"});
  EXPECT_EQ(result.status, 4);
  EXPECT_NE(result.err.find("does not accept the token"), std::string::npos);
}

TEST_F(DncOnline, FindsRunsByLatestAndByPrefix) {
  server.set_run(run_json("aa11", "completed"));
  server.set_run(run_json("aa22", "completed"));
  const auto id_of = [&](const char* reference) {
    const auto result = dnc({"run", "show", reference, "--json"});
    return result.status == 0 ? json::parse(result.out).at("id").get<std::string>() : result.err;
  };
  EXPECT_EQ(id_of("latest"), "aa22");
  EXPECT_EQ(id_of("aa1"), "aa11");
  EXPECT_EQ(id_of("aa22"), "aa22");
  EXPECT_EQ(id_of("aa"), "dnc: run 'aa' fits aa22 and aa11; expected more of the id\n");
  EXPECT_NE(id_of("zz").find("no run's id begins with 'zz'"), std::string::npos);
}

TEST_F(DncOnline, GivesCommands) {
  server.set_run(run_json("aa11", "active"));
  std::mutex mutex;  // the server's threads write what this one reads
  std::vector<std::string> commands;
  server.on_command([&](const std::string& run, const json& body) {
    const std::lock_guard lock(mutex);
    commands.push_back(run + " " + body.dump());
  });
  EXPECT_EQ(dnc({"run", "hold", "latest"}).status, 0);
  EXPECT_EQ(dnc({"run", "answer", "aa", "16.5"}).status, 0);
  EXPECT_EQ(dnc({"run", "override", "latest", "--feed", "50", "--rapid", "25"}).status, 0);
  EXPECT_EQ(dnc({"run", "switch", "latest", "single_block", "on"}).status, 0);
  EXPECT_EQ(dnc({"run", "switch", "latest", "emergency-stop", "on"}).status, 0);
  EXPECT_EQ(dnc({"machine", "switch", "lathe-1", "emergency-stop", "off"}).out,
            "lathe-1 took emergency_stop off\n");
  const std::lock_guard lock(mutex);
  EXPECT_EQ(commands, (std::vector<std::string>{
                          R"(aa11 {"action":"hold"})", R"(aa11 {"action":"answer","text":"16.5"})",
                          R"(aa11 {"action":"feed_override","value":0.5})",
                          R"(aa11 {"action":"rapid_override","value":0.25})",
                          R"(aa11 {"action":"switch","name":"single_block","value":1.0})",
                          R"(aa11 {"action":"switch","name":"emergency_stop","value":1.0})",
                          R"(lathe-1 {"action":"switch","name":"emergency_stop","value":0.0})"}));
}

TEST_F(DncOnline, ExportsAReport) {
  server.set_run(run_json("aa11", "completed"));
  EXPECT_EQ(dnc({"report", "export", "latest", "--format", "csv"}).out, "report as csv\n");
  EXPECT_EQ(dnc({"report", "export", "latest", "-o", "r.txt"}).status, 0);
  EXPECT_EQ(dnc.read("r.txt"), "report as text\n");
  const auto shown = dnc({"report", "show", "latest"}).out;
  EXPECT_TRUE(shown.ends_with("\n\nreport as text\n")) << shown;
}

TEST_F(DncOnline, SaysThatStandardOutputIsFull) {
  server.set_run(run_json("aa11", "completed"));
  const auto full = test_support::run_to_end(
      {"/bin/sh", "-c",
       "exec \"$0\" --server \"$1\" --token-file \"$2\" report export latest >/dev/full", DNC_PATH,
       server.url(), dnc.write("token", FakeServer::kToken)},
      dnc.folder() / "full.txt");
  EXPECT_EQ(full.status, 2);
  EXPECT_NE(full.output.find("standard output cannot be written"), std::string::npos)
      << full.output;
}

TEST_F(DncOnline, FollowsARunToItsEnd) {
  server.set_machine(machine_json("lathe-1"));
  server.set_run(run_json("aa11", "active"));
  auto follow = dnc.start({"run", "start", "lathe-1", "O0200", "--follow"});
  ASSERT_TRUE(test_support::eventually(
      [&] { return follow.output().find("O0200 on lathe-1") != std::string::npos; }));
  server.set_run(run_json("aa11", "completed"));
  server.publish("run", run_json("aa11", "completed"));
  EXPECT_EQ(follow.wait(), 0);
  EXPECT_NE(follow.output().find("Run aa11 of O0200 on lathe-1 completed: 42 blocks"),
            std::string::npos)
      << follow.output();
}

TEST_F(DncOnline, ExitsWithOneWhenTheRunDidNotComplete) {
  server.set_run(run_json("aa11", "alarmed"));
  EXPECT_EQ(dnc({"run", "start", "lathe-1", "O0200", "--wait"}).status, 1);
  EXPECT_EQ(dnc({"run", "watch", "latest"}).status, 1);
}

TEST_F(DncOnline, LeavesTheRunAloneOnInterrupt) {
  server.set_machine(machine_json("lathe-1"));
  server.set_run(run_json("aa11", "active"));
  int commands = 0;
  server.on_command([&](const std::string&, const json&) { ++commands; });
  auto watch = dnc.start({"run", "watch", "aa11"});
  ASSERT_TRUE(test_support::eventually(
      [&] { return watch.output().find("O0200 on lathe-1") != std::string::npos; }));
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
  EXPECT_NE(watch.output().find("run aa11 continues"), std::string::npos) << watch.output();
  EXPECT_EQ(commands, 0);
}

TEST_F(DncOnline, WatchesMachinesLineByLineInAPipe) {
  server.set_machine(machine_json("lathe-1"));
  auto watch = dnc.start({"machine", "watch"});
  ASSERT_TRUE(test_support::eventually([&] {
    return watch.output().find("lathe-1  connected, no status yet\n") != std::string::npos;
  }));
  auto gone = machine_json("lathe-1");
  gone["connected"] = false;
  server.publish("machine", gone);
  EXPECT_TRUE(test_support::eventually(
      [&] { return watch.output().find("lathe-1  not connected\n") != std::string::npos; }));
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
}

}  // namespace
}  // namespace dripline
