#pragma once

#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "protocol/dds/record_text.hpp"
#include "server/mtconnect/agent.hpp"
#include "tests/support/manual_clock.hpp"

namespace dripline::mtconnect_test {

inline constexpr std::uint16_t kXZ = 0b101;
inline constexpr std::uint16_t kXYZC = 0b100111;

/// An agent with machines that a test plays.
class AgentTest : public testing::Test {
 protected:
  using Record = storage::Record;

  AgentTest() { restart(); }

  void restart(mtconnect::Agent::Options options = {}) {
    options.sender = "shop";
    options.plant = "plant";
    options.instance = 77;
    agent_ = std::make_unique<mtconnect::Agent>(std::move(options), clock_);
  }

  machines::MachineView view(const std::string& name, std::uint16_t axes = kXZ) const {
    machines::MachineView view;
    view.machine.name = name;
    view.machine.control = "centurion";
    view.is_connected = true;
    view.status.emplace();
    view.status.edit().machine = name;
    view.status.edit().axes = axes;
    view.status.edit().time = clock_.now();
    return view;
  }
  void observe(const machines::MachineView& view) { agent_->observer().observe(view); }
  void add(const std::string& name, std::uint16_t axes = kXZ) { observe(view(name, axes)); }
  Record record(const std::string& kind, const std::string& text) const {
    Record record;
    record.machine = "lathe-1";
    record.kind = kind;
    record.text = text;
    record.time = clock_.now();
    return record;
  }
  void report(const std::string& kind, const std::string& text) {
    agent_->observer().observe(record(kind, text));
  }
  void alarm(const std::string& code, const std::string& text) {
    report("alarm", dds::encode(dds::AlarmText{code, text}));
  }

  api::Response ask(const std::string& target, const std::string& method = "GET") {
    api::Request request;
    request.method = method;
    auto parsed = api::parse_target(target);
    EXPECT_TRUE(parsed) << target;
    if (parsed) request.target = *std::move(parsed);
    return agent_->handle(request);
  }
  /// The document of an answer, however it is sent.
  static std::string text_of(const api::Response& response) {
    std::string text = response.body;
    while (response.source) {
      auto piece = response.source();
      if (!piece || !*piece) break;
      text += **piece;
    }
    return text;
  }
  std::string get(const std::string& target) {
    const auto response = ask(target);
    EXPECT_EQ(response.status, 200) << target << ": " << response.body;
    return text_of(response);
  }
  /// The value of the first element that has this data item; "-": there is none.
  static std::string value(const std::string& xml, const std::string& item) {
    const auto at = xml.find("dataItemId=\"" + item + "\"");
    if (at == std::string::npos) return "-";
    const auto begin = xml.find('>', at);
    if (xml[begin - 1] == '/') return "";
    return xml.substr(begin + 1, xml.find('<', begin) - begin - 1);
  }
  static std::string attribute(const std::string& xml, const std::string& name) {
    const auto at = xml.find(" " + name + "=\"");
    if (at == std::string::npos) return "-";
    const auto begin = at + name.size() + 3;
    return xml.substr(begin, xml.find('"', begin) - begin);
  }
  static std::size_t count(const std::string& xml, const std::string& part) {
    std::size_t n = 0;
    for (auto at = xml.find(part); at != std::string::npos; at = xml.find(part, at + 1)) ++n;
    return n;
  }

  test_support::ManualClock clock_;
  std::unique_ptr<mtconnect::Agent> agent_;
};

}  // namespace dripline::mtconnect_test
