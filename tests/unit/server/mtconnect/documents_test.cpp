#include "server/mtconnect/documents.hpp"

#include <filesystem>
#include <fstream>

#include "server/mtconnect/xml_text.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/server/mtconnect/agent_fixture.hpp"

namespace dripline::mtconnect_test {
namespace {

using namespace mtconnect;

/// The folder of MTConnect's schemas (their own licence: they are no part of Dripline); empty: they
/// are not here.
std::filesystem::path schemas() {
  const char* named =
      std::getenv("DRIPLINE_MTCONNECT_SCHEMAS");  // NOLINT(concurrency-mt-unsafe): no threads
  const std::filesystem::path folder = named != nullptr ? named : "../shared/mtconnect";
  return std::filesystem::exists(folder / "MTConnectStreams_2.4_1.0.xsd") ? folder
                                                                          : std::filesystem::path();
}

class SchemaTest : public AgentTest {
 protected:
  /// What xmllint finds wrong; empty: nothing.
  std::string fault(const std::string& kind, const std::string& xml) const {
    const auto file = folder_.path() / "document.xml";
    std::ofstream(file) << xml;
    const auto schema = schemas() / ("MTConnect" + kind + "_2.4_1.0.xsd");
    const auto checked = test_support::run_to_end(
        {"/usr/bin/xmllint", "--nonet", "--noout", "--schema", schema, file},
        folder_.path() / "output");
    return checked.status == 0 ? "" : checked.output + xml;
  }
  void SetUp() override {
    if (schemas().empty())
      GTEST_SKIP() << "no MTConnect schemas: name their folder in DRIPLINE_MTCONNECT_SCHEMAS";
    if (!std::filesystem::exists("/usr/bin/xmllint")) GTEST_SKIP() << "no xmllint (libxml2-utils)";
  }
  /// Everything that a document can have.
  void play() {
    auto mill = view("mill-1", kXYZC);
    auto& status = mill.status.edit();
    status.execution = dds::Execution::Waiting;
    status.program = "O1 <&\"'>";
    status.message = "asks: \x01 \xFF how?\n\ttell";
    status.line = 12;
    status.sequence = 30;
    status.position[0] = -1.23456;
    status.feed_mm_per_min = 100;
    status.modes.emplace();
    status.modes->tool = 3;
    status.modes->work_system = "G54";
    status.emergency_stop = true;
    observe(mill);
    add("lathe-1");
    add("press-1", 0);
    report("output", "D1=5.000");
    report("message", "turn the part");
    report("probe", dds::encode(dds::ProbeText{{}, "contact", true, {{'X', 1.5}, {'Z', -2}}}));
    alarm("CEN0103", "300: bad block <N20>");
    report("warning", dds::encode(dds::AlarmText{"GRB0001", "slow"}));
    auto lost = view("mill-2", 0x1FF);
    observe(lost);
    lost.is_connected = false;
    observe(lost);
    storage::SetupRevision setup;
    setup.machine = "mill-1";
    setup.number = 1;
    setup.created = clock_.now();
    setup.text = "[[tool]]\nnumber = 3\nlength = 80.0\nradius = 5.0\n";
    agent_->use_setup(setup, "fanuc", false);
    setup.number = 2;
    setup.text = "[[tool]]\nnumber = 4\nlength = 70.0\n";
    agent_->use_setup(setup, "fanuc", false);
    setup.machine = "lathe-1";
    setup.text = "units = \"mm\"\n[[tool]]\nnumber = 1\nX = 10.0\nZ = 20.0\nradius = 0.8\n";
    agent_->use_setup(setup, "centurion", false);
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(SchemaTest, DevicesAreValid) {
  play();
  EXPECT_EQ(fault("Devices", get("/probe")), "");
  EXPECT_EQ(fault("Devices", get("/mill-1/probe")), "");
}

TEST_F(SchemaTest, StreamsAreValid) {
  play();
  EXPECT_EQ(fault("Streams", get("/current")), "");
  EXPECT_EQ(fault("Streams", get("/current?at=20")), "");
  EXPECT_EQ(fault("Streams", get("/lathe-1/current")), "");
  EXPECT_EQ(fault("Streams", get("/sample?count=1000")), "");
  EXPECT_EQ(fault("Streams", get("/sample?from=" + attribute(get("/current"), "nextSequence"))), "")
      << "without observations";
}

TEST_F(SchemaTest, AssetsAreValid) {
  play();
  const auto all = get("/assets?removed=true");
  EXPECT_EQ(count(all, "<CuttingTool "), 3U);
  EXPECT_EQ(fault("Assets", all), "");
  EXPECT_EQ(fault("Assets", get("/assets?type=Fixture")), "") << "none";
}

TEST_F(SchemaTest, ErrorsAreValid) {
  for (const char* target : {"/unknown/probe", "/a/b/c", "/current?at=999999", "/sample?count=x",
                             "/current?path=%5B", "/asset/none"}) {
    const auto response = ask(target);
    EXPECT_NE(response.status, 200) << target;
    EXPECT_EQ(fault("Error", response.body), "") << target;
  }
  EXPECT_EQ(fault("Error", ask("/probe", "DELETE").body), "");
}

TEST(XmlText, EscapesAndReplacesWhatXmlCannotCarry) {
  EXPECT_EQ(escaped("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c'");
  EXPECT_EQ(escaped("\t\n\r"), "&#9;&#10;&#13;");
  EXPECT_EQ(escaped(std::string_view("\0\x1b", 2)), "\uFFFD\uFFFD");
  EXPECT_EQ(escaped("\xC3\xA4\xC3"), "\u00E4\uFFFD");
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD") << "a surrogate";
  EXPECT_EQ(escaped("\uFFFE\uFFFF"), "\uFFFD\uFFFD");
}

TEST(XmlText, WritesNumbersAsTheyAreRead) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.00001), "0");
  EXPECT_EQ(number_text(12.5), "12.5");
  EXPECT_EQ(number_text(-0.0001), "-0.0001");
  EXPECT_EQ(number_text(100), "100");
  EXPECT_EQ(number_text(1e300).size(), 301U);
}

TEST(XmlText, WritesTimesWithMicroseconds) {
  std::string text;
  const UtcTime time{std::chrono::microseconds{1'700'000'000'000'042}};
  append_time(text, time);
  EXPECT_EQ(text, to_iso8601(time));
}

}  // namespace
}  // namespace dripline::mtconnect_test
