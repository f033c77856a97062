#include "server/mtconnect/agent.hpp"

#include <chrono>
#include <map>
#include <thread>

#include "tests/unit/server/mtconnect/agent_fixture.hpp"

namespace dripline::mtconnect_test {
namespace {

using namespace std::chrono_literals;

TEST_F(AgentTest, AnswersWithTheDocumentsOfTheStandard) {
  add("lathe-1");
  for (const auto& [target, root] :
       std::map<std::string, std::string>{{"/", "<MTConnectDevices "},
                                          {"/probe", "<MTConnectDevices "},
                                          {"/lathe-1", "<MTConnectDevices "},
                                          {"/lathe-1/probe", "<MTConnectDevices "},
                                          {"/current", "<MTConnectStreams "},
                                          {"/lathe-1/current", "<MTConnectStreams "},
                                          {"/sample", "<MTConnectStreams "},
                                          {"/lathe-1/sample?count=5", "<MTConnectStreams "},
                                          {"/assets", "<MTConnectAssets "},
                                          {"/lathe-1/assets", "<MTConnectAssets "},
                                          {"/probe?pretty=true", "<MTConnectDevices "}}) {
    const auto response = ask(target);
    EXPECT_EQ(response.status, 200) << target;
    EXPECT_EQ(response.content_type, "text/xml");
    EXPECT_NE(response.body.find(root), std::string::npos) << target;
    EXPECT_EQ(attribute(response.body, "instanceId"), "77");
    EXPECT_EQ(count(response.body, " version=\"2.4\""), 1U);
  }
}

TEST_F(AgentTest, ADeviceHasAUuidAsItsOtherName) {
  add("lathe-1");
  const auto uuid = attribute(get("/lathe-1/probe"), "uuid");
  EXPECT_EQ(attribute(get("/" + uuid + "/probe"), "uuid"), uuid);
  EXPECT_EQ(count(get("/" + uuid + "/current"), "<DeviceStream "), 1U);
}

struct Refused {
  const char* target;
  int status;
  const char* code;
};
TEST_F(AgentTest, RefusesInTheWordsOfTheStandard) {
  add("lathe-1");
  for (const Refused& row : std::initializer_list<Refused>{
           {"/unknown", 404, "NO_DEVICE"},
           {"/unknown/current", 404, "NO_DEVICE"},
           {"/unknown/sample?interval=100", 404, "NO_DEVICE"},
           {"/probe/current", 404, "INVALID_URI"},
           {"/lathe-1/nothing", 404, "INVALID_URI"},
           {"/a/b/c/d", 404, "INVALID_URI"},
           {"/current?at=0", 404, "OUT_OF_RANGE"},
           {"/current?at=100000", 404, "OUT_OF_RANGE"},
           {"/current?at=-1", 404, "OUT_OF_RANGE"},
           {"/current?at=x", 400, "INVALID_REQUEST"},
           {"/current?at=1&interval=100", 400, "INVALID_REQUEST"},
           {"/sample?from=100000", 404, "OUT_OF_RANGE"},
           {"/sample?from=0", 404, "OUT_OF_RANGE"},
           {"/sample?from=100000&interval=100", 404, "OUT_OF_RANGE"},
           {"/sample?count=0", 404, "OUT_OF_RANGE"},
           {"/sample?count=131073", 404, "OUT_OF_RANGE"},
           {"/sample?count=-131073", 404, "OUT_OF_RANGE"},
           {"/sample?count=1.5", 400, "INVALID_REQUEST"},
           {"/sample?count=99999999999999999999", 400, "INVALID_REQUEST"},
           {"/sample?count=-5&interval=100", 404, "OUT_OF_RANGE"},
           {"/sample?interval=-1", 404, "OUT_OF_RANGE"},
           {"/sample?interval=100&heartbeat=0", 404, "OUT_OF_RANGE"},
           {"/current?path=//Axes[", 400, "INVALID_PATH"},
           {"/current?path=//Nothing", 400, "INVALID_PATH"},
           {"/current?path=1%2B1", 400, "INVALID_PATH"},
           {"/lathe-1/current?path=//Rotary[@name='C']", 400, "INVALID_PATH"},
           {"/asset/lathe-1.T1", 404, "ASSET_NOT_FOUND"},
           {"/asset/;", 400, "INVALID_REQUEST"},
           {"/assets?removed=maybe", 400, "INVALID_REQUEST"},
           {"/assets?count=0", 404, "OUT_OF_RANGE"}}) {
    const auto response = ask(row.target);
    EXPECT_EQ(response.status, row.status) << row.target;
    EXPECT_EQ(attribute(response.body, "errorCode"), row.code) << row.target << response.body;
    EXPECT_FALSE(response.timed) << row.target;
  }
}

TEST_F(AgentTest, OnlyReads) {
  for (const char* method : {"PUT", "POST", "DELETE", "PATCH", "OPTIONS"}) {
    const auto response = ask("/probe", method);
    EXPECT_EQ(response.status, 405) << method;
    EXPECT_EQ(attribute(response.body, "errorCode"), "UNSUPPORTED");
  }
  EXPECT_EQ(ask("/probe", "HEAD").status, 200);
}

TEST_F(AgentTest, CurrentIsNewAfterEveryObservation) {
  auto lathe = view("lathe-1");
  for (int i = 1; i <= 3; ++i) {
    lathe.status.edit().position[0] = i;
    observe(lathe);
    const auto xml = get("/current");
    EXPECT_EQ(value(xml, "position-x.lathe-1"), std::to_string(i));
    EXPECT_EQ(get("/current"), xml);
  }
}

TEST_F(AgentTest, CurrentAtANumberIsTheStateThen) {
  auto lathe = view("lathe-1");
  observe(lathe);
  const auto next = std::stoull(attribute(get("/current"), "nextSequence"));
  for (int i = 1; i <= 3; ++i) {
    lathe.status.edit().position[0] = i;
    observe(lathe);
  }
  EXPECT_EQ(value(get("/current?at=" + std::to_string(next + 1)), "position-x.lathe-1"), "2");
  EXPECT_EQ(value(get("/current?at=1"), "position-x.lathe-1"), "-") << "not there yet";
}

TEST_F(AgentTest, APathSelectsComponentsAndDataItems) {
  add("lathe-1");
  add("mill-1", kXYZC);
  EXPECT_EQ(count(get("/current?path=//Linear"), "<Position "), 10U);
  EXPECT_EQ(count(get("/mill-1/current?path=//Linear"), "<Position "), 6U);
  EXPECT_EQ(count(get("/current?path=//DataItem[@type='EXECUTION']"), "sequence="), 2U);
  EXPECT_EQ(count(get("/current?path=//Device[@name='mill-1']//Axes//DataItem[@category='SAMPLE']"),
                  "sequence="),
            8U);
  EXPECT_EQ(
      count(get("/current?path=//Linear|//DataItem[@type=%22MODE%22]|//Linear"), "<Position "),
      10U);
  EXPECT_EQ(count(get("/current?path=/"), "<DeviceStream "), 3U);
  EXPECT_EQ(count(get("/sample?path=//Path&count=1"), "sequence="), 1U);
}

TEST_F(AgentTest, APathSelectsWhatCameLater) {
  add("lathe-1");
  const std::string target = "/current?path=//Linear";
  EXPECT_EQ(count(get(target), "<Position "), 4U);
  add("mill-1", kXYZC);
  EXPECT_EQ(count(get(target), "<Position "), 10U);
}

TEST_F(AgentTest, AHostilePathCostsLittle) {
  for (int i = 0; i < 50; ++i) add("mill-" + std::to_string(i), 0x1FF);
  std::string nested = "//*";
  while (nested.size() < 900) nested += "[count(//*[//*])>0]";
  std::string deep(500, '(');
  deep += "//*" + std::string(500, ')');
  std::string strings = "//*[contains(string(/),'x')";
  while (strings.size() < 900) strings += " or contains(string(/),'x')";
  strings += "]";
  std::string unions = "//*";
  while (unions.size() < 900) unions += "|//*//*";
  for (const auto& path : {nested, deep, strings, unions, std::string(1025, '/')}) {
    const auto begin = std::chrono::steady_clock::now();
    api::Request request;
    request.method = "GET";
    request.target.segments = {"current"};
    request.target.query["path"] = path;
    static_cast<void>(agent_->handle(request));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s) << path.substr(0, 40);
  }
}

TEST_F(AgentTest, NamesFromMachinesCannotBreakADocument) {
  auto lathe = view("lathe-1");
  lathe.machine.description = "</Description><Evil a=\"";
  lathe.status.edit().message = "]]> & <!-- \x02";
  observe(lathe);
  EXPECT_EQ(get("/probe").find("<Evil"), std::string::npos);
  EXPECT_EQ(value(get("/current"), "message.lathe-1"), "]]&gt; &amp; &lt;!-- \uFFFD");
}

TEST_F(AgentTest, IsReadWhileMachinesComeAndMove) {
  std::vector<std::jthread> threads;
  threads.emplace_back([this] {
    for (int i = 0; i < 2000; ++i) {
      auto mill = view("mill-" + std::to_string(i % 40), i % 3 == 0 ? 0 : kXYZC);
      mill.status.edit().position[0] = i;
      mill.is_connected = i % 11 != 0;
      observe(mill);
    }
  });
  threads.emplace_back([this] {
    for (int i = 0; i < 1000; ++i) report("output", "line " + std::to_string(i));
  });
  for (const char* target : {"/current", "/sample?count=500", "/current?path=//Axes", "/probe",
                             "/sample?path=//Path&count=-100", "/assets"}) {
    threads.emplace_back([this, target] {
      for (int i = 0; i < 50; ++i) {
        const auto response = ask(target);
        const bool is_new = response.status == 400 || response.status == 503;  // no axes yet
        EXPECT_TRUE(response.status == 200 || is_new) << target << response.body;
      }
    });
  }
  threads.clear();
  EXPECT_EQ(count(get("/current"), "<DeviceStream "), 42U) << "the agent, 40 mills, the lathe";
}

TEST_F(AgentTest, LargeDocumentsShareABoundedMemory) {
  mtconnect::Agent::Options options;
  options.body_memory = 600 * 1024;
  restart(options);
  for (int i = 0; i < 60; ++i) add("mill-" + std::to_string(i), 0x1FF);
  const auto first = ask("/current");
  ASSERT_TRUE(first.source);
  {
    const auto second = ask("/current");
    EXPECT_EQ(second.status, 503);
  }
  EXPECT_EQ(text_of(first).size(), *first.source_length);
}

// -- streams --

class StreamTest : public AgentTest {
 protected:
  void open(const std::string& target) {
    response_ = ask(target);
    ASSERT_TRUE(response_.timed) << response_.body;
  }
  /// The document of the part that is due now; "": none; "end": the stream has ended.
  std::string part() {
    if (!response_.timed->due().is_now) return "";
    const auto text = response_.timed->take();
    if (!text) return "end";
    const auto begin = text->find("\r\n\r\n");
    return begin == std::string::npos ? "" : text->substr(begin + 4);
  }
  void move(double x) {
    auto lathe = view("lathe-1");
    lathe.status.edit().position[0] = x;
    observe(lathe);
  }
  api::Response response_;
};

TEST_F(StreamTest, SendsWhatWasObservedSinceThePartBefore) {
  move(1);
  const auto next = attribute(get("/current"), "nextSequence");
  open("/sample?interval=100&from=" + next);
  EXPECT_TRUE(response_.content_type.starts_with("multipart/x-mixed-replace;boundary="));
  EXPECT_EQ(part(), "");
  move(2);
  clock_.advance(100ms);
  EXPECT_EQ(value(part(), "position-x.lathe-1"), "2");
  move(3);
  clock_.advance(50ms);
  EXPECT_EQ(part(), "") << "before the interval has passed";
  move(4);
  clock_.advance(50ms);
  const auto xml = part();
  EXPECT_EQ(count(xml, "<Position "), 2U);
  EXPECT_EQ(part(), "");
}

TEST_F(StreamTest, WhatDoesNotFitIntoAPartFollowsAtOnce) {
  move(0);
  const auto next = attribute(get("/current"), "nextSequence");
  for (int i = 1; i <= 7; ++i) move(i);
  open("/sample?interval=1000&count=3&from=" + next);
  EXPECT_EQ(count(part(), "sequence="), 3U);
  EXPECT_EQ(count(part(), "sequence="), 3U);
  EXPECT_EQ(count(part(), "sequence="), 1U);
  move(8);
  EXPECT_EQ(part(), "") << "now it waits for its interval";
}

TEST_F(StreamTest, APartHasTheLengthOfItsDocument) {
  move(1);
  open("/sample?interval=0");
  ASSERT_TRUE(response_.timed->due().is_now);
  const auto text = response_.timed->take().value();
  const auto boundary = response_.content_type.substr(response_.content_type.find('=') + 1);
  const auto begin = text.find("\r\n\r\n") + 4;
  EXPECT_TRUE(text.starts_with("\r\n--" + boundary +
                               "\r\nContent-type: text/xml\r\nContent-length: " +
                               std::to_string(text.size() - begin) + "\r\n\r\n<?xml"))
      << text.substr(0, 200);
}

TEST_F(StreamTest, AQuietStreamHasAHeartbeat) {
  move(1);
  const auto next = attribute(get("/current"), "nextSequence");
  open("/sample?interval=100&heartbeat=1000&path=//Axes&from=" + next);
  for (int i = 0; i < 9; ++i) {
    clock_.advance(100ms);
    EXPECT_EQ(part(), "");
  }
  report("output", "nothing of the axes");
  clock_.advance(100ms);
  const auto beat = part();
  EXPECT_NE(beat.find("<Streams></Streams>"), std::string::npos) << beat;
  EXPECT_EQ(std::stoull(attribute(beat, "nextSequence")), std::stoull(next) + 1);
}

TEST_F(StreamTest, AReaderThatFallsOutOfTheBufferIsTold) {
  mtconnect::Agent::Options options;
  options.buffer_size = 64;
  restart(options);
  move(0);
  open("/sample?interval=10");
  part();
  for (int i = 1; i < 200; ++i) move(i);
  clock_.advance(10ms);
  EXPECT_EQ(attribute(part(), "errorCode"), "OUT_OF_RANGE");
  clock_.advance(10ms);
  EXPECT_EQ(part(), "end");
}

TEST_F(StreamTest, CurrentComesAtEveryInterval) {
  move(1);
  open("/current?interval=1000&path=//Linear");
  EXPECT_EQ(value(part(), "position-x.lathe-1"), "1");
  clock_.advance(999ms);
  EXPECT_EQ(part(), "");
  clock_.advance(1ms);
  EXPECT_EQ(value(part(), "position-x.lathe-1"), "1") << "also unchanged";
}

// -- assets --

class AssetTest : public AgentTest {
 protected:
  void use(std::uint64_t number, const std::string& text, bool is_first = false) {
    storage::SetupRevision setup;
    setup.machine = "mill-1";
    setup.number = number;
    setup.text = text;
    setup.created = clock_.now();
    agent_->use_setup(setup, "fanuc", is_first);
  }
  static std::string tool(int number, double length) {
    return fmt::format("[[tool]]\nnumber = {}\nlength = {:.3f}\nradius = 5.0\n", number, length);
  }
  std::string changed() { return value(get("/current"), "asset-changed.mill-1"); }
  std::string removed() { return value(get("/current"), "asset-removed.mill-1"); }
};

TEST_F(AssetTest, AToolOfTheSetupIsAnAsset) {
  add("mill-1", kXYZC);
  use(1, "units = \"mm\"\n" + tool(3, 80.5) + "pocket = 7\n", true);
  const auto xml = get("/asset/mill-1.T3");
  EXPECT_EQ(attribute(xml, "assetId"), "mill-1.T3");
  EXPECT_EQ(attribute(xml, "deviceUuid"), attribute(get("/mill-1/probe"), "uuid"));
  EXPECT_NE(xml.find("<ProgramToolNumber>3</ProgramToolNumber>"), std::string::npos);
  EXPECT_NE(xml.find("<Location type=\"POT\">7</Location>"), std::string::npos) << xml;
  EXPECT_NE(xml.find("<FunctionalLength code=\"LF\" units=\"MILLIMETER\">80.5<"),
            std::string::npos);
  EXPECT_NE(xml.find("<CuttingDiameterMax code=\"DC\" units=\"MILLIMETER\">10<"),
            std::string::npos);
  EXPECT_EQ(changed(), "UNAVAILABLE") << "no client has seen another one";
}

TEST_F(AssetTest, ANewSetupReportsWhatItChanges) {
  add("mill-1", kXYZC);
  use(1, tool(1, 10) + tool(2, 20), true);
  use(2, tool(1, 11) + tool(2, 20));
  EXPECT_EQ(changed(), "mill-1.T1");
  use(3, tool(2, 20));
  EXPECT_EQ(removed(), "mill-1.T1");
  EXPECT_EQ(count(get("/assets"), "<CuttingTool "), 1U);
  EXPECT_EQ(attribute(get("/assets"), "assetCount"), "1");
  const auto all = get("/assets?removed=true");
  EXPECT_EQ(count(all, "<CuttingTool "), 2U);
  EXPECT_EQ(count(all, "removed=\"true\""), 1U);
  EXPECT_LT(all.find("mill-1.T1"), all.find("mill-1.T2")) << "the last change first";
  use(4, tool(1, 11) + tool(2, 20));
  EXPECT_EQ(changed(), "mill-1.T1");
  EXPECT_EQ(count(get("/assets"), "<CuttingTool "), 2U);
}

TEST_F(AssetTest, AnOlderSetupThatComesLateIsIgnored) {
  use(2, tool(1, 11));
  use(1, tool(1, 10));
  EXPECT_NE(get("/asset/mill-1.T1").find(">11<"), std::string::npos);
}

TEST_F(AssetTest, AssetsAreSelectedByDeviceTypeAndCount) {
  add("lathe-1");
  add("mill-1", kXYZC);
  use(1, tool(1, 10) + tool(2, 20) + tool(3, 30));
  EXPECT_EQ(count(get("/assets?count=2"), "<CuttingTool "), 2U);
  EXPECT_EQ(count(get("/mill-1/assets"), "<CuttingTool "), 3U);
  EXPECT_EQ(count(get("/lathe-1/assets"), "<CuttingTool "), 0U);
  EXPECT_EQ(count(get("/assets?type=CuttingTool"), "<CuttingTool "), 3U);
  EXPECT_EQ(count(get("/assets?type=Fixture"), "<CuttingTool "), 0U);
  EXPECT_EQ(count(get("/asset/mill-1.T1;mill-1.T3"), "<CuttingTool "), 2U);
}

}  // namespace
}  // namespace dripline::mtconnect_test
