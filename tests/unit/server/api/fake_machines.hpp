#pragma once

#include <algorithm>
#include <vector>

#include "server/machines/machine_control.hpp"
#include "server/ports/port_control.hpp"

namespace dripline::server_test {

/// Machines that a test lists, and commands that are only noted.
class FakeMachines final : public machines::MachineControl {
 public:
  std::vector<machines::MachineView> machines() const override { return views; }
  Result<machines::MachineView> machine(const std::string& name) const override {
    for (const auto& view : views) {
      if (view.machine.name == name) return view;
    }
    return fail(Errc::NotFound, "machine '{}' is not known", name);
  }
  Result<storage::Run> start(const machines::StartRequest& request) override {
    started.push_back(request);
    if (refusal) return fail(*refusal);
    if (auto view = machine(request.machine); !view) return fail(view.error());
    if (request.before) {
      if (auto ready = request.before(run); !ready) return fail(ready.error());
    }
    ++sent;
    if (request.on_notice && !notice.empty()) request.on_notice(notice);
    return run;
  }
  Result<void> command(const machines::CommandRequest& request) override {
    commands.push_back(request);
    if (refusal) return fail(*refusal);
    return {};
  }
  Result<std::string> values(const machines::ValueQuery& query) override {
    asked.push_back(query);
    if (refusal) return fail(*refusal);
    if (auto view = machine(query.machine); !view) return fail(view.error());
    return answer;
  }

  Result<machines::PositionAnswer> position(const machines::PositionRequest& request) override {
    positions.push_back(request);
    if (refusal) return fail(*refusal);
    if (auto view = machine(request.machine); !view) return fail(view.error());
    if (request.is_playback) return machines::PositionAnswer{"", "L X+1.000 Y-2.500 R0"};
    return machines::PositionAnswer{"set-1", "G54.X is 87.5, it was 100", details};
  }

  Result<machines::JogAnswer> jog(const machines::JogRequest& request) override {
    jogs.push_back(request);
    if (refusal) return fail(*refusal);
    if (auto view = machine(request.machine); !view) return fail(view.error());
    return machines::JogAnswer{
        "X 12.5 mm", R"({"axis":"X","position":12.5,"moved":-1.5,"unit":"mm","reached":true})"};
  }

  Result<std::string> confirm_gateway(const std::string& name) override {
    confirmed.push_back(name);
    if (refusal) return fail(*refusal);
    return "gateway 0.1.0";
  }

  Result<void> remove(const std::string& name, const storage::Actor&) override {
    removed.push_back(name);
    if (refusal) return fail(*refusal);
    return {};
  }

  std::vector<machines::MachineView> views;
  std::vector<std::string> removed;
  std::vector<std::string> confirmed;  ///< machines whose other gateway is theirs
  std::vector<machines::PositionRequest> positions;
  std::vector<machines::JogRequest> jogs;
  std::vector<machines::ValueQuery> asked;
  std::string answer =
      R"({"values":[{"name":"P10","value":7.5},{"name":"P11","value":null}],"next":null,)"
      R"("outputs":[{"axis":"X","output":3,"on":true}],"codes":[21]})";
  std::string details =
      R"({"cells":[{"name":"G54.X","before":null,"value":87.5,"unit":"mm"}],"length":2.5,)"
      R"("zero":null})";
  std::string notice;
  int sent = 0;  ///< starts that went to a machine
  std::vector<machines::StartRequest> started;
  std::vector<machines::CommandRequest> commands;
  std::optional<Error> refusal;
  storage::Run run;
};

/// Ports that a test fills; nothing is opened.
class FakePorts final : public ports::PortControl {
 public:
  std::vector<ports::PortView> ports() const override { return views; }
  Result<ports::PortView> port(const std::string& name) const override {
    const auto found = std::ranges::find_if(
        views, [&](const ports::PortView& view) { return view.port.name == name; });
    if (found == views.end()) return fail(Errc::NotFound, "port '{}' is not known", name);
    return *found;
  }
  Result<ports::PortView> save(const storage::Port& port) override {
    if (refusal) return fail(*refusal);
    std::erase_if(views, [&](const auto& view) { return view.port.name == port.name; });
    ports::PortView view;
    view.port = port;
    for (const auto& [key, value] : port.settings) {
      if (auto set = wire::set_value(view.settings, key, value); !set) return fail(set.error());
    }
    views.push_back(view);
    return view;
  }
  Result<void> remove(const std::string& name) override {
    if (refusal) return fail(*refusal);
    if (auto known = port(name); !known) return fail(known.error());
    std::erase_if(views, [&](const auto& view) { return view.port.name == name; });
    return {};
  }
  Result<ports::PortTest> test(const std::string& name) override {
    if (auto known = port(name); !known) return fail(known.error());
    return ports::PortTest{false, {"CTS is off: is the cable plugged in?"}};
  }
  Result<ports::PortTransfer> send(const std::string& name,
                                   const std::vector<ports::ProgramChoice>& programs) override {
    if (refusal) return fail(*refusal);
    if (auto known = port(name); !known) return fail(known.error());
    ports::PortTransfer transfer{.id = "transfer-1", .size = 100};
    for (const auto& choice : programs) {
      transfer.programs.push_back(
          fmt::format("{} revision {}", choice.program, choice.revision.value_or(1)));
    }
    return transfer;
  }
  Result<void> receive(const std::string& name) override {
    if (refusal) return fail(*refusal);
    if (auto known = port(name); !known) return fail(known.error());
    return {};
  }
  Result<std::string> confirm_reset(const std::string& name) override {
    if (refusal) return fail(*refusal);
    if (auto known = port(name); !known) return fail(known.error());
    return "run r1 of program O1";
  }
  Result<void> stop_transfer(const std::string& name, const std::string& reason) override {
    if (refusal) return fail(*refusal);
    if (auto known = port(name); !known) return fail(known.error());
    stop_reason = reason;
    return {};
  }
  Result<ports::RuleVerdict> test_rules(const std::string& name,
                                        const std::string& text) const override {
    if (auto known = port(name); !known) return fail(known.error());
    tested_text = text;
    return ports::RuleVerdict{"ask", "send", "O1234", {"ask: PRG=1234 fits (PRG=*)"}};
  }
  Result<std::vector<ports::PortTraffic>> recording(const std::string& name) const override {
    if (auto known = port(name); !known) return fail(known.error());
    return traffic;
  }
  void on_traffic(std::function<void(const ports::PortTraffic&)> wanted) override {
    listener = std::move(wanted);
  }

  std::vector<ports::PortView> views;
  std::vector<ports::PortTraffic> traffic;
  std::function<void(const ports::PortTraffic&)> listener;
  std::optional<Error> refusal;
  std::string stop_reason;
  mutable std::string tested_text;
};

}  // namespace dripline::server_test
