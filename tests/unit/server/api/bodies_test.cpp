#include "server/api/bodies/port_bodies.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/api/bodies/run_bodies.hpp"
#include "server/api/bodies/webhook_bodies.hpp"

#include <gtest/gtest.h>
#include <functional>

namespace dripline::api {
namespace {

template <class T>
std::optional<Error> error_of(const Result<T>& result) {
  return result ? std::nullopt : std::optional<Error>(result.error());
}

struct BodyCase {
  const char* name;
  std::function<std::optional<Error>(std::string_view)> decode;
  std::string body;
  std::optional<Errc> error;
  const char* says = "";
};

std::optional<Error> upload(std::string_view body) {
  return error_of(decode_upload(body));
}
std::optional<Error> commit(std::string_view body) {
  return error_of(decode_commit(body));
}
std::optional<Error> start(std::string_view body) {
  return error_of(decode_start(body));
}
std::optional<Error> command(std::string_view body) {
  return error_of(decode_command(body));
}
std::optional<Error> panel(std::string_view body) {
  return error_of(decode_machine_command(body));
}

std::optional<Error> port(std::string_view body) {
  return error_of(decode_port("line-1", body));
}
std::optional<Error> rules_text(std::string_view body) {
  return error_of(decode_rules_text(body));
}
std::string port_with(const std::string& members) {
  return R"({"machine":"m1","address":"/dev/ttyS0",)" + members + "}";
}

std::string many_settings() {
  std::string members;
  for (int i = 0; i < 65; ++i) members += fmt::format("{}\"k{}\":1", i == 0 ? "" : ",", i);
  return members;
}

class DecodeBody : public testing::TestWithParam<BodyCase> {};

TEST_P(DecodeBody, TakesItOrNamesWhatIsWrong) {
  const BodyCase& c = GetParam();
  const auto error = c.decode(c.body);
  ASSERT_EQ(error.has_value(), c.error.has_value()) << (error ? error->what : "taken");
  if (!error) return;
  EXPECT_EQ(error->code, *c.error);
  EXPECT_NE(error->what.find(c.says), std::string::npos) << error->what;
}

const std::string kDeep = std::string(10'000, '[') + std::string(10'000, ']');

INSTANTIATE_TEST_SUITE_P(
    , DecodeBody,
    testing::Values(
        BodyCase{"upload", upload, R"({"program":"O1","control":"centurion","comment":"x"})", {}},
        BodyCase{"null_is_absent", upload, R"({"program":"O1","control":null})", {}},
        BodyCase{"no_json", upload, "{program", Errc::Syntax, "at byte 2"},
        BodyCase{"empty", upload, "", Errc::Syntax, "JSON"},
        BodyCase{"no_object", upload, "[]", Errc::Syntax, "object"},
        BodyCase{"missing", upload, "{}", Errc::Syntax, "'program' is missing"},
        BodyCase{"unknown_member", upload, R"({"program":"O1","color":1})", Errc::Syntax,
                 "'color'"},
        BodyCase{"twice", upload, R"({"program":"O1","program":"O2"})", Errc::Syntax, "twice"},
        BodyCase{"wrong_type", upload, R"({"program":1})", Errc::Syntax, "must be a string"},
        BodyCase{"name_leaves_folder", upload, R"({"program":"../O1"})", Errc::Syntax, "../O1"},
        BodyCase{"name_with_nul", upload, R"({"program":"O\u0000"})", Errc::Syntax, "NUL"},
        BodyCase{"comment_too_long", upload,
                 R"({"program":"O1","comment":")" + std::string(2000, 'x') + "\"}",
                 Errc::LimitExceeded, "2000"},
        BodyCase{"deep", upload, kDeep, Errc::Syntax, "nested deeper than 32"},
        BodyCase{"long", upload, R"({"program":[)" + std::string(70'000, '1') + "]}",
                 Errc::LimitExceeded, "at most 65536"},
        BodyCase{"deep_inside", start, R"({"machine":)" + kDeep + "}", Errc::Syntax, "nested"},
        BodyCase{"brackets_in_a_string",
                 upload,
                 R"({"program":"O1","comment":"\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["})",
                 {}},
        BodyCase{"not_utf8", upload, "{\"program\":\"O\xFF\"}", Errc::Syntax, "JSON"},
        BodyCase{
            "port",
            port,
            port_with(
                R"("template":"fanuc","settings":{"baud":9600,"eob":"lf","wait_for_xon":true},"rules":"","enabled":false)"),
            {}},
        BodyCase{"port_without_machine", port, R"({"address":"/dev/ttyS0"})", Errc::Syntax,
                 "'machine' is missing"},
        BodyCase{"port_bad_machine", port, R"({"machine":"M 1","address":"/dev/ttyS0"})",
                 Errc::Syntax, "'M 1'"},
        BodyCase{"port_empty_address", port, R"({"machine":"m1","address":""})", Errc::Syntax,
                 "'address' is empty"},
        BodyCase{"port_long_address", port,
                 R"({"machine":"m1","address":")" + std::string(256, '/') + "\"}",
                 Errc::LimitExceeded, "256 bytes: at most 255"},
        BodyCase{"port_setting_twice", port, port_with(R"("settings":{"eob":"lf","eob":"cr"})"),
                 Errc::Syntax, "'eob' is given twice"},
        BodyCase{"port_settings_list", port, port_with(R"("settings":["baud"])"), Errc::Syntax,
                 "'settings' must be an object"},
        BodyCase{"port_setting_nested", port, port_with(R"("settings":{"baud":[1]})"), Errc::Syntax,
                 "'settings.baud'"},
        BodyCase{"port_setting_fraction", port, port_with(R"("settings":{"baud":9600.5})"),
                 Errc::Syntax, "whole number"},
        BodyCase{"port_setting_long", port,
                 port_with(R"("settings":{"eob":")" + std::string(65, 'x') + "\"}"),
                 Errc::LimitExceeded, "'settings.eob' has 65 bytes: at most 64"},
        BodyCase{"port_many_settings", port, port_with("\"settings\":{" + many_settings() + "}"),
                 Errc::LimitExceeded, "65 members: at most 64"},
        BodyCase{"port_enabled_text", port, port_with(R"("enabled":"yes")"), Errc::Syntax,
                 "true or false"},
        BodyCase{"port_rules_long", port,
                 port_with(R"("rules":")" + std::string(32 * 1024 + 1, 'x') + "\""),
                 Errc::LimitExceeded, "at most 32768"},
        BodyCase{"port_name_inside", port, port_with(R"("name":"line-2")"), Errc::Syntax, "'name'"},
        BodyCase{"rules_text", rules_text, R"({"text":"O9999\n(PRG=1)\n"})", {}},
        BodyCase{"rules_text_long", rules_text,
                 R"({"text":")" + std::string(48 * 1024 + 1, 'x') + "\"}", Errc::LimitExceeded,
                 "at most 49152"},
        BodyCase{"rules_text_missing", rules_text, "{}", Errc::Syntax, "'text' is missing"},
        BodyCase{"commit_empty", commit, "", {}},
        BodyCase{"commit", commit, R"({"sha256":")" + std::string(64, 'a') + "\"}", {}},
        BodyCase{"commit_bad_digest", commit, R"({"sha256":"abc"})", Errc::Syntax, "64"},
        BodyCase{"start", start, R"({"machine":"m1","program":"O1","revision":2})", {}},
        BodyCase{"start_from", start, R"({"machine":"m1","program":"O1","from":"L7"})", {}},
        BodyCase{"start_head",
                 start,
                 R"({"machine":"m1","program":"O1","from":"L7","head":"send"})",
                 {}},
        BodyCase{"start_other_head", start,
                 R"({"machine":"m1","program":"O1","from":"L7","head":"all"})", Errc::Syntax},
        BodyCase{"start_from_with_memory",
                 start,
                 R"({"machine":"m1","program":"O1","from":"L7","memory":"begin","pass":2})",
                 {}},
        BodyCase{"start_with_another_memory", start,
                 R"({"machine":"m1","program":"O1","from":"L7","memory":"former"})", Errc::Syntax},
        BodyCase{"start_with_memory_at_the_beginning", start,
                 R"({"machine":"m1","program":"O1","memory":"now"})", Errc::Syntax},
        BodyCase{"start_at_no_pass", start,
                 R"({"machine":"m1","program":"O1","from":"L7","pass":0})", Errc::LimitExceeded},
        BodyCase{"start_from_nowhere", start, R"({"machine":"m1","program":"O1","from":"X5"})",
                 Errc::Syntax, "'X5' names no block"},
        BodyCase{"start_negative", start, R"({"machine":"m1","program":"O1","revision":-2})",
                 Errc::Syntax, "0 or more"},
        BodyCase{"start_fraction", start, R"({"machine":"m1","program":"O1","revision":1.5})",
                 Errc::Syntax, "whole"},
        BodyCase{"start_bad_machine", start, R"({"machine":"M/1","program":"O1"})", Errc::Syntax,
                 "M/1"},
        BodyCase{"hold", command, R"({"action":"hold"})", {}},
        BodyCase{"answer", command, R"({"action":"answer","text":"12.5"})", {}},
        BodyCase{"switch_on", command, R"({"action":"switch","name":"block_skip","value":1})", {}},
        BodyCase{"switch_half", command, R"({"action":"switch","name":"block_skip","value":0.5})",
                 Errc::Syntax, "0 or 1"},
        BodyCase{"override_missing", command, R"({"action":"feed_override"})", Errc::Syntax,
                 "needs member 'value'"},
        BodyCase{"override_too_high", command, R"({"action":"feed_override","value":11})",
                 Errc::LimitExceeded, "0 to 10"},
        BodyCase{"override_huge", command, R"({"action":"feed_override","value":1e999})",
                 Errc::Syntax, "JSON"},
        BodyCase{"hold_with_text", command, R"({"action":"hold","text":"x"})", Errc::Syntax,
                 "does not take member 'text'"},
        BodyCase{
            "panel_switch", panel, R"({"action":"switch","name":"emergency_stop","value":1})", {}},
        BodyCase{"panel_override", panel, R"({"action":"spindle_override","value":1})", {}},
        BodyCase{"panel_without_value", panel, R"({"action":"switch","name":"block_skip"})",
                 Errc::Syntax, "needs member 'value'"},
        BodyCase{"panel_resume", panel, R"({"action":"resume"})", Errc::Unsupported,
                 "is for a run"},
        BodyCase{"unknown_action", command, R"({"action":"explode"})", Errc::Unsupported,
                 "hold, resume"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(DecodePort, PutsTheLineBeforeWhatChangesIt) {
  const auto port = decode_port(
      "line-1", port_with(R"("settings":{"baud":4800,"line":"9600e72","parity":"odd"})"));
  ASSERT_TRUE(port) << port.error().what;
  using Setting = std::pair<std::string, std::string>;
  EXPECT_EQ(port->settings,
            (std::vector<Setting>{{"line", "9600e72"}, {"baud", "4800"}, {"parity", "odd"}}));
  EXPECT_TRUE(port->is_enabled);
}

}  // namespace
}  // namespace dripline::api
