#include "gateway/machine/linuxcnc/helper_reply.hpp"

#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/linuxcnc/fake_helper.hpp"

namespace dripline::machine::linuxcnc::test {
namespace {

TEST(HelperReply, ReadsWhatLinuxCncIs) {
  const auto reply = parse_helper_reply(kHello);
  const auto* hello = std::get_if<HelloReply>(&reply);
  ASSERT_NE(hello, nullptr);
  EXPECT_EQ(hello->axes, 7U);
  EXPECT_EQ(hello->high[1], 300);
  EXPECT_EQ(hello->velocity[2], 200);
  EXPECT_EQ(hello->read_ahead, 2);
}

TEST(HelperReply, ReadsAnswersAndMessages) {
  const auto done = parse_helper_reply(R"({"done":7,"problem":"no","echo":3})");
  ASSERT_TRUE(std::holds_alternative<DoneReply>(done));
  EXPECT_EQ(std::get<DoneReply>(done).number, 7U);
  EXPECT_EQ(std::get<DoneReply>(done).problem, "no");
  const auto message = parse_helper_reply(R"({"message":11,"text":"joint 0 following error"})");
  ASSERT_TRUE(std::holds_alternative<MessageReply>(message));
  EXPECT_TRUE(std::get<MessageReply>(message).is_error());
  EXPECT_FALSE((MessageReply{13, ""}).is_error());
  EXPECT_TRUE(std::holds_alternative<FatalReply>(parse_helper_reply(R"({"fatal":"gone"})")));
  const auto pin = parse_helper_reply(R"({"signal":"spindle.0.at-speed","value":1})");
  ASSERT_TRUE(std::holds_alternative<SignalReply>(pin));
  EXPECT_EQ(std::get<SignalReply>(pin).value, 1.0);
  const auto none = parse_helper_reply(R"({"signal":"x","problem":"not found"})");
  ASSERT_TRUE(std::holds_alternative<SignalReply>(none));
  EXPECT_FALSE(std::get<SignalReply>(none).value);
}

struct GarbageCase {
  const char* name;
  std::string line;
};

std::string hello_with(const std::string& from, const std::string& to) {
  std::string line(kHello);
  line.replace(line.find(from), from.size(), to);
  return line;
}

class HelperGarbage : public testing::TestWithParam<GarbageCase> {};

TEST_P(HelperGarbage, IsNoReply) {
  EXPECT_TRUE(std::holds_alternative<GarbageReply>(parse_helper_reply(GetParam().line)));
}

INSTANTIATE_TEST_SUITE_P(
    , HelperGarbage,
    testing::Values(GarbageCase{"empty", ""}, GarbageCase{"no_json", "Traceback (most recent"},
                    GarbageCase{"no_object", "[1,2]"}, GarbageCase{"unknown", R"({"x":1})"},
                    GarbageCase{"axis_missing", hello_with("[0,0]]", "[0]]")},
                    GarbageCase{"no_axes", hello_with("\"axes\":7", "\"axes\":0")},
                    GarbageCase{"many_axes", hello_with("\"axes\":7", "\"axes\":512")},
                    GarbageCase{"huge", hello_with("6000", "1e300")},
                    GarbageCase{"negative_number", R"({"done":-1,"problem":""})"},
                    GarbageCase{"text_for_number", R"({"done":"1","problem":""})"},
                    GarbageCase{"huge_number", R"({"done":18446744073709551615,"problem":""})"},
                    GarbageCase{"status_without_members", R"({"status":{}})"},
                    GarbageCase{"status_no_object", R"({"status":1})"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(HelperLines, CutsAtLineEndsWhereverTheyCome) {
  HelperLines lines;
  const std::string text = "one\ntwo\nthr";
  EXPECT_EQ(lines.feed(std::as_bytes(std::span(text))), (std::vector<std::string>{"one", "two"}));
  const std::string rest = "ee\n";
  EXPECT_EQ(lines.feed(std::as_bytes(std::span(rest))), std::vector<std::string>{"three"});
  const std::string endless(3 * HelperLines::kMaxLine, 'x');
  EXPECT_EQ(lines.feed(std::as_bytes(std::span(endless))).size(), 3U) << "bounded";
}

}  // namespace
}  // namespace dripline::machine::linuxcnc::test
