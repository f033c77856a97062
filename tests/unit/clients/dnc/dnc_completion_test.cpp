#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

namespace dripline {
namespace {

using test_support::Dnc;
using test_support::FakeServer;
using test_support::machine_json;

/// What `dnc completion words` prints, with a server or without one.
class DncCompletion : public testing::Test {
 protected:
  DncCompletion() {
    dnc.environment["DRIPLINE_SERVER"] = server.url();
    dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
    server.add_program("O0100", "M30\n");
    server.add_program("O 2 $(x)", "M30\n");
    server.add_program("shaft.nc", "M30\n");
    server.set_machine(machine_json("lathe-1"));
  }
  std::string words(std::vector<std::string> typed) {
    typed.insert(typed.begin(), {"completion", "words"});
    const auto result = dnc(typed);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }

  FakeServer server;
  Dnc dnc{DNC_PATH};
};

TEST_F(DncCompletion, OffersTheVerbsThatAreThere) {
  EXPECT_EQ(words({"ru"}), "run\n");
  EXPECT_EQ(words({"run", "re"}), "restart\nresume\n");
  EXPECT_NE(words({""}).find("completion\n"), std::string::npos);
  EXPECT_EQ(words({"--server", "x", "server", ""}),
            "status\ndrain\nbackup\nbackups\nverify\nremove-backup\narchive\narchives\nmigrate\n");
}

TEST_F(DncCompletion, OffersTheOptionsOfAVerbAndOfTheWholeProgram) {
  EXPECT_EQ(words({"run", "start", "--f"}), "--from\n--follow\n");
  EXPECT_EQ(words({"run", "start", "--serv"}), "--server\n");
}

TEST_F(DncCompletion, OffersNamesOfTheServer) {
  EXPECT_EQ(words({"run", "start", ""}), "lathe-1\n");
  EXPECT_EQ(words({"run", "start", "lathe-1", "O"}), "O 2 $(x)\nO0100\n");
  EXPECT_EQ(words({"run", "start", "--revision", "2", "lathe-1", "s"}), "shaft.nc\n");
  EXPECT_EQ(words({"program", "show", "sh"}), "shaft.nc\n");
  EXPECT_EQ(words({"run", "show", "la"}), "latest\n");
}

TEST_F(DncCompletion, OffersValuesThatAreFixed) {
  EXPECT_EQ(words({"machine", "switch", "lathe-1", "optional_stop", ""}), "on\noff\n");
  EXPECT_EQ(words({"check", "--control", "t"}), "tektronix-1704\ntnc155\n");
  EXPECT_EQ(words({"report", "export", "latest", "--format", "c"}), "csv\n");
}

TEST_F(DncCompletion, LeavesFilesToTheShell) {
  EXPECT_EQ(words({"program", "push", ""}), ":files\n");
  EXPECT_EQ(words({"check", "sha"}), ":files\n");
}

TEST_F(DncCompletion, OffersNothingWhereNoServerAnswers) {
  EXPECT_EQ(words({"--server", "http://127.0.0.1:1", "run", "start", ""}), "");
  EXPECT_EQ(words({"run", "dance", ""}), words({"run", ""})) << "an unknown word is passed over";
}

TEST_F(DncCompletion, WorksInBash) {
  Dnc bash("/bin/bash");
  bash.environment = dnc.environment;
  bash.write("dnc.bash", dnc({"completion", "bash"}).out);
  const std::string ask = "dnc() { '" DNC_PATH
                          "' \"$@\"; }; compopt() { echo compopt $1 $2; }; . ./dnc.bash; "
                          "ask() { COMP_WORDS=(dnc \"$@\"); COMP_CWORD=$#; _dnc; printf '[%s]' "
                          "\"${COMPREPLY[@]}\"; echo; }; "
                          "ask run start lathe-1 O; ask program push x";
  const auto result = bash({"-c", ask});
  EXPECT_EQ(result.out, "[O 2 $(x)][O0100]\ncompopt -o default\n[]\n") << result.err;
}

TEST_F(DncCompletion, KnowsThreeShells) {
  EXPECT_NE(dnc({"completion", "zsh"}).out.find("#compdef dnc\n"), std::string::npos);
  EXPECT_NE(dnc({"completion", "fish"}).out.find("complete -c dnc"), std::string::npos);
  EXPECT_EQ(dnc({"completion", "sh"}).status, 2);
}

}  // namespace
}  // namespace dripline
