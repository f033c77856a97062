#include "server/api/bodies/json_object.hpp"

#include <cmath>
#include <map>
#include <set>

namespace dripline::api {
namespace {

/// Counts brackets outside strings; the parser reports a text that is not JSON.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_in_string) {
      if (c == '\\') ++i;
      if (c == '"') is_in_string = false;
    } else if (c == '"') {
      is_in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > JsonObject::kMaxDepth) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace

Result<JsonObject> JsonObject::parse(std::string_view text) {
  if (text.size() > kMaxBytes) {
    return fail(Errc::LimitExceeded, "a JSON body of {} bytes: at most {}", text.size(), kMaxBytes);
  }
  if (is_too_deep(text)) {
    return fail(Errc::Syntax, "the body is JSON nested deeper than {} levels", kMaxDepth);
  }
  using Json = nlohmann::json;
  std::map<int, std::set<std::string>> names;  // of the open objects, by depth
  std::string doubled;
  const auto look_for_doubled = [&](int depth, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) names[depth + 1].clear();
    if (event == Json::parse_event_t::key &&
        !names[depth].insert(value.get<std::string>()).second) {
      doubled = value.get<std::string>();
    }
    return true;
  };
  Json json;
  try {
    json = Json::parse(text.begin(), text.end(), look_for_doubled);
  } catch (const Json::exception& e) {
    const auto* at = dynamic_cast<const Json::parse_error*>(&e);
    return fail(Errc::Syntax, "the body is not JSON, at byte {}", at == nullptr ? 0 : at->byte);
  }
  if (!json.is_object()) return fail(Errc::Syntax, "the body must be a JSON object");
  if (!doubled.empty()) return fail(Errc::Syntax, "member '{}' is given twice", doubled);
  return JsonObject(std::move(json));
}

void JsonObject::complain(Errc code, std::string what) {
  if (!error_) error_ = Error{code, std::move(what)};
}

std::optional<nlohmann::json> JsonObject::take(const std::string& name) {
  const auto found = members_.find(name);
  if (found == members_.end()) return std::nullopt;
  nlohmann::json value = std::move(*found);
  members_.erase(found);
  if (value.is_null()) return std::nullopt;
  return value;
}

std::string JsonObject::required_text(const std::string& name, std::size_t longest) {
  auto text = optional_text(name, longest);
  if (!text) complain(Errc::Syntax, fmt::format("member '{}' is missing: a string", name));
  return text.value_or(std::string());
}

std::optional<std::string> JsonObject::optional_text(const std::string& name, std::size_t longest) {
  const auto value = take(name);
  if (!value) return std::nullopt;
  if (!value->is_string()) {
    complain(Errc::Syntax, fmt::format("member '{}' must be a string", name));
    return std::nullopt;
  }
  return checked_text(name, value->get<std::string>(), longest);
}

std::string JsonObject::checked_text(const std::string& name, std::string text,
                                     std::size_t longest) {
  if (text.size() > longest) {
    complain(Errc::LimitExceeded,
             fmt::format("member '{}' has {} bytes: at most {}", name, text.size(), longest));
  }
  if (text.find('\0') != std::string::npos) {
    complain(Errc::Syntax, fmt::format("member '{}' contains NUL", name));
  }
  return text;
}

std::optional<std::uint64_t> JsonObject::optional_unsigned(const std::string& name) {
  const auto value = take(name);
  if (!value) return std::nullopt;
  if (!value->is_number_unsigned()) {
    complain(Errc::Syntax, fmt::format("member '{}' must be a whole number, 0 or more", name));
    return std::nullopt;
  }
  return value->get<std::uint64_t>();
}

std::optional<double> JsonObject::optional_number(const std::string& name) {
  const auto value = take(name);
  if (!value) return std::nullopt;
  if (!value->is_number() || !std::isfinite(value->get<double>())) {
    complain(Errc::Syntax, fmt::format("member '{}' must be a number", name));
    return std::nullopt;
  }
  return value->get<double>();
}

std::optional<bool> JsonObject::optional_flag(const std::string& name) {
  const auto value = take(name);
  if (!value) return std::nullopt;
  if (!value->is_boolean()) {
    complain(Errc::Syntax, fmt::format("member '{}' must be true or false", name));
    return std::nullopt;
  }
  return value->get<bool>();
}

std::vector<std::string> JsonObject::optional_texts(const std::string& name, std::size_t longest,
                                                    std::size_t most) {
  std::vector<std::string> texts;
  const auto value = take(name);
  if (!value) return texts;
  if (!value->is_array()) {
    complain(Errc::Syntax, fmt::format("member '{}' must be a list", name));
    return texts;
  }
  if (value->size() > most) {
    complain(Errc::LimitExceeded,
             fmt::format("member '{}' has {} items: at most {}", name, value->size(), most));
    return texts;
  }
  for (const auto& item : *value) {
    if (!item.is_string()) {
      complain(Errc::Syntax, fmt::format("member '{}' must be a list of strings", name));
      break;
    }
    texts.push_back(checked_text(name, item.get<std::string>(), longest));
  }
  return texts;
}

std::vector<std::pair<std::string, std::string>> JsonObject::optional_scalars(
    const std::string& name, std::size_t longest) {
  std::vector<std::pair<std::string, std::string>> scalars;
  const auto value = take(name);
  if (!value) return scalars;
  if (!value->is_object()) {
    complain(Errc::Syntax, fmt::format("member '{}' must be an object", name));
    return scalars;
  }
  for (const auto& [key, item] : value->items()) {
    const std::string path = name + "." + checked_text(name, key, longest);
    if (item.is_string()) {
      scalars.emplace_back(key, checked_text(path, item.get<std::string>(), longest));
    } else if (item.is_number_integer() || item.is_boolean()) {
      scalars.emplace_back(key, item.dump());
    } else {
      complain(Errc::Syntax,
               fmt::format("member '{}' must be a string, a whole number, true or false", path));
    }
  }
  return scalars;
}

Result<void> JsonObject::finish() {
  if (error_) return fail(*error_);
  if (members_.empty()) return {};
  return fail(Errc::Syntax, "member '{}' is not known here", members_.begin().key());
}

}  // namespace dripline::api
