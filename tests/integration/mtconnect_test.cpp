// A server's MTConnect agent, with a real gateway.
#include <gtest/gtest.h>
#include <fstream>
#include <vector>

#include "tests/integration/system.hpp"
#include "tests/unit/server/api/raw_peer.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::RestClient;

class MtConnect : public testing::Test {
 protected:
  void start(const std::vector<std::string>& gateway = {}) {
    system_.emplace(System::Options{.speed = "max",
                                    .server_arguments = {"--mtconnect", "127.0.0.1:0"},
                                    .gateway_arguments = gateway});
    start_server();
    system_->start_gateway();
    system_->wait_connected();
    ASSERT_TRUE(eventually([&] { return value("execution") == "READY"; }));
  }
  void start_server() {
    system_->start_server();
    const std::string words = "MTConnect agent at ";
    ASSERT_TRUE(eventually([&] {
      const auto output = system_->server().output();
      const auto at = output.rfind(words + "http");
      const auto end = output.find('\n', at);
      if (at == std::string::npos || end == std::string::npos) return false;
      url_ = output.substr(at + words.size(), end - at - words.size());
      return true;
    })) << system_->server().output();
  }
  std::string get(const std::string& target) const { return RestClient(url_, "").get(target).body; }
  /// Of the lathe's data item, now; "-": there is none.
  std::string value(const std::string& item) const { return value_in(get("/current"), item); }
  static std::string value_in(const std::string& xml, const std::string& item) {
    const auto at = xml.find("dataItemId=\"" + item + ".lathe-1\"");
    if (at == std::string::npos) return "-";
    const auto begin = xml.find('>', at);
    return xml[begin - 1] == '/' ? "" : xml.substr(begin + 1, xml.find('<', begin) - begin - 1);
  }
  /// All values of a data item in the buffer.
  std::vector<std::string> values(const std::string& item) const {
    std::vector<std::string> values;
    std::string xml = get("/sample?count=100000&path=//DataItem[@name='" + item + "']");
    const std::string id = "dataItemId=\"" + item + ".lathe-1\"";
    for (auto at = xml.find(id); at != std::string::npos; at = xml.find(id)) {
      xml.erase(0, at);
      values.push_back(value_in(xml, item));
      xml.erase(0, id.size());
    }
    return values;
  }
  std::uint16_t port() const {
    return static_cast<std::uint16_t>(std::stoi(url_.substr(url_.rfind(':') + 1)));
  }

  std::optional<System> system_;
  std::string url_;
};

using Values = std::vector<std::string>;

TEST_F(MtConnect, ReportLinesAndTheRunAreObserved) {
  start();
  system_->push("O0100",
                "O0100\nG20 G93\nPOPEN P0\nN10 G0 X1 Z1\nDPRNT [FIRST]\nDPRNT [FIRST]\n"
                "G0 X2\nDPRNT [LAST]\nPCLOS\nM30\n");
  const auto run = system_->wait_ended(system_->start_run("O0100"));
  ASSERT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(eventually([&] {
    return values("output") == Values{"UNAVAILABLE", "FIRST", "FIRST", "LAST"};
  })) << get("/sample?count=100000");
  EXPECT_TRUE(eventually([&] { return value("position-x") == "25.4"; })) << "mm of radius";
  const auto probe = get("/probe");
  EXPECT_NE(probe.find("<Linear id=\"x.lathe-1\""), std::string::npos) << probe;
}

TEST_F(MtConnect, AnAlarmIsAFaultUntilTheNextRunEvenOverARestart) {
  start();
  system_->push("O0400", "O0400\nG20 G93\nG0 X1 Z1\nP1=1/0\nM30\n");
  const auto run = system_->wait_ended(system_->start_run("O0400"));
  ASSERT_EQ(run.value("state", ""), "alarmed") << run.dump();
  const auto fault = [&] {
    const auto xml = get("/current?path=//DataItem[@type='MOTION_PROGRAM']");
    return xml.find("<Fault ") != std::string::npos &&
           xml.find("nativeCode=\"CEN") != std::string::npos;
  };
  EXPECT_TRUE(eventually(fault)) << get("/current");
  const auto before = get("/probe");
  system_->server().kill();
  start_server();
  EXPECT_TRUE(eventually(fault)) << get("/current");
  const auto instance = [](const std::string& xml) {
    return xml.substr(xml.find("instanceId="), 32);
  };
  EXPECT_NE(instance(get("/probe")), instance(before));
  system_->wait_connected();
  system_->push("O0401", "O0401\nG20 G93\nG0 X1 Z1\nM30\n");
  system_->wait_ended(system_->start_run("O0401"));
  EXPECT_TRUE(eventually([&] { return !fault(); }));
}

TEST_F(MtConnect, ProbeContactsArePositions) {
  const test_support::TemporaryFolder folder;
  const std::string setup = folder.path() / "setup.toml";
  std::ofstream(setup) << "units = \"mm\"\nstart = { X = 10.0, Z = 20.0 }\n[probe]\nsurface = [ { "
                          "profile = [ [0.0, 5.0], [50.0, 5.0] ] } ]\n";
  start({"--setup", setup});
  system_->push("O0500", "O0500\nG21 G93 G98\nG1 F500\nPROBE1 Z-3 F500\nM30\n");
  const auto run = system_->wait_ended(system_->start_run("O0500"));
  ASSERT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(eventually([&] { return value("contact-z") == "5"; }))
      << system_->rest().get("/api/v1/runs/" + run.value("id", "") + "/records?kind=probe").body;
}

TEST_F(MtConnect, AKilledGatewayIsUnavailableInEverything) {
  start();
  server_test::RawPeer stream(port());
  stream.send("GET /lathe-1/sample?interval=50 HTTP/1.1\r\nHost: shop\r\n\r\n");
  stream.read_until("</MTConnectStreams>");
  system_->gateway().kill();
  EXPECT_NE(stream.read_until("name=\"availability\"").find("name=\"availability\""),
            std::string::npos);
  EXPECT_TRUE(eventually([&] { return value("availability") == "UNAVAILABLE"; }));
  EXPECT_EQ(value("execution"), "UNAVAILABLE");
  EXPECT_EQ(value("position-x"), "UNAVAILABLE");
  EXPECT_NE(get("/current").find("<Unavailable "), std::string::npos);
  system_->start_gateway();
  EXPECT_TRUE(eventually([&] { return value("execution") == "READY"; }));
}

TEST_F(MtConnect, AQuietStreamHasHeartbeats) {
  start();
  const auto xml = get("/current");
  const auto at = xml.find("nextSequence=\"") + 14;
  const auto next = xml.substr(at, xml.find('"', at) - at);
  server_test::RawPeer stream(port());
  stream.send("GET /sample?interval=10&heartbeat=100&path=//DataItem[@type='PROGRAM']&from=" +
              next + " HTTP/1.1\r\nHost: shop\r\n\r\n");
  for (int i = 0; i < 5; ++i) {
    EXPECT_NE(stream.read_until("<Streams></Streams>").find("<Streams></Streams>"),
              std::string::npos);
  }
}

TEST_F(MtConnect, ASetupThatIsPushedChangesTools) {
  start();
  const auto put = [&](const std::string& text) {
    return system_->rest().put_bytes("/api/v1/machines/lathe-1/setup", text).status;
  };
  ASSERT_EQ(put("units = \"mm\"\n[[tool]]\nnumber = 3\nX = 10.0\nZ = 20.0\n"), 201);
  EXPECT_TRUE(eventually([&] { return value("asset-changed") == "lathe-1.T3"; }));
  EXPECT_NE(get("/asset/lathe-1.T3").find("<FunctionalLength "), std::string::npos);
  ASSERT_EQ(put("units = \"mm\"\n[[tool]]\nnumber = 4\nX = 10.0\nZ = 20.0\n"), 201);
  EXPECT_TRUE(eventually([&] { return value("asset-removed") == "lathe-1.T3"; }));
  system_->server().kill();
  start_server();
  EXPECT_NE(get("/assets").find("assetId=\"lathe-1.T4\""), std::string::npos)
      << "read from the store";
}

/// A machine at the end of a line, played by a listening socket.
TEST_F(MtConnect, AMachineOnASerialLineIsADeviceUntilItsPortIsRemoved) {
  start();
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 4), 0);
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  const nlohmann::json port{
      {"machine", "mill-9"},
      {"address", "tcp://127.0.0.1:" + std::to_string(ntohs(address.sin_port))},
      {"template", "tnc155"}};
  ASSERT_EQ(system_->rest().put_bytes("/api/v1/ports/line-9", port.dump()).status, 201);
  const auto availability = [&] {
    const auto xml = get("/mill-9/current?path=//DataItem[@type='AVAILABILITY']");
    const auto begin = xml.find("\">", xml.find("<Availability "));
    return begin == std::string::npos ? xml
                                      : xml.substr(begin + 2, xml.find('<', begin) - begin - 2);
  };
  EXPECT_TRUE(eventually([&] { return availability() == "AVAILABLE"; })) << availability();
  EXPECT_EQ(get("/mill-9/probe").find("<Axes"), std::string::npos) << "nothing is known of them";
  EXPECT_EQ(system_->rest().remove("/api/v1/ports/line-9").status, 204);
  EXPECT_TRUE(
      eventually([&] { return availability() == "UNAVAILABLE"; }, std::chrono::seconds(40)));
  ::close(listener);
}

TEST_F(MtConnect, IsNotOpenToANetworkUnasked) {
  System system(
      {.speed = "max", .server_arguments = {"--mtconnect", "0.0.0.0:0"}, .gateway_arguments = {}});
  system.launch_server();
  EXPECT_EQ(system.server().wait(), 2);
  EXPECT_NE(system.server().output().find("mtconnect-open-network"), std::string::npos);
}

}  // namespace
}  // namespace dripline::integration
