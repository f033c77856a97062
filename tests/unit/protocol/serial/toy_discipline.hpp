#pragma once

#include <deque>

#include "protocol/wire/discipline.hpp"

namespace dripline::serial {

/// A plain line with XON/XOFF and nothing else: characters out as they are offered, characters in
/// as text. For tests of what runs disciplines.
class ToyDiscipline final : public wire::Discipline {
 public:
  static constexpr std::size_t kBuffer = 4096;
  static constexpr char kXon = 0x11, kXoff = 0x13;

  void receive(std::span<const std::byte> bytes, wire::LineTime now) override;
  void fault(wire::LineFault fault, wire::LineTime now) override;
  void lines(wire::InputLines lines, wire::LineTime now) override;
  void tick(wire::LineTime) override {}
  std::size_t transmit(std::span<std::byte> room, wire::LineTime now) override;
  wire::OutputLines output_lines() const override { return {.rts = is_ready_, .dtr = true}; }
  std::optional<wire::LineTime> deadline() const override { return std::nullopt; }

  Result<void> begin_send(std::string_view name, wire::LineTime now) override;
  std::size_t room() const override { return kBuffer - text_.size(); }
  Result<void> offer(std::string_view text, bool is_last, wire::LineTime now) override;
  Result<void> begin_receive(std::string_view name, wire::LineTime now) override;
  Result<void> request(const wire::TransferRequest&, wire::LineTime) override { return {}; }
  Result<void> refuse(std::string_view, wire::LineTime) override { return {}; }
  void set_ready(bool is_ready, wire::LineTime) override { is_ready_ = is_ready; }
  void abort(wire::LineTime now) override;
  wire::LineState state() const override;
  std::vector<wire::Event> take_events() override { return std::exchange(events_, {}); }

 private:
  wire::Phase phase_ = wire::Phase::Idle;
  std::deque<char> text_;
  bool has_last_ = false, is_stopped_ = false, is_ready_ = true, cts_ = true;
  std::vector<wire::Event> events_;
};

}  // namespace dripline::serial
