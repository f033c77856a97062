#include "server/mqtt/sparkplug_payload.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dripline::mqtt {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

std::string hex(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

// As the npm package sparkplug-payload 1.0.3 of the Eclipse Tahu project encodes it.
TEST(SparkplugPayload, IsWhatOthersEncode) {
  const Payload payload{.time = UtcTime(milliseconds(1'764'277'000'123)),
                        .seq = 7,
                        .metrics = {{"bdSeq", Metric::Type::Unsigned, std::uint64_t{3}},
                                    {"status/position/X", Metric::Type::Double, -12.5},
                                    {"connected", Metric::Type::Boolean, true},
                                    {"status/program", Metric::Type::Text, "O0100"},
                                    {"status/tool", Metric::Type::Double, std::nullopt}}};
  EXPECT_EQ(
      hex(encode(payload)),
      "08bbafeab8ac3312120a05626453657118bbafeab8ac332008580312250a117374617475732f706f736974696f"
      "6e2f5818bbafeab8ac33200a6900000000000029c012160a09636f6e6e656374656418bbafeab8ac33200b7001"
      "12200a0e7374617475732f70726f6772616d18bbafeab8ac33200c7a054f3031303012180a0b7374617475732f"
      "746f6f6c18bbafeab8ac33200a38011807");
}

TEST(SparkplugPayload, HasTheLeavesOfADocument) {
  const auto metrics = metrics_of(json::parse(
      R"({"name":"mill","connected":false,"none":null,"status":{"executed":5,"at":{"X":1.25}},
          "display":[{"text":"A"},{"text":"B"}]})"));
  const std::vector<Metric> expected{
      {"connected", Metric::Type::Boolean, false}, {"display/0/text", Metric::Type::Text, "A"},
      {"display/1/text", Metric::Type::Text, "B"}, {"name", Metric::Type::Text, "mill"},
      {"status/at/X", Metric::Type::Double, 1.25}, {"status/executed", Metric::Type::Double, 5.0}};
  EXPECT_EQ(metrics, expected);
}

TEST(SparkplugPayload, ReplacesBytesThatAreNoText) {
  const auto metrics = metrics_of(json{{"text", "A\xff"}});
  ASSERT_EQ(metrics.size(), 1U);
  EXPECT_EQ(std::get<std::string>(*metrics[0].value), "A\xef\xbf\xbd");
}

std::string command(const std::string& name, bool value) {
  return encode({.time = UtcTime{}, .seq = {}, .metrics = {{name, Metric::Type::Boolean, value}}});
}

TEST(SparkplugPayload, TakesTheWishForBirthsAndNothingElse) {
  EXPECT_TRUE(asks_rebirth(command(kRebirth, true)));
  EXPECT_FALSE(asks_rebirth(command(kRebirth, false)));
  EXPECT_FALSE(asks_rebirth(command("Node Control/Reboot", true)));
  EXPECT_FALSE(asks_rebirth(""));
}

TEST(SparkplugPayload, TakesNothingFromBytesThatAreNoPayload) {
  const std::string whole = command(kRebirth, true);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(asks_rebirth(whole.substr(0, size))) << size;
  EXPECT_FALSE(asks_rebirth(std::string(1000, '\xff')));
  EXPECT_FALSE(asks_rebirth(R"({"Node Control/Rebirth":true})"));
}

TEST(SparkplugId, RefusesWhatATopicCannotHave) {
  EXPECT_TRUE(check_sparkplug_id("Hall 2"));
  for (const char* id : {"", "a/b", "a+", "#", "a\nb", "a\x7f"})
    EXPECT_FALSE(check_sparkplug_id(id)) << id;
}

}  // namespace
}  // namespace dripline::mqtt
