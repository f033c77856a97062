#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::api {

/// Of a name in a body: longer ones are refused before they are checked.
inline constexpr std::size_t kMaxName = 256;

/// Reads one JSON object strictly: members have the right type, are within their bounds, known and
/// unique. finish() returns the first error, so that decoding is a plain list of members. Nesting
/// is checked before parsing.
class JsonObject {
 public:
  static constexpr int kMaxDepth = 32;
  /// A parsed text takes many times its size; no valid body is close to this limit.
  static constexpr std::size_t kMaxBytes = 64 * 1024;

  /// Errors: Syntax (not JSON, not an object, nested too deep, a member twice), LimitExceeded.
  static Result<JsonObject> parse(std::string_view text);

  bool has(const std::string& name) const { return members_.contains(name); }
  std::string required_text(const std::string& name, std::size_t longest);
  std::optional<std::string> optional_text(const std::string& name, std::size_t longest);
  std::optional<std::uint64_t> optional_unsigned(const std::string& name);
  std::optional<double> optional_number(const std::string& name);
  std::optional<bool> optional_flag(const std::string& name);
  /// A list of at most `most` strings. Absent: empty.
  std::vector<std::string> optional_texts(const std::string& name, std::size_t longest,
                                          std::size_t most);
  /// An object of strings, whole numbers and booleans, each as text; in order of their names.
  /// Absent: empty.
  std::vector<std::pair<std::string, std::string>> optional_scalars(const std::string& name,
                                                                    std::size_t longest);
  /// Errors: Syntax, LimitExceeded; names the member and what was expected.
  Result<void> finish();

 private:
  explicit JsonObject(nlohmann::json members) : members_(std::move(members)) {}
  std::string checked_text(const std::string& name, std::string text, std::size_t longest);
  std::optional<nlohmann::json> take(const std::string& name);
  void complain(Errc code, std::string what);

  nlohmann::json members_;
  std::optional<Error> error_;
};

}  // namespace dripline::api
