#include "clients/lib/server_location.hpp"

#include <gtest/gtest.h>
#include <fstream>
#include <map>

#include "tests/support/temporary_folder.hpp"

namespace dripline::client {
namespace {

class ServerLocation : public testing::Test {
 protected:
  ServerLocation() {
    variables["HOME"] = (folder.path() / "home").string();
    write("local/token", "local-token\n");
    write("other-token", "  other-token \n");
  }
  std::string write(const std::string& name, const std::string& text) {
    const auto path = folder.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path.string();
  }
  std::string state() const { return (folder.path() / "local").string(); }
  void run_local_server(const std::string& json = R"({"url":"http://127.0.0.1:8700/"})") {
    write("local/dncd.json", json);
  }
  Result<ServerAddress> locate() {
    auto servers = locate_all();
    if (!servers) return fail(servers.error());
    EXPECT_EQ(servers->size(), 1u);
    return servers->front();
  }
  Result<std::vector<ServerAddress>> locate_all() {
    return locate_servers(
        options,
        [this](std::string_view name) {
          const auto found = variables.find(name);
          return found == variables.end() ? std::optional<std::string>() : found->second;
        },
        is_root);
  }
  test_support::TemporaryFolder folder;
  LocationOptions options;
  std::map<std::string, std::string, std::less<>> variables;
  bool is_root = false;
};

TEST_F(ServerLocation, OptionComesBeforeEnvironmentBeforeLocalServer) {
  run_local_server();
  variables["DRIPLINE_STATE"] = state();
  EXPECT_EQ(locate()->url, "http://127.0.0.1:8700");
  variables["DRIPLINE_SERVER"] = "http://environment:1";
  EXPECT_EQ(locate()->url, "http://environment:1");
  options.server = "https://option:2/";
  EXPECT_EQ(locate()->url, "https://option:2");
}

TEST_F(ServerLocation, TokenFileComesBeforeEnvironmentBeforeLocalToken) {
  run_local_server(R"({"url":"http://127.0.0.1:8700","token_file":"token"})");
  options.state_dir = state();
  EXPECT_EQ(locate()->token, "local-token");
  variables["DRIPLINE_TOKEN"] = "environment-token";
  EXPECT_EQ(locate()->token, "environment-token");
  options.token_file = (folder.path() / "other-token").string();
  EXPECT_EQ(locate()->token, "other-token");
}

TEST_F(ServerLocation, FindsTheTokenBesideTheFileWhenNoneIsNamed) {
  run_local_server();
  options.state_dir = state();
  EXPECT_EQ(locate()->token, "local-token");
}

TEST_F(ServerLocation, NeverSendsTheLocalTokenToAnotherServer) {
  variables["XDG_STATE_HOME"] = folder.path().string();
  std::filesystem::rename(folder.path() / "local", folder.path() / "dripline");
  write("dripline/dncd.json", R"({"url":"http://127.0.0.1:8700","token_file":"token"})");
  options.server = "http://elsewhere:1";
  EXPECT_EQ(locate()->token, "");
  options.server = "http://127.0.0.1:8700";
  EXPECT_EQ(locate()->token, "local-token");
}

TEST_F(ServerLocation, TakesTheServersOfOneLibrary) {
  variables["DRIPLINE_SERVER"] = "http://srv-1:1/,https://srv-2:2";
  variables["DRIPLINE_TOKEN"] = "t";
  const auto servers = locate_all();
  ASSERT_TRUE(servers) << servers.error().what;
  ASSERT_EQ(servers->size(), 2u);
  EXPECT_EQ(servers->at(0).url, "http://srv-1:1");
  EXPECT_EQ(servers->at(1).url, "https://srv-2:2");
  EXPECT_EQ(servers->at(1).token, "t");
  for (const char* const wrong : {"http://a:1,", ",http://a:1", "http://a:1,,http://b:1", "", ","})
    EXPECT_EQ((options.server = wrong, locate_all()).error().code, Errc::Syntax) << wrong;
  options.server = "http://a:1";
  for (std::size_t i = 0; i < kMaxServers; ++i) *options.server += ",http://a:1";
  EXPECT_EQ(locate_all().error().code, Errc::LimitExceeded);
}

TEST_F(ServerLocation, SendsTheLocalTokenToTheLocalOneOfSeveralOnly) {
  variables["XDG_STATE_HOME"] = folder.path().string();
  std::filesystem::rename(folder.path() / "local", folder.path() / "dripline");
  write("dripline/dncd.json", R"({"url":"http://127.0.0.1:8700","token_file":"token"})");
  options.server = "http://elsewhere:1,http://127.0.0.1:8700";
  const auto servers = locate_all();
  ASSERT_TRUE(servers) << servers.error().what;
  EXPECT_EQ(servers->at(0).token, "");
  EXPECT_EQ(servers->at(1).token, "local-token");
}

TEST_F(ServerLocation, LooksForStateWhereTheUserAndTheSystemKeepIt) {
  const auto where = [this] { return locate().error().what; };
  EXPECT_NE(where().find("home/.local/state/dripline/dncd.json"), std::string::npos) << where();
  variables["XDG_STATE_HOME"] = "/xdg";
  EXPECT_NE(where().find("/xdg/dripline/dncd.json"), std::string::npos) << where();
  is_root = true;
  EXPECT_NE(where().find("/var/lib/dripline/dncd.json"), std::string::npos) << where();
  variables["DRIPLINE_STATE"] = "/named";
  EXPECT_NE(where().find("/named/dncd.json"), std::string::npos) << where();
  EXPECT_EQ(locate().error().code, Errc::NotFound);
}

TEST_F(ServerLocation, RefusesWhatIsNoAddress) {
  for (const char* bad : {"lathe", "ftp://host", "http://", "https://host/path", "http://h?x"}) {
    options.server = bad;
    const auto address = locate();
    ASSERT_FALSE(address) << bad;
    EXPECT_EQ(address.error().code, Errc::Syntax);
    EXPECT_NE(address.error().what.find("http://HOST:PORT"), std::string::npos);
  }
}

TEST_F(ServerLocation, NamesAFileThatIsNotTheServers) {
  run_local_server("{}");
  options.state_dir = state();
  const auto address = locate();
  ASSERT_FALSE(address);
  EXPECT_NE(address.error().what.find("dncd.json"), std::string::npos);
}

TEST_F(ServerLocation, NamesATokenFileThatIsMissingOrEmpty) {
  options.server = "http://h:1";
  options.token_file = "/no/such/token";
  EXPECT_NE(locate().error().what.find("/no/such/token"), std::string::npos);
  options.token_file = write("empty", "\n");
  EXPECT_EQ(locate().error().code, Errc::Syntax);
}

}  // namespace
}  // namespace dripline::client
