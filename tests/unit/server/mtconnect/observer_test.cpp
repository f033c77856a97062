#include "server/mtconnect/observer.hpp"

#include "tests/unit/server/mtconnect/agent_fixture.hpp"

namespace dripline::mtconnect_test {
namespace {

using ObserverTest = AgentTest;

TEST_F(ObserverTest, ReportsAStatusInTheUnitsOfTheStandard) {
  auto mill = view("mill-1", kXYZC);
  mill.status.edit().feed_mm_per_min = 600;
  mill.status.edit().feed_override = 0.8;
  mill.status.edit().position = {1, 2.5, -3, 0, 0, 90, 0, 0, 0};
  mill.status.edit().sequence = 120;
  mill.status.edit().line = 7;
  mill.status.edit().program = "O0100";
  observe(mill);
  const auto xml = get("/mill-1/current");
  EXPECT_EQ(value(xml, "feed.mill-1"), "10") << "mm a second";
  EXPECT_EQ(value(xml, "feed-override.mill-1"), "80");
  EXPECT_EQ(value(xml, "position-y.mill-1"), "2.5");
  EXPECT_EQ(value(xml, "angle-c.mill-1"), "90");
  EXPECT_EQ(value(xml, "angle-a.mill-1"), "-") << "it has no A axis";
  EXPECT_EQ(value(xml, "line-label.mill-1"), "N120");
  EXPECT_EQ(value(xml, "line-number.mill-1"), "7");
  EXPECT_EQ(value(xml, "program.mill-1"), "O0100");
  EXPECT_EQ(value(xml, "execution.mill-1"), "READY");
  EXPECT_EQ(value(xml, "emergency-stop.mill-1"), "ARMED");
  EXPECT_EQ(value(xml, "tool-number.mill-1"), "UNAVAILABLE") << "it is not known";
  EXPECT_EQ(value(xml, "availability.mill-1"), "AVAILABLE");
}

TEST_F(ObserverTest, OnlyChangesBecomeObservations) {
  auto lathe = view("lathe-1");
  observe(lathe);
  const auto before = attribute(get("/current"), "nextSequence");
  observe(lathe);
  lathe.status.edit().time += std::chrono::seconds(1);
  lathe.status.edit().accepted = 5;
  observe(lathe);
  EXPECT_EQ(attribute(get("/current"), "nextSequence"), before);
  lathe.status.edit().position[0] = 4;
  observe(lathe);
  const auto xml = get("/sample?from=" + before);
  EXPECT_EQ(count(xml, "sequence="), 1U);
  EXPECT_EQ(value(xml, "position-x.lathe-1"), "4");
}

TEST_F(ObserverTest, TimesAreTheGateways) {
  auto lathe = view("lathe-1");
  lathe.status.edit().time = UtcTime{std::chrono::seconds(1'600'000'000)};
  observe(lathe);
  EXPECT_NE(get("/current").find("name=\"execution\" timestamp=\"2020-09-13T12:26:40.000000Z\""),
            std::string::npos);
}

TEST_F(ObserverTest, ALostMachineIsUnavailableInEverything) {
  auto lathe = view("lathe-1");
  observe(lathe);
  alarm("CEN0103", "bad block");
  lathe.is_connected = false;
  observe(lathe);
  const auto xml = get("/current?path=//Device");
  EXPECT_EQ(count(xml, ">UNAVAILABLE<") + count(xml, "<Unavailable "), count(xml, "sequence="));
  EXPECT_EQ(count(xml, "<Unavailable "), 2U);
}

TEST_F(ObserverTest, AMachineWhoseStatusDoesNotArriveIsUnavailable) {
  auto lathe = view("lathe-1");
  lathe.status.edit().program = "O1";
  observe(lathe);
  lathe.is_stale = true;
  observe(lathe);
  EXPECT_EQ(value(get("/current"), "availability.lathe-1"), "UNAVAILABLE");
  EXPECT_EQ(value(get("/current"), "program.lathe-1"), "UNAVAILABLE");
  lathe.is_stale = false;
  lathe.status.edit().time += std::chrono::seconds(9);
  observe(lathe);
  EXPECT_EQ(value(get("/current"), "availability.lathe-1"), "AVAILABLE");
  EXPECT_EQ(value(get("/current"), "program.lathe-1"), "O1");
}

TEST_F(ObserverTest, AMachineThatIsBackShowsNothingOld) {
  auto lathe = view("lathe-1");
  lathe.status.edit().program = "O1";
  observe(lathe);
  alarm("CEN0103", "bad block");
  lathe.is_connected = false;
  observe(lathe);
  lathe.is_connected = true;
  observe(lathe);  // its announcement; the status is the one from before
  EXPECT_EQ(value(get("/current"), "availability.lathe-1"), "AVAILABLE");
  EXPECT_EQ(value(get("/current"), "program.lathe-1"), "UNAVAILABLE");
  lathe.status.edit().time += std::chrono::seconds(9);
  observe(lathe);
  EXPECT_EQ(value(get("/current"), "program.lathe-1"), "O1");
  EXPECT_EQ(value(get("/current"), "motion-program.lathe-1"), "bad block") << "it was not cleared";
}

TEST_F(ObserverTest, AFaultHasOurAlarmNumberAndEndsWhenTheNextRunBegins) {
  add("lathe-1");
  EXPECT_EQ(count(get("/current"), "<Normal "), 2U);
  alarm("CEN0103", "300: bad block");
  alarm("LCN0002", "following error");
  const auto xml = get("/current");
  EXPECT_NE(xml.find("<Fault dataItemId=\"motion-program.lathe-1\""), std::string::npos);
  EXPECT_NE(xml.find("nativeCode=\"CEN0103\" conditionId=\"CEN0103\">300: bad block</Fault>"),
            std::string::npos);
  EXPECT_NE(xml.find("<Fault dataItemId=\"system.lathe-1\""), std::string::npos);
  report("run_started", "{}");
  EXPECT_EQ(count(get("/current"), "<Normal "), 2U);
  EXPECT_EQ(count(get("/current"), "<Fault "), 0U);
}

TEST_F(ObserverTest, TheAlarmOfTheLastRunIsThereAfterARestart) {
  const std::vector<storage::Record> alarms{
      record("alarm", dds::encode(dds::AlarmText{"CEN0103", "bad block"}))};
  mtconnect::Agent::Options options;
  options.last_alarms = [&](const std::string& machine) {
    return machine == "lathe-1" ? alarms : std::vector<storage::Record>();
  };
  restart(options);
  add("lathe-1");
  add("lathe-2");
  EXPECT_EQ(value(get("/current"), "motion-program.lathe-1"), "bad block");
  EXPECT_EQ(value(get("/current"), "motion-program.lathe-2"), "");
}

TEST_F(ObserverTest, EachLineOfAReportIsAnObservation) {
  add("lathe-1");
  const auto from = attribute(get("/current"), "nextSequence");
  report("output", "D1=5");
  report("output", "D1=5");
  report("probe", dds::encode(dds::ProbeText{{}, "contact", true, {{'X', 1.5}, {'Z', -2}}}));
  report("probe", dds::encode(dds::ProbeText{{}, "contact", false, {}}));
  auto memory = record("message", "{\"cells\":[]}");
  memory.device = "memory";
  agent_->observer().observe(memory);
  const auto xml = get("/sample?from=" + from);
  EXPECT_EQ(count(xml, "D1=5"), 2U);
  EXPECT_EQ(value(xml, "contact.lathe-1"), "1.5 0 -2") << "it has no Y axis";
  EXPECT_EQ(value(xml, "contact-x.lathe-1"), "1.5");
  EXPECT_EQ(value(xml, "contact-z.lathe-1"), "-2");
  EXPECT_EQ(count(xml, "sequence="), 5U) << "no contact is no position, memory is no message";
}

TEST_F(ObserverTest, AContactOfOneAxisSaysNothingOfOthers) {
  add("lathe-1");
  report("probe", dds::encode(dds::ProbeText{{}, "contact", true, {{'Z', 5}}}));
  const auto xml = get("/current");
  EXPECT_EQ(value(xml, "contact-z.lathe-1"), "5");
  EXPECT_EQ(value(xml, "contact-x.lathe-1"), "UNAVAILABLE");
  EXPECT_EQ(value(xml, "contact.lathe-1"), "UNAVAILABLE");
}

TEST_F(ObserverTest, AMachineWithoutAKnownControlHasWhatItsLineTells) {
  add("press-1", 0);
  const auto xml = get("/press-1/current");
  EXPECT_EQ(value(xml, "availability.press-1"), "AVAILABLE");
  EXPECT_EQ(value(xml, "execution.press-1"), "READY");
  EXPECT_EQ(value(xml, "mode.press-1"), "-");
  EXPECT_EQ(get("/press-1/probe").find("<Axes"), std::string::npos);
}

TEST_F(ObserverTest, ADeviceGrowsWhenItsAxesAreKnown) {
  auto lathe = view("lathe-1");
  lathe.status.reset();
  observe(lathe);
  EXPECT_EQ(get("/probe").find("Linear"), std::string::npos);
  const auto revision = attribute(get("/current"), "nextSequence");
  add("lathe-1");
  EXPECT_EQ(count(get("/probe"), "<Linear "), 2U);
  const auto uuid = attribute(get("/lathe-1/probe"), "uuid");
  EXPECT_EQ(value(get("/sample?from=" + revision), "device-changed.Agent"), uuid);
}

TEST_F(ObserverTest, AMachineThatIsNoLongerListedIsLost) {
  add("lathe-1");
  add("press-1", 0);
  agent_->observer().reconcile({view("lathe-1"), view("mill-1")});
  const auto xml = get("/current");
  EXPECT_EQ(value(xml, "availability.lathe-1"), "AVAILABLE");
  EXPECT_EQ(value(xml, "availability.press-1"), "UNAVAILABLE");
  EXPECT_EQ(value(xml, "availability.mill-1"), "AVAILABLE") << "added";
}

TEST_F(ObserverTest, UuidsAreTheSameAtEveryStart) {
  add("lathe-1");
  const auto uuid = attribute(get("/lathe-1/probe"), "uuid");
  restart();
  add("mill-1");
  add("lathe-1");
  EXPECT_EQ(attribute(get("/lathe-1/probe"), "uuid"), uuid);
  EXPECT_EQ(uuid.size(), 36U);
}

}  // namespace
}  // namespace dripline::mtconnect_test
