#include "tests/support/json_schema.hpp"

#include <fmt/format.h>

#include <regex>
#include <set>

namespace dripline::test_support {
namespace {

using nlohmann::json;

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return false;
}

std::string unknown_keyword(const json& schema) {
  static const std::set<std::string> kKnown{
      "type",    "nullable", "allOf",      "required", "properties", "additionalProperties",
      "items",   "enum",     "format",     "minimum",  "maximum",    "maxLength",
      "default", "pattern",  "description"};
  for (const auto& [keyword, unused] : schema.items()) {
    if (!kKnown.contains(keyword)) return keyword;
  }
  return {};
}

std::string object_violation(const json& document, const json& schema, const json& value,
                             const std::string& where) {
  for (const auto& name : schema.value("required", json::array())) {
    if (!value.contains(name)) return where + ": '" + name.get<std::string>() + "' is missing";
  }
  const json properties = schema.value("properties", json::object());
  const json others = schema.value("additionalProperties", json(true));
  for (const auto& [name, member] : value.items()) {
    const std::string here = fmt::format("{}.{}", where, name);
    if (properties.contains(name)) {
      auto violation = schema_violation(document, properties[name], member, here);
      if (!violation.empty()) return violation;
    } else if (others == false) {
      return here + ": not in the description";
    } else if (others.is_object()) {
      auto violation = schema_violation(document, others, member, here);
      if (!violation.empty()) return violation;
    }
  }
  return {};
}

std::string scalar_violation(const json& schema, const json& value, const std::string& where) {
  if (schema.contains("enum")) {
    const json& allowed = schema["enum"];
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
      return where + ": " + value.dump() + " is not one of " + allowed.dump();
    }
  }
  if (schema.contains("minimum") && value.get<double>() < schema["minimum"].get<double>()) {
    return where + ": " + value.dump() + " is too small";
  }
  if (schema.contains("pattern") &&
      !std::regex_search(value.get<std::string>(),
                         std::regex(schema["pattern"].get<std::string>()))) {
    return where + ": " + value.dump() + " does not match";
  }
  return {};
}

}  // namespace

std::string schema_violation(const json& document, const json& schema, const json& value,
                             const std::string& where) {
  if (schema.contains("$ref")) {
    const std::string pointer = schema["$ref"].get<std::string>().substr(1);
    return schema_violation(document, document.at(json::json_pointer(pointer)), value, where);
  }
  if (const auto keyword = unknown_keyword(schema); !keyword.empty()) {
    return where + ": keyword '" + keyword + "' is not checked";
  }
  if (value.is_null() && schema.value("nullable", false)) return {};
  if (schema.contains("allOf") && schema["allOf"].size() == 1)  // a reference that may be null
    return schema_violation(document, schema["allOf"][0], value, where);
  const std::string type = schema.value("type", "");
  if (!has_type(value, type)) return where + ": " + value.dump() + " is no " + type;
  if (type == "object") return object_violation(document, schema, value, where);
  if (type == "array") {
    for (std::size_t i = 0; i < value.size(); ++i) {
      auto violation = schema_violation(document, schema["items"], value[i],
                                        where + "[" + std::to_string(i) + "]");
      if (!violation.empty()) return violation;
    }
    return {};
  }
  return scalar_violation(schema, value, where);
}

}  // namespace dripline::test_support
