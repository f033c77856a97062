#include "clients/lib/api_json.hpp"

#include <concepts>

#include "clients/lib/impl/api_members.hpp"

namespace dripline::client {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

template <class T>
constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;

template <class T>
constexpr bool kIsMap = false;
template <class T>
constexpr bool kIsMap<std::map<std::string, T>> = true;
template <class T>
constexpr bool kIsList = false;
template <class T>
constexpr bool kIsList<std::vector<T>> = true;

class Reader {
 public:
  explicit Reader(const Json& object) : object_(object) {}

  template <class T>
  void operator()(const char* key, T& field) {
    const auto found = object_.find(key);
    const bool is_absent = found == object_.end() || found->is_null();
    if constexpr (kIsOptional<T>) {
      if (is_absent) return;
      typename T::value_type value{};
      read(key, *found, value);
      field = std::move(value);
    } else if constexpr (std::same_as<T, std::string>) {
      if (!is_absent) read(key, *found, field);
    } else if (is_absent) {
      complain(key, "is missing");
    } else {
      read(key, *found, field);
    }
  }
  void flag(const char* key, bool& field) { later(key, field); }
  /// A member that older servers do not send.
  template <class T>
  void later(const char* key, T& field) {
    if (object_.contains(key)) (*this)(key, field);
  }

  const std::string& error() const { return error_; }

 private:
  void complain(const char* key, std::string_view what) {
    if (error_.empty()) error_ = fmt::format("member \"{}\" {}", key, what);
  }
  void read(const char* key, const Json& json, std::string& field) {
    json.is_string() ? void(field = json.get<std::string>()) : complain(key, "is not a text");
  }
  void read(const char* key, const Json& json, bool& field) {
    json.is_boolean() ? void(field = json.get<bool>()) : complain(key, "is not true or false");
  }
  void read(const char* key, const Json& json, double& field) {
    json.is_number() ? void(field = json.get<double>()) : complain(key, "is not a number");
  }
  void read(const char* key, const Json& json, std::uint64_t& field) {
    const bool is_whole =
        json.is_number_unsigned() || (json.is_number_integer() && json.get<std::int64_t>() >= 0);
    is_whole ? void(field = json.get<std::uint64_t>())
             : complain(key, "is not a whole number >= 0");
  }
  void read(const char* key, const Json& json, std::int64_t& field) {
    json.is_number_integer() ? void(field = json.get<std::int64_t>())
                             : complain(key, "is not a whole number");
  }
  template <class T>
  void read(const char* key, const Json& json, std::map<std::string, T>& field) {
    if (!json.is_object()) return complain(key, "is not an object");
    for (const auto& [name, value] : json.items()) read(key, value, field[name]);
  }
  template <class T>
  void read(const char* key, const Json& json, std::vector<T>& field) {
    if (!json.is_array()) return complain(key, "is not a list");
    for (const auto& item : json) read(key, item, field.emplace_back());
  }
  template <class T>
  void read(const char* key, const Json& json, T& field) {
    if (!json.is_object()) return complain(key, "is not an object");
    Reader inner(json);
    members(inner, field);
    if (!inner.error().empty() && error_.empty()) error_ = inner.error() + " of \"" + key + "\"";
  }

  const Json& object_;
  std::string error_;
};

class Writer {
 public:
  template <class T>
  void operator()(const char* key, const T& field) {
    if constexpr (kIsOptional<T>) {
      if (field) {
        (*this)(key, *field);
      } else {
        object_[key] = nullptr;
      }
    } else if constexpr (std::same_as<T, std::string>) {
      object_[key] = field.empty() ? OrderedJson(nullptr) : OrderedJson(field);
    } else if constexpr (std::same_as<T, std::vector<std::string>> ||
                         std::same_as<T, std::vector<std::int64_t>> ||
                         (requires { OrderedJson(field); } && !std::is_class_v<T>)) {
      object_[key] = field;
    } else if constexpr (kIsMap<T>) {
      object_[key] = OrderedJson::object();
      for (const auto& [name, value] : field) object_[key][name] = value;
    } else if constexpr (kIsList<T>) {
      object_[key] = OrderedJson::array();
      for (const auto& item : field) {
        Writer inner;
        members(inner, item);
        object_[key].push_back(std::move(inner.object_));
      }
    } else {
      Writer inner;
      members(inner, field);
      object_[key] = std::move(inner.object_);
    }
  }
  void flag(const char* key, bool field) {
    if (field) object_[key] = true;
  }
  template <class T>
  void later(const char* key, const T& field) {
    (*this)(key, field);
  }
  OrderedJson take() { return std::move(object_); }

 private:
  OrderedJson object_ = OrderedJson::object();
};

template <class T>
Result<T> read_object(const Json& json) {
  if (!json.is_object()) return fail(Errc::Syntax, "not a JSON object");
  T value{};
  Reader reader(json);
  members(reader, value);
  if (!reader.error().empty()) return fail(Errc::Syntax, "{}", reader.error());
  return value;
}

}  // namespace

template <class T>
Result<T> from_json(const Json& json) {
  return read_object<T>(json);
}

/// In a history, "revisions" is the list instead of its length.
template <>
Result<ProgramHistory> from_json(const Json& json) {
  if (!json.is_object()) return fail(Errc::Syntax, "not a JSON object");
  const auto list = json.find("revisions");
  if (list == json.end() || !list->is_array()) {
    return fail(Errc::Syntax, "member \"revisions\" is not a list");
  }
  Json latest = json;
  latest["revisions"] = list->size();
  auto program = read_object<Program>(latest);
  if (!program) return fail(program.error());
  ProgramHistory history{std::move(*program), {}};
  for (const auto& item : *list) {
    auto revision = read_object<Revision>(item);
    if (!revision) return fail(revision.error());
    history.revisions.push_back(std::move(*revision));
  }
  return history;
}

template <class T>
OrderedJson to_json_value(const T& value) {
  Writer writer;
  members(writer, value);
  return writer.take();
}

template <>
OrderedJson to_json_value(const ProgramHistory& history) {
  auto json = to_json_value(history.program);
  json["revisions"] = OrderedJson::array();
  for (const auto& revision : history.revisions) {
    json["revisions"].push_back(to_json_value(revision));
  }
  return json;
}

#define DRIPLINE_API_TYPE(T)                    \
  template Result<T> from_json<T>(const Json&); \
  template OrderedJson to_json_value<T>(const T&)
DRIPLINE_API_TYPE(ServerInfo);
DRIPLINE_API_TYPE(ServerInfo::Sharing);
DRIPLINE_API_TYPE(AuditState);
DRIPLINE_API_TYPE(Backups);
DRIPLINE_API_TYPE(Program);
DRIPLINE_API_TYPE(Revision);
DRIPLINE_API_TYPE(RevisionStates);
DRIPLINE_API_TYPE(Closure);
DRIPLINE_API_TYPE(Attachment);
DRIPLINE_API_TYPE(SearchResult);
DRIPLINE_API_TYPE(Job);
DRIPLINE_API_TYPE(JobList);
DRIPLINE_API_TYPE(Webhook);
DRIPLINE_API_TYPE(WebhookTest);
DRIPLINE_API_TYPE(Folder);
DRIPLINE_API_TYPE(FolderFile);
DRIPLINE_API_TYPE(Import);
DRIPLINE_API_TYPE(Upload);
DRIPLINE_API_TYPE(MachineStatus);
DRIPLINE_API_TYPE(Machine);
DRIPLINE_API_TYPE(Run);
DRIPLINE_API_TYPE(BegunRun);
DRIPLINE_API_TYPE(ShownRun);
DRIPLINE_API_TYPE(Setup);
DRIPLINE_API_TYPE(LoadedSetup);
DRIPLINE_API_TYPE(Memory);
DRIPLINE_API_TYPE(JogDone);
DRIPLINE_API_TYPE(PlaybackBlock);
DRIPLINE_API_TYPE(PositionSet);
DRIPLINE_API_TYPE(ControlValues);
DRIPLINE_API_TYPE(Record);
DRIPLINE_API_TYPE(Report);
DRIPLINE_API_TYPE(MachineReport);
DRIPLINE_API_TYPE(Transfer);
DRIPLINE_API_TYPE(Port);
DRIPLINE_API_TYPE(Traffic);
DRIPLINE_API_TYPE(PortTest);
DRIPLINE_API_TYPE(RuleVerdict);
DRIPLINE_API_TYPE(PortTemplates);
DRIPLINE_API_TYPE(Session);
DRIPLINE_API_TYPE(User);
DRIPLINE_API_TYPE(Token);
DRIPLINE_API_TYPE(MachineGroup);
#undef DRIPLINE_API_TYPE

Result<Json> parse_json(std::string_view text) {
  auto json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return fail(Errc::Syntax, "not JSON");
  return json;
}

}  // namespace dripline::client
