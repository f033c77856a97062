#include "protocol/dds/record_text.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace dripline::dds {
namespace {

const std::string kDigest(64, 'c');

TEST(RecordText, RunStartSurvivesTheRoundTrip) {
  const RunStartText value{"part \"7\".nc", kDigest, "centurion"};
  EXPECT_EQ(decode_run_start(encode(value)).value(), value);
}

TEST(RecordText, RunStartNamesTheSetupOfItsGateway) {
  const RunStartText value{"p.nc", kDigest, "centurion", kDigest};
  EXPECT_EQ(decode_run_start(encode(value)), value);
  EXPECT_FALSE(decode_run_start(encode(RunStartText{"p.nc", kDigest, "centurion", "a"})));
}

TEST(RecordText, RunEndSurvivesTheRoundTrip) {
  RunEndText value;
  value.outcome = RunOutcome::Alarmed;
  value.sent = UINT64_MAX;
  value.accepted = 20;
  value.executed = 10;
  value.line = 11;
  value.sequence = -1;
  value.reason = "Endschalter X+";
  value.content_sha256 = kDigest;
  value.content_length = 4096;
  EXPECT_EQ(decode_run_end(encode(value)).value(), value);
  value.motion_seconds = 12.5;
  value.path_mm = 0.1;
  value.content_sha256.clear();  // unknown
  EXPECT_EQ(decode_run_end(encode(value)).value(), value);
}

TEST(RecordText, AlarmSurvivesTheRoundTrip) {
  const AlarmText value{"NC0107", "zwei G-Codes einer Gruppe"};
  EXPECT_EQ(decode_alarm(encode(value)).value(), value);
}

TEST(RecordText, ProbeSurvivesTheRoundTrip) {
  const ProbeText value{{{'X', 1.25}, {'Z', -0.1}}, "contact", true, {{'X', 1.5}}};
  EXPECT_EQ(decode_probe(encode(value)).value(), value);
}

TEST(RecordText, InvalidUtf8IsReplacedNotRefused) {
  const auto decoded = decode_alarm(encode(AlarmText{"E1",
                                                     "S\xFC"
                                                     "d"}));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->text,
            "S\xEF\xBF\xBD"
            "d");
}

TEST(RecordText, MembersOfNewerVersionsAreIgnored) {
  EXPECT_TRUE(decode_alarm(R"({"code":"E1","text":"t","more":[1]})"));
}

struct BadText {
  std::string name, text;
  Errc code = Errc::Syntax;
  friend std::ostream& operator<<(std::ostream& out, const BadText& c) { return out << c.name; }
};

class BadAlarmText : public testing::TestWithParam<BadText> {};

TEST_P(BadAlarmText, IsRefused) {
  const auto decoded = decode_alarm(GetParam().text);
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, GetParam().code) << decoded.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , BadAlarmText,
    testing::Values(BadText{"empty", ""}, BadText{"no_object", "[]"}, BadText{"cut_off", "{"},
                    BadText{"missing_member", R"({"code":"E1"})"},
                    BadText{"wrong_type", R"({"code":"E1","text":1})"},
                    BadText{"trailing", R"({"code":"E1","text":""} x)"},
                    BadText{"invalid_utf8", "{\"code\":\"\xFF\",\"text\":\"\"}"},
                    BadText{"nested", std::string(2000, '[') + std::string(2000, ']'),
                            Errc::LimitExceeded},
                    BadText{"long", std::string(5000, ' '), Errc::LimitExceeded}),
    [](const auto& i) { return i.param.name; });

TEST(RecordText, RunEndOfAnOlderGatewayHasNoTimeAndNoPath) {
  const auto text = decode_run_end(encode(RunEndText{}));
  ASSERT_TRUE(text);
  EXPECT_FALSE(text->motion_seconds || text->path_mm);
  RunEndText value;
  value.path_mm = -1;
  EXPECT_FALSE(decode_run_end(encode(value))) << "no path is shorter than none";
}

class BadRunEndText : public testing::TestWithParam<BadText> {};

TEST_P(BadRunEndText, IsRefused) {
  std::string text = encode(RunEndText{});
  ASSERT_TRUE(decode_run_end(text));
  const auto place = text.find(GetParam().name);
  ASSERT_NE(place, text.npos);
  const auto from = text.find(':', place) + 1;
  const auto to = text.find_first_of(",}", from);
  text.replace(from, to - from, GetParam().text);
  EXPECT_FALSE(decode_run_end(text)) << text;
}

INSTANTIATE_TEST_SUITE_P(, BadRunEndText,
                         testing::Values(BadText{"outcome", "\"finished\""}, BadText{"sent", "-1"},
                                         BadText{"accepted", "1.5"}, BadText{"executed", "\"1\""},
                                         BadText{"line", "null"},
                                         BadText{"sequence", "18446744073709551615"},
                                         BadText{"reason", "7"},
                                         BadText{"content_sha256", "\"abc\""},
                                         BadText{"content_length", "true"}),
                         [](const auto& i) { return i.param.name; });

TEST(RecordText, RefusesAProbeWithAnUnknownAxis) {
  EXPECT_FALSE(decode_probe(R"({"to":{"Q":1},"until":"contact","tripped":true,"at":{}})"));
  EXPECT_FALSE(decode_probe(R"({"to":{"X":"1"},"until":"contact","tripped":true,"at":{}})"));
  EXPECT_FALSE(decode_probe(R"({"to":{},"until":"sometime","tripped":true,"at":{}})"));
}

}  // namespace
}  // namespace dripline::dds
