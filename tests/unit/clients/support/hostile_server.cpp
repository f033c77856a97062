#include "tests/unit/clients/support/hostile_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

namespace dripline::test_support {
namespace {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

constexpr const char* kSteering[] = {"\x1b",   "\a",     "\b",     "\r",     "\x7f",
                                     "\u009b", "\u0085", "\u202e", "\u2066", "\u200f",
                                     "\u200e", "\u202a", "\u2069", "\u061c", "\x0e"};

/// A value as a schema of the document has it.
class Maker {
 public:
  explicit Maker(const json& document) : document_(document) {}

  json make(const json& schema) const {
    if (schema.contains("$ref")) {
      const auto path = schema["$ref"].get<std::string>().substr(1);
      return make(document_.at(json::json_pointer(path)));
    }
    if (schema.contains("allOf")) return merged(schema["allOf"]);
    if (schema.contains("enum")) return schema["enum"].front();
    const std::string type = schema.value("type", "string");
    if (type == "object") return object(schema);
    if (type == "array") return json(2, make(schema["items"]));  // the two ends of a range
    if (type == "boolean") return true;
    if (type == "integer" || type == "number") return std::max(1, schema.value("minimum", 1));
    return hostile_text();
  }

 private:
  json merged(const json& parts) const {
    json all;
    for (const json& part : parts) {
      json made = make(part);
      if (!made.is_object()) return made;
      all.update(made);
    }
    return all;
  }
  json object(const json& schema) const {
    json made = json::object();
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, member] : properties.items()) made[name] = make(member);
    const json others = schema.value("additionalProperties", json(false));
    if (others.is_object()) made[hostile_text()] = make(others);
    return made;
  }
  const json& document_;
};

/// Of a call that can be answered in several forms.
bool is_json(const Request& request, const json& contents) {
  const std::string format = request.get_param_value("format");
  return contents.contains("application/json") && (format.empty() || format == "json");
}

}  // namespace

std::string hostile_text() {
  std::string text = std::string(kEvil) + "\x1b[33m";
  for (const char* one : kSteering) text += one;
  return text + ".";
}

std::string steering_text(const std::string& text) {
  for (const char* one : kSteering) {
    const auto at = text.find(one);
    if (at != std::string::npos) return fmt::format("{:?} in {:?}", one, text.substr(0, at + 8));
  }
  return {};
}

std::string without_styles(std::string text) {
  for (const std::string style : {"0", "1", "2", "31", "32", "36"}) {
    const std::string sequence = "\x1b[" + style + "m";
    for (auto at = text.find(sequence); at != std::string::npos; at = text.find(sequence, at))
      text.erase(at, sequence.size());
  }
  return text;
}

class HostileServer::Impl {
 public:
  Impl(const std::string& openapi_path, Answers answers) : answers_(answers) {
    std::ifstream file(openapi_path);
    document_ = json::parse(file);
    for (const auto& [path, methods] : document_["paths"].items()) {
      for (const auto& [method, call] : methods.items()) add(path, method, call);
    }
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }
  ~Impl() {
    server_.stop();
    thread_.join();
  }
  int port() const { return port_; }

 private:
  void add(const std::string& path, const std::string& method, const json& call) {
    const std::string any = std::regex_replace(path, std::regex(R"(\{[^}]+\})"), "[^/]+");
    const auto answer = [this, &call](const Request& request, Response& response) {
      answers_ == Answers::Errors ? refuse(response) : give(call, request, response);
    };
    if (method == "get") server_.Get(any, answer);
    if (method == "put") server_.Put(any, answer);
    if (method == "post") server_.Post(any, answer);
    if (method == "delete") server_.Delete(any, answer);
  }
  static void refuse(Response& response) {
    response.status = 409;
    const json error{{"code", "conflict"}, {"message", hostile_text()}};
    response.set_content(json{{"error", error}}.dump(), "application/json");
  }
  void give(const json& call, const Request& request, Response& response) const {
    for (const auto& [status, described] : call["responses"].items()) {
      if (!status.starts_with('2')) continue;
      response.status = std::stoi(status);
      if (!described.contains("content")) return;
      const json& contents = described["content"];
      if (!is_json(request, contents))
        return response.set_content(hostile_text() + "\n", contents.items().begin().key());
      const json& schema = contents["application/json"]["schema"];
      return response.set_content(Maker(document_).make(schema).dump(), "application/json");
    }
  }

  const Answers answers_;
  json document_;
  httplib::Server server_;
  std::thread thread_;
  int port_ = 0;
};

HostileServer::HostileServer(const std::string& openapi_path, Answers answers)
    : impl_(std::make_unique<Impl>(openapi_path, answers)) {}
HostileServer::~HostileServer() = default;

std::string HostileServer::url() const {
  return fmt::format("http://127.0.0.1:{}", impl_->port());
}

}  // namespace dripline::test_support
