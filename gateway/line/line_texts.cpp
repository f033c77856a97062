#include "gateway/line/line_texts.hpp"

#include <nlohmann/json.hpp>

namespace dripline::line {
namespace {

using nlohmann::json;

std::string to_text(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Reads the members; a wrong one is an error with the text's name.
template <class Value, class Read>
Result<Value> decode(std::string_view text, std::string_view name, const Read& read) {
  const json value = json::parse(text, nullptr, false);
  if (!value.is_object()) return fail(Errc::Syntax, "{} is no JSON object", name);
  try {
    return read(value);
  } catch (const json::exception& error) {
    return fail(Errc::Syntax, "{}: {}", name, error.what());
  }
}

}  // namespace

std::string encode(const TransferOrder& order) {
  return to_text({{"sha256", order.content}, {"name", order.name}, {"programs", order.programs}});
}

std::string encode(const PortTest& test) {
  return to_text({{"passed", test.is_passed}, {"findings", test.findings}});
}

std::string encode(const RuleVerdict& verdict, std::size_t max_bytes) {
  json value{{"rule", verdict.rule},
             {"action", verdict.action},
             {"argument", verdict.argument},
             {"why", verdict.why}};
  std::string text = to_text(value);
  while (text.size() > max_bytes && !value["why"].empty()) {
    value["why"].erase(value["why"].size() - 1);
    text = to_text(value);
  }
  return text;
}

Result<TransferOrder> decode_transfer_order(std::string_view text) {
  return decode<TransferOrder>(text, "transfer", [](const json& value) {
    return TransferOrder{.content = value.at("sha256").get<std::string>(),
                         .name = value.at("name").get<std::string>(),
                         .programs = value.at("programs").get<std::vector<std::string>>()};
  });
}

Result<PortTest> decode_port_test(std::string_view text) {
  return decode<PortTest>(text, "test", [](const json& value) {
    return PortTest{.is_passed = value.at("passed").get<bool>(),
                    .findings = value.at("findings").get<std::vector<std::string>>()};
  });
}

Result<RuleVerdict> decode_rule_verdict(std::string_view text) {
  return decode<RuleVerdict>(text, "verdict", [](const json& value) {
    return RuleVerdict{.rule = value.at("rule").get<std::string>(),
                       .action = value.at("action").get<std::string>(),
                       .argument = value.at("argument").get<std::string>(),
                       .why = value.at("why").get<std::vector<std::string>>()};
  });
}

}  // namespace dripline::line
