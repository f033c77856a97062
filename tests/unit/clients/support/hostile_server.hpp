#pragma once

#include <memory>
#include <string>

namespace dripline::test_support {

/// A server in this process that answers every call as the API's description (openapi.json) has it,
/// and each of whose texts would steer a terminal: names, messages, programs, reports.
class HostileServer {
 public:
  enum class Answers { Good, Errors };
  HostileServer(const std::string& openapi_path, Answers answers);
  ~HostileServer();
  std::string url() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Begins with kEvil, which what is printed of it has still. No style of `dnc` is yellow.
inline constexpr const char* kEvil = "evil";
std::string hostile_text();

/// What in `text` can steer a terminal, by its place; empty: nothing. Lines and tabs cannot.
std::string steering_text(const std::string& text);
/// `text` without the styles of `dnc`.
std::string without_styles(std::string text);

}  // namespace dripline::test_support
