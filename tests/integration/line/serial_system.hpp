#pragma once

#include <gtest/gtest.h>
#include <algorithm>

#include "protocol/base/digest.hpp"
#include "tests/integration/line/line_gateway.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {

/// A server, the gateway beside a control (`--motion line:`), and the control at the other end of
/// its line, played by a gateway of its own.
class SerialSystem {
 public:
  struct Options {
    std::vector<std::string> settings;  ///< of the line, at both ends
    std::string request = {};           ///< what the control asks for; empty: the host begins
    bool is_unattended = true;
    std::vector<std::string> gateway_arguments = {};
    std::string control_speed = "max";
    std::string line = "115200n81";
    std::vector<std::string> control_arguments = {};
    std::string idle_end_ms = "300";  ///< silence that ends a text, at both ends
  };
  explicit SerialSystem(Options options) : options_(std::move(options)) {
    options_.settings.insert(options_.settings.end(),
                             {"line=" + options_.line, "idle_end_ms=" + options_.idle_end_ms,
                              "rest_gap_ms=" + options_.idle_end_ms});
    std::vector<std::string> arguments{"--motion", "line:" + cable.host(), "--line-template",
                                       "centurion"};
    for (const std::string& setting : options_.settings)
      arguments.insert(arguments.end(), {"--line-setting", setting});
    if (options_.is_unattended) arguments.insert(arguments.end(), {"--unattended", "yes"});
    arguments.insert(arguments.end(), options_.gateway_arguments.begin(),
                     options_.gateway_arguments.end());
    system.emplace(System::Options{
        .speed = "1x", .server_arguments = {}, .gateway_arguments = std::move(arguments)});
    system->start_server();
    start_gateway();
    if (options_.request.empty()) switch_on();
  }
  void start_gateway() {
    system->start_gateway();
    system->wait_connected();
    EXPECT_TRUE(test_support::eventually([&] {
      return message().find("is not open") == std::string::npos;
    })) << message();
  }
  void switch_on() {
    std::vector<std::string> arguments = options_.control_arguments;
    if (!options_.request.empty())
      arguments.insert(arguments.end(), {"--line-request", options_.request});
    control.emplace(LineGateway::Options{.address = cable.control(),
                                         .settings = options_.settings,
                                         .speed = options_.control_speed,
                                         .arguments = std::move(arguments)});
  }
  std::string start(const std::string& name, const std::string& text) {
    system->push(name, text);
    std::string id = system->start_run(name);
    // Its operator asks when the host is ready, as at the real ones: a DC1 comes only once.
    if (!control) switch_on();
    return id;
  }
  nlohmann::json status() const {
    const auto status = system->rest().get("/api/v1/machines/lathe-1").json()["status"];
    return status.is_object() ? status : nlohmann::json::object();
  }
  std::string message() const {
    const auto message = status()["message"];
    return message.is_string() ? message.get<std::string>() : std::string();
  }
  test_support::Finished panel(const std::vector<std::string>& words) {
    std::vector<std::string> command{program_path("dncgw"), "panel", "--state",
                                     system->folder() / "gateway" / "lathe-1"};
    command.insert(command.end(), words.begin(), words.end());
    return test_support::run_to_end(command, system->folder() / "panel.out");
  }
  /// What the control got of a program is the program's beginning, byte for byte. Its length.
  std::uint64_t check_received(const std::string& text) {
    const auto endings = control->endings();
    EXPECT_EQ(endings.size(), 1U);
    if (endings.empty()) return 0;
    const auto held = std::string_view(text).substr(0, endings[0].content_length);
    EXPECT_EQ(endings[0].content_sha256, sha256(held).hex());
    return endings[0].content_length;
  }

  test_support::PtyCable cable;
  std::optional<System> system;
  std::optional<LineGateway> control;

 private:
  Options options_;
};

inline std::string contour(std::uint64_t bytes) {
  std::string text;
  test_support::write_contour_of_size(bytes, [&](std::string_view piece) { text += piece; });
  return text;
}

/// A program that prints ten lines while it runs.
inline std::string printing_program(std::vector<std::string>& lines) {
  std::string text = "O0077\nG20 G98\nPOPEN P1\n";
  for (int i = 1; i <= 60; ++i) {
    text += "G1 X1. Z-." + std::to_string(i % 9 + 1) + " F50.\n";
    if (i % 6 != 0) continue;
    text += "DPRNT [FLANGE " + std::to_string(i) + "]\n";
    lines.push_back("FLANGE " + std::to_string(i));
  }
  return text + "PCLOS\nM30\n";
}

/// `text` without its end, then `program` without its number.
inline std::string ended_by(const std::string& text, const std::string& program) {
  return text.substr(0, text.rfind('M')) + program.substr(program.find('\n') + 1);
}

}  // namespace dripline::integration
