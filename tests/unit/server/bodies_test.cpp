#include "server/api/bodies.hpp"

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
std::optional<Error> order(std::string_view body) {
  return error_of(decode_order(body));
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
        BodyCase{"unknown_member", upload, R"({"program":"O1","colour":1})", Errc::Syntax,
                 "'colour'"},
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
        BodyCase{"commit_empty", commit, "", {}},
        BodyCase{"commit", commit, R"({"sha256":")" + std::string(64, 'a') + "\"}", {}},
        BodyCase{"commit_bad_digest", commit, R"({"sha256":"abc"})", Errc::Syntax, "64"},
        BodyCase{"start", start, R"({"machine":"m1","program":"O1","revision":2})", {}},
        BodyCase{"start_negative", start, R"({"machine":"m1","program":"O1","revision":-2})",
                 Errc::Syntax, "0 or more"},
        BodyCase{"start_fraction", start, R"({"machine":"m1","program":"O1","revision":1.5})",
                 Errc::Syntax, "whole"},
        BodyCase{"start_bad_machine", start, R"({"machine":"M/1","program":"O1"})", Errc::Syntax,
                 "M/1"},
        BodyCase{"hold", order, R"({"action":"hold"})", {}},
        BodyCase{"answer", order, R"({"action":"answer","text":"12.5"})", {}},
        BodyCase{"switch_on", order, R"({"action":"switch","name":"block_skip","value":1})", {}},
        BodyCase{"switch_half", order, R"({"action":"switch","name":"block_skip","value":0.5})",
                 Errc::Syntax, "0 or 1"},
        BodyCase{"override_missing", order, R"({"action":"feed_override"})", Errc::Syntax,
                 "needs member 'value'"},
        BodyCase{"override_too_high", order, R"({"action":"feed_override","value":11})",
                 Errc::LimitExceeded, "0 to 10"},
        BodyCase{"override_huge", order, R"({"action":"feed_override","value":1e999})",
                 Errc::Syntax, "JSON"},
        BodyCase{"hold_with_text", order, R"({"action":"hold","text":"x"})", Errc::Syntax,
                 "does not take member 'text'"},
        BodyCase{"unknown_action", order, R"({"action":"explode"})", Errc::Unsupported,
                 "hold, resume"}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::api
