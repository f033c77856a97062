#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

class DncReplay : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};

  static std::string entry(int second, const std::string& what, const std::string& bytes) {
    std::string hex;
    for (const char c : bytes) {
      constexpr const char* kDigits = "0123456789abcdef";
      hex += kDigits[static_cast<unsigned char>(c) / 16];
      hex += kDigits[static_cast<unsigned char>(c) % 16];
    }
    return json{{"port", "line-1"},
                {"time", "2026-11-21T07:40:0" + std::to_string(second) + ".000000Z"},
                {"what", what},
                {"bytes", hex},
                {"text", ""}}
               .dump() +
           "\n";
  }
};

TEST_F(DncReplay, RunsWhatArrivesAtTheControl) {
  dnc.write("night.jsonl", entry(0, "note", "") + entry(1, "sent", "G20\r\nG0 X2\r\n") +
                               entry(2, "received", "\x13") + entry(3, "received", "\x11") +
                               entry(4, "sent", "G1 Z-1 F9\r\nM30\r\n"));
  const auto replayed = dnc({"port", "replay", "night.jsonl", "--against", "centurion", "--json"});
  EXPECT_EQ(replayed.status, 0) << replayed.err;
  const auto report = json::parse(replayed.out);
  EXPECT_EQ(report.at("deviations"), 0);
  ASSERT_EQ(report.at("to_control").size(), 1U) << replayed.out;
  EXPECT_EQ(report.at("to_control")[0].at("verdict"),
            "centurion runs it to its end: 4 blocks, 0 warnings");
}

TEST_F(DncReplay, NamesTheLineThatIsNoRecording) {
  dnc.write("night.jsonl", entry(0, "sent", "G20\r\n") + "rubbish\n");
  const auto replayed = dnc({"port", "replay", "night.jsonl", "--against", "centurion"});
  EXPECT_EQ(replayed.status, 2);
  EXPECT_NE(replayed.err.find("night.jsonl: line 2: not JSON"), std::string::npos) << replayed.err;
  EXPECT_EQ(dnc({"port", "replay", "none", "--against", "centurion"}).status, 2);
  EXPECT_EQ(dnc({"port", "replay", "night.jsonl", "--against", "loom"}).status, 2);
}

}  // namespace
}  // namespace dripline
