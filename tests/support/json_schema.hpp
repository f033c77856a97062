#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace dripline::test_support {

/// Does `value` follow `schema`, a schema of the OpenAPI document `document`? Knows what our
/// description uses: $ref, type, nullable, required, properties, additionalProperties, items, enum,
/// minimum, pattern. Empty: yes; otherwise where and why not. A keyword it does not know is an
/// error, so a description cannot promise what no test checks.
std::string schema_violation(const nlohmann::json& document, const nlohmann::json& schema,
                             const nlohmann::json& value, const std::string& where = "$");

}  // namespace dripline::test_support
