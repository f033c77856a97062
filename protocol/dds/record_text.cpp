#include "protocol/dds/record_text.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "protocol/base/digest.hpp"
#include "protocol/base/invariant.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::dds {
namespace {

using Json = nlohmann::json;

constexpr int kMaxDepth = 8;  // the texts nest two deep; the rest is for later members
constexpr std::array<std::string_view, 5> kOutcomes{"completed", "aborted", "alarmed",
                                                    "interrupted", "tested"};
constexpr std::string_view kAxes = "XYZABCUVW";

/// Counts brackets outside strings. The text is refused before parsing, so that hostile nesting
/// cannot exhaust stack or memory.
bool nests_deeper_than(std::string_view text, int limit) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if ((c == '[' || c == '{') && ++depth > limit) return true;
    if (c == ']' || c == '}') --depth;
  }
  return false;
}

Result<Json> parse_object(std::string_view text) {
  if (text.size() > kMaxRecordText) {
    return fail(Errc::LimitExceeded, "record text of {} bytes, at most {}", text.size(),
                kMaxRecordText);
  }
  if (nests_deeper_than(text, kMaxDepth)) {
    return fail(Errc::LimitExceeded, "record text nests deeper than {}", kMaxDepth);
  }
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return fail(Errc::Syntax, "record text is not a JSON object");
  return json;
}

/// Reads the members of one object; the first that is missing or of another type is the error.
class Members {
 public:
  explicit Members(const Json& object) : object_(object) {}

  std::string text(const char* name) {
    const Json* found = find(name, &Json::is_string);
    return found != nullptr ? found->get<std::string>() : std::string{};
  }
  bool flag(const char* name) {
    const Json* found = find(name, &Json::is_boolean);
    return found != nullptr && found->get<bool>();
  }
  std::uint64_t count(const char* name) {
    const Json* found = find(name, &Json::is_number_unsigned);
    return found != nullptr ? found->get<std::uint64_t>() : 0;
  }
  std::int64_t integer(const char* name) {
    const Json* found = find(name, &Json::is_number_integer);
    if (found == nullptr) return 0;
    if (found->is_number_unsigned() && found->get<std::uint64_t>() > INT64_MAX) blame(name);
    return found->get<std::int64_t>();
  }
  /// 0 or more.
  double amount(const char* name) {
    const Json* found = find(name, &Json::is_number);
    if (found == nullptr) return 0;
    const double value = found->get<double>();
    if (!std::isfinite(value) || value < 0) blame(name);
    return value;
  }
  std::map<char, double> axes(const char* name) {
    std::map<char, double> result;
    const Json* found = find(name, &Json::is_object);
    if (found == nullptr) return result;
    for (const auto& [axis, value] : found->items()) {
      if (axis.size() != 1 || kAxes.find(axis[0]) == kAxes.npos || !value.is_number()) {
        blame(name);
        continue;
      }
      result[axis[0]] = value.get<double>();
      if (!std::isfinite(result[axis[0]])) blame(name);
    }
    return result;
  }
  void blame(const char* name) {
    if (!wrong_) wrong_ = name;
  }
  /// The value, unless a member was wrong.
  template <class T>
  Result<T> finish(T value, std::string_view kind) {
    if (wrong_) return fail(Errc::Syntax, "{} text: member {} is missing or wrong", kind, *wrong_);
    return value;
  }

 private:
  const Json* find(const char* name, bool (Json::*is_type)() const noexcept) {
    const auto found = object_.find(name);
    if (found != object_.end() && ((*found).*is_type)()) return &*found;
    blame(name);
    return nullptr;
  }

  const Json& object_;
  std::optional<std::string> wrong_;
};

bool is_digest(const std::string& text) {
  return parse_digest(text).has_value();
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double finite(double value) {
  invariant(std::isfinite(value), "a number of a record is finite");
  return value;
}

Json axes_object(const std::map<char, double>& axes) {
  Json result = Json::object();
  for (const auto& [axis, value] : axes) {
    invariant(std::isfinite(value), "a probed position is finite");
    result[std::string(1, axis)] = value;
  }
  return result;
}

}  // namespace

std::string_view to_string(RunOutcome value) {
  return kOutcomes.at(static_cast<std::size_t>(value));
}

std::string encode(const RunStartText& value) {
  Json json{{"program", value.program}, {"revision", value.revision}, {"control", value.control}};
  if (!value.setup.empty()) json["setup"] = value.setup;
  return dump(json);
}

std::string encode(const RunEndText& value) {
  Json json{{"outcome", std::string(to_string(value.outcome))},
            {"sent", value.sent},
            {"accepted", value.accepted},
            {"executed", value.executed},
            {"line", value.line},
            {"sequence", value.sequence},
            {"reason", value.reason},
            {"content_sha256", value.content_sha256},
            {"content_length", value.content_length}};
  if (value.motion_seconds) json["motion_seconds"] = finite(*value.motion_seconds);
  if (value.path_mm) json["path_mm"] = finite(*value.path_mm);
  return dump(json);
}

std::string encode(const AlarmText& value) {
  return dump({{"code", value.code}, {"text", value.text}});
}

std::string encode(const ProbeText& value) {
  return dump({{"to", axes_object(value.to)},
               {"until", value.until},
               {"tripped", value.tripped},
               {"at", axes_object(value.at)}});
}

Result<RunStartText> decode_run_start(std::string_view text) {
  auto json = parse_object(text);
  if (!json) return fail(json.error());
  Members members(*json);
  RunStartText value{members.text("program"), members.text("revision"), members.text("control")};
  if (!is_digest(value.revision)) members.blame("revision");
  if (json->contains("setup")) {
    value.setup = members.text("setup");
    if (!is_digest(value.setup)) members.blame("setup");
  }
  return members.finish(std::move(value), "run start");
}

Result<RunEndText> decode_run_end(std::string_view text) {
  auto json = parse_object(text);
  if (!json) return fail(json.error());
  Members members(*json);
  RunEndText value;
  const std::string outcome = members.text("outcome");
  const auto* found = std::find(kOutcomes.begin(), kOutcomes.end(), outcome);
  if (found == kOutcomes.end()) {
    members.blame("outcome");
  } else {
    value.outcome = static_cast<RunOutcome>(found - kOutcomes.begin());
  }
  value.sent = members.count("sent");
  value.accepted = members.count("accepted");
  value.executed = members.count("executed");
  value.line = members.count("line");
  value.sequence = members.integer("sequence");
  value.reason = members.text("reason");
  value.content_sha256 = members.text("content_sha256");
  value.content_length = members.count("content_length");
  if (!value.content_sha256.empty() && !is_digest(value.content_sha256)) {
    members.blame("content_sha256");
  }
  if (json->contains("motion_seconds")) value.motion_seconds = members.amount("motion_seconds");
  if (json->contains("path_mm")) value.path_mm = members.amount("path_mm");
  return members.finish(std::move(value), "run end");
}

Result<AlarmText> decode_alarm(std::string_view text) {
  auto json = parse_object(text);
  if (!json) return fail(json.error());
  Members members(*json);
  AlarmText value{members.text("code"), members.text("text")};
  return members.finish(std::move(value), "alarm");
}

Result<ProbeText> decode_probe(std::string_view text) {
  auto json = parse_object(text);
  if (!json) return fail(json.error());
  Members members(*json);
  ProbeText value;
  value.to = members.axes("to");
  value.until = members.text("until");
  value.tripped = members.flag("tripped");
  value.at = members.axes("at");
  if (value.until != "contact" && value.until != "release") members.blame("until");
  return members.finish(std::move(value), "probe");
}

}  // namespace dripline::dds
