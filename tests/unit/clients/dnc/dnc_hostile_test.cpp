// What a hostile or broken server, machine or program puts into its texts never steers a terminal.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/hostile_server.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::hostile_text;
using test_support::HostileServer;
using test_support::steering_text;
using Words = std::vector<std::string>;

void connect(test_support::Dnc& dnc, const std::string& server) {
  dnc.environment["DRIPLINE_SERVER"] = server;
  dnc.environment["DRIPLINE_TOKEN"] = test_support::FakeServer::kToken;
}

class HostileTest {
 public:
  explicit HostileTest(HostileServer::Answers answers) : server(OPENAPI, answers) {
    connect(dnc, server.url());
    dnc.write("rules.toml", "");
  }
  HostileServer server;
  test_support::Dnc dnc{DNC_PATH};
};

std::string name_of(const testing::TestParamInfo<Words>& call) {
  std::string name;
  for (const std::string& word : call.param) {
    for (const char c : word) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    name += "_";
  }
  return name;
}

/// Calls that print texts of the server.
const Words kCalls[]{
    {"program", "list"},
    {"program", "show", "O1"},
    {"program", "search", "x"},
    {"program", "attachments", "O1"},
    {"program", "closure", "O1"},
    {"program", "states", "O1", "2"},
    {"program", "check", "O1"},
    {"program", "diff", "O1@3", "O1@4"},
    {"program", "diff", "O1@3", "O1@4", "--motion"},
    {"program", "copy", "O1", "O2"},
    {"program", "rename", "O1", "O2"},
    {"program", "accept", "O1", "2"},
    {"import", "list"},
    {"import", "list", "--decided"},
    {"import", "show", "O1", "2"},
    {"import", "accept", "O1", "2"},
    {"machine", "list"},
    {"machine", "status", "m"},
    {"machine", "parameters", "m"},
    {"machine", "pins", "m"},
    {"machine", "playback", "m", "XZ"},
    {"run", "list"},
    {"run", "show", "latest"},
    {"run", "start", "m", "O1"},
    {"report", "list"},
    {"report", "measurements"},
    {"report", "parts"},
    {"report", "findings"},
    {"report", "template", "list"},
    {"port", "list"},
    {"port", "show", "p"},
    {"port", "templates"},
    {"port", "templates", hostile_text()},
    {"port", "test", "p"},
    {"port", "recording", "p"},
    {"setup", "list", "m"},
    {"setup", "loaded", "m"},
    {"memory", "show", "m"},
    {"user", "list"},
    {"user", "show", "u"},
    {"token", "list"},
    {"token", "add", "t", "--role", "viewer"},
    {"group", "list"},
    {"whoami"},
    {"server", "status"},
    {"server", "backups"},
    {"server", "archives"},
    {"offset", "list"},
    {"offset", "show", "1"},
    {"offset", "rules", "m"},
    {"offset", "history", "m"},
    {"offset", "in-force", "latest"},
    {"folder", "list"},
    {"folder", "files", "f"},
    {"job", "list", "m"},
    {"webhook", "list"},
};

class HostileAnswer : public HostileTest, public testing::TestWithParam<Words> {
 protected:
  HostileAnswer() : HostileTest(HostileServer::Answers::Good) {}
};

TEST_P(HostileAnswer, SteersNoTerminal) {
  const auto shown = dnc.on_terminal(GetParam());
  EXPECT_NE((shown.out + shown.err).find(test_support::kEvil), std::string::npos)
      << shown.out << shown.err;
  EXPECT_EQ(steering_text(test_support::without_styles(shown.out)), "");
  EXPECT_EQ(steering_text(shown.err), "");
  const auto piped = dnc(GetParam());
  EXPECT_EQ(steering_text(piped.out), "") << "what follows the pipe may be a terminal";
  EXPECT_EQ(steering_text(piped.err), "");
}
INSTANTIATE_TEST_SUITE_P(, HostileAnswer, testing::ValuesIn(kCalls), name_of);

class HostileError : public HostileTest, public testing::TestWithParam<Words> {
 protected:
  HostileError() : HostileTest(HostileServer::Answers::Errors) {}
};

TEST_P(HostileError, SteersNoTerminal) {
  const auto refused = dnc.on_terminal(GetParam());
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_EQ(refused.err.find("dnc: "), 0u) << refused.err;
  EXPECT_NE(refused.err.find(test_support::kEvil), std::string::npos) << refused.err;
  EXPECT_EQ(steering_text(refused.err), "");
}
INSTANTIATE_TEST_SUITE_P(, HostileError,
                         testing::Values(Words{"program", "list"}, Words{"machine", "status", "m"},
                                         Words{"report", "show", "latest"}, Words{"port", "list"},
                                         Words{"program", "push", "rules.toml"},
                                         Words{"run", "hold", "latest"}, Words{"whoami"}),
                         name_of);

/// Contents: visible on a terminal, and byte by byte what they are in a pipe.
class HostileContent : public HostileTest, public testing::TestWithParam<Words> {
 protected:
  HostileContent() : HostileTest(HostileServer::Answers::Good) {}
};

TEST_P(HostileContent, IsVisibleOnATerminalAndUnchangedInAPipe) {
  const auto shown = dnc.on_terminal(GetParam());
  EXPECT_NE(shown.out.find(R"(evil\x1b[33m\x1b\x07\x08\x0d\u007f\u009b\u0085\u202e)"),
            std::string::npos)
      << shown.out;
  EXPECT_EQ(steering_text(shown.out), "");
  EXPECT_NE(dnc(GetParam()).out.find(hostile_text()), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(, HostileContent,
                         testing::Values(Words{"report", "show", "latest"},
                                         Words{"report", "export", "latest", "--format", "csv"},
                                         Words{"report", "template", "show", "t"},
                                         Words{"run", "attestation", "latest"},
                                         Words{"setup", "pull", "m", "-o", "-"}),
                         name_of);

class HostileJson : public HostileTest, public testing::TestWithParam<Words> {
 protected:
  HostileJson() : HostileTest(HostileServer::Answers::Good) {}
};

TEST_P(HostileJson, IsTheSameJsonOnATerminal) {
  Words words = GetParam();
  words.push_back("--json");
  const std::string piped = dnc(words).out, shown = dnc.on_terminal(words).out;
  EXPECT_NE(piped.find("\u009b"), std::string::npos) << "a pipe gets it as it is";
  EXPECT_EQ(steering_text(shown), "");
  EXPECT_EQ(json::parse(shown), json::parse(piped));
}
INSTANTIATE_TEST_SUITE_P(, HostileJson,
                         testing::Values(Words{"machine", "list"},
                                         Words{"report", "show", "latest"},
                                         Words{"program", "diff", "O1@3"}, Words{"offset", "list"}),
                         name_of);

TEST(HostileProgram, IsPulledAsItIsAndVisibleOnATerminal) {
  test_support::FakeServer server;
  server.add_program("O1", hostile_text());
  test_support::Dnc dnc{DNC_PATH};
  connect(dnc, server.url());
  EXPECT_EQ(dnc({"program", "pull", "O1", "-o", "-"}).out, hostile_text());
  const auto shown = dnc.on_terminal({"program", "pull", "O1", "-o", "-"});
  EXPECT_EQ(shown.out.find(R"(evil\x1b[33m\x1b\x07)"), 0u) << shown.out;
  EXPECT_EQ(steering_text(shown.out), "");
}

TEST(HostileReport, IsRawOnATerminalWhenAskedFor) {
  const HostileTest test(HostileServer::Answers::Good);
  const auto raw = test.dnc.on_terminal({"report", "show", "latest", "--raw"});
  EXPECT_TRUE(raw.out.ends_with(hostile_text() + "\n")) << raw.out;
}

TEST(HostileNames, AreNoCandidatesOfACompletion) {
  const HostileTest test(HostileServer::Answers::Good);
  EXPECT_EQ(steering_text(test.dnc({"completion", "words", "program", "show", ""}).out), "");
}

/// Files of others, without a server.
class HostileFile : public testing::TestWithParam<Words> {};

TEST_P(HostileFile, SteersNoTerminal) {
  test_support::Dnc dnc{DNC_PATH};
  dnc.write("a.nc", "G21 G90\n(" + hostile_text() + ")\nQ1 " + hostile_text() + "\nM2\n");
  dnc.write("b.nc", "G21 G90\nM2\n");
  for (const auto& shown : {dnc.on_terminal(GetParam()), dnc(GetParam())}) {
    EXPECT_NE((shown.out + shown.err).find(test_support::kEvil), std::string::npos)
        << shown.out << shown.err;
    EXPECT_EQ(steering_text(test_support::without_styles(shown.out)), "");
    EXPECT_EQ(steering_text(shown.err), "");
  }
}
INSTANTIATE_TEST_SUITE_P(, HostileFile,
                         testing::Values(Words{"diff", "a.nc", "b.nc"},
                                         Words{"check", hostile_text()}, Words{hostile_text()}),
                         name_of);

}  // namespace
}  // namespace dripline
