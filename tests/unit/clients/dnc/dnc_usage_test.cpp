#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using test_support::Dnc;

struct UsageCase {
  const char* name;
  std::vector<std::string> arguments;
  int status;
  const char* says;  ///< part of standard error
};

class DncUsage : public testing::TestWithParam<UsageCase> {};

TEST_P(DncUsage, ExitsAsDocumentedAndSaysWhy) {
  const Dnc dnc(DNC_PATH);
  const auto result = dnc(GetParam().arguments);
  EXPECT_EQ(result.status, GetParam().status) << result.err;
  EXPECT_NE(result.err.find(GetParam().says), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    , DncUsage,
    testing::Values(
        UsageCase{"no_verb", {}, 2, "subcommand is required"},
        UsageCase{"unknown_verb", {"dance"}, 2, "dance"},
        UsageCase{"group_without_verb", {"program"}, 2, "subcommand is required"},
        UsageCase{"missing_argument", {"program", "pull"}, 2, "See dnc program pull --help."},
        UsageCase{"unknown_option", {"run", "list", "--color", "red"}, 2, "--color"},
        UsageCase{"wrong_number", {"run", "start", "m", "p", "--revision", "two"}, 2, "two"},
        UsageCase{"wrong_format", {"report", "export", "r", "--format", "xml"}, 2, "xml"},
        UsageCase{"follow_and_wait", {"run", "start", "m", "p", "--follow", "--wait"}, 2, "--wait"},
        UsageCase{"override_of_nothing", {"run", "override", "latest"}, 2, "--feed"},
        UsageCase{"override_too_big", {"run", "override", "latest", "--feed", "5000"}, 2, "5000"},
        UsageCase{"push_unreadable", {"program", "push", "no.nc"}, 2, "no.nc cannot be read"},
        UsageCase{"push_bad_name", {"program", "push", "x", "--name", "../x"}, 2, "../x"},
        UsageCase{"bad_address", {"machine", "list", "--server", "lathe"}, 2, "http://HOST:PORT"},
        UsageCase{"no_server", {"machine", "list"}, 3, "none/dncd.json"},
        UsageCase{"dead_server",
                  {"machine", "list", "--server", "http://127.0.0.1:1"},
                  3,
                  "http://127.0.0.1:1 is not reachable"},
        UsageCase{"migrate_to_nothing",
                  {"server", "migrate", "--to", ""},
                  2,
                  "--to: a value is needed, this one is empty"},
        UsageCase{"migrate_from_nothing",
                  {"server", "migrate", "--from", "", "--to", "/nowhere"},
                  2,
                  "--from: a value is needed, this one is empty"},
        UsageCase{"missing_token_file",
                  {"machine", "list", "--server", "http://h:1", "--token-file", "no.token"},
                  2,
                  "no.token"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(DncHelp, IsThereForEveryVerb) {
  const Dnc dnc(DNC_PATH);
  const std::vector<std::vector<std::string>> verbs = {{},
                                                       {"program"},
                                                       {"program", "push"},
                                                       {"program", "pull"},
                                                       {"program", "list"},
                                                       {"program", "show"},
                                                       {"program", "remove"},
                                                       {"machine"},
                                                       {"machine", "list"},
                                                       {"machine", "status"},
                                                       {"machine", "watch"},
                                                       {"machine", "switch"},
                                                       {"run"},
                                                       {"run", "start"},
                                                       {"run", "list"},
                                                       {"run", "show"},
                                                       {"run", "hold"},
                                                       {"run", "resume"},
                                                       {"run", "abort"},
                                                       {"run", "answer"},
                                                       {"run", "override"},
                                                       {"run", "watch"},
                                                       {"report"},
                                                       {"report", "list"},
                                                       {"report", "show"},
                                                       {"report", "export"},
                                                       {"server"},
                                                       {"server", "status"},
                                                       {"check"},
                                                       {"trace"}};
  for (auto words : verbs) {
    const std::string last = words.empty() ? "" : words.back();
    words.push_back("--help");
    const auto result = dnc(words);
    EXPECT_EQ(result.status, 0) << last;
    EXPECT_NE(result.out.find("Usage: dnc"), std::string::npos) << last;
  }
}

TEST(DncHelp, DocumentsTheExitStatus) {
  const Dnc dnc(DNC_PATH);
  const auto result = dnc({"--help"});
  for (const char* line :
       {"0    success", "1    refused by the program, the run or the server", "2    usage",
        "3    the server is not reachable", "4    the server does not accept the token",
        "130  interrupted by Ctrl-C"}) {
    EXPECT_NE(result.out.find(line), std::string::npos) << line;
  }
}

TEST(DncHelp, ShowsWhatAValueMayBe) {
  const Dnc dnc(DNC_PATH);
  const std::string states = dnc({"run", "switch", "--help"}).out;
  EXPECT_NE(states.find("STATE on|off REQUIRED"), std::string::npos) << states;
  const std::string range = dnc({"graphics", "--help"}).out;
  EXPECT_NE(range.find("--tilt 5..90"), std::string::npos) << range;
}

TEST(DncVersion, IsOneLine) {
  const Dnc dnc(DNC_PATH);
  const auto result = dnc({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.out.starts_with("dnc ")) << result.out;
}

}  // namespace
}  // namespace dripline
