#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "protocol/dds/message.hpp"
#include "server/ports/requests/requested_line.hpp"
#include "server/ports/strand.hpp"

namespace dripline::ports {

/// Asks a gateway about its line and waits: MachineService::ask_line.
using AskLine = std::function<Result<dds::LineData>(dds::LineRequest, std::chrono::milliseconds)>;
/// For an answer that a gateway has at hand.
inline constexpr std::chrono::milliseconds kAnswerLimit{5000};

/// Answers to a control at a gateway's own line, over DDS. What is answered belongs to the call
/// that is handled. On one strand.
class GatewayAtControl final : public RequestedLine,
                               public std::enable_shared_from_this<GatewayAtControl> {
 public:
  GatewayAtControl(std::string machine, AskLine ask, machines::MachineControl& machines,
                   Strand strand, std::function<Result<void>()> check_reset)
      : machine_(std::move(machine)),
        ask_(std::move(ask)),
        machines_(machines),
        strand_(std::move(strand)),
        check_reset_(std::move(check_reset)) {}

  void begin(std::uint64_t call) { call_ = call; }

  void note(const std::string& words) override;
  void refuse(const std::string& why) override { tell(dds::LineAction::Refuse, "", why); }
  bool is_asked() const override;
  Result<void> check_reset() const override { return check_reset_(); }
  void accept_receive(const std::string&) override {}  // the gateway takes it by itself
  void send(SendJob job) override;
  void start_later(const machines::StartRequest& request, Started started,
                   const std::string& wire_name) override;

 private:
  void tell(dds::LineAction action, const std::string& name, const std::string& text);

  const std::string machine_;
  const AskLine ask_;
  machines::MachineControl& machines_;
  const Strand strand_;
  const std::function<Result<void>()> check_reset_;
  std::uint64_t call_ = 0;
};

}  // namespace dripline::ports
