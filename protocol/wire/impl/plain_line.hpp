#pragma once

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/program_reader.hpp"
#include "protocol/wire/impl/program_writer.hpp"

namespace dripline::wire {

/// A line without checks: plain text with XON/XOFF, RTS/CTS, DC1 to DC4, or no flow control. Both
/// directions are independent: a control may answer (DPRNT) while it is fed, with DC1 to DC4
/// between its DC3 and DC1. A failed transfer ends both.
class PlainLine final : public DisciplineBase, private TextSink {
 public:
  PlainLine(const LineSettings& settings, Role role);

  void receive(std::span<const std::byte> bytes, LineTime now) override;
  void fault(LineFault fault, LineTime now) override;
  void lines(InputLines lines, LineTime now) override;
  void tick(LineTime now) override;
  std::size_t transmit(std::span<std::byte> room, LineTime now) override;
  std::optional<LineTime> deadline() const override;
  Result<void> begin_send(std::string_view name, LineTime now) override;
  Result<void> begin_receive(std::string_view name, LineTime now) override;
  Result<void> request(const TransferRequest& request, LineTime now) override;
  Result<void> refuse(std::string_view reason, LineTime now) override;
  void set_ready(bool is_ready, LineTime now) override;
  void abort(LineTime now) override;
  void expect_release() override { is_release_due_ = waits_for_dc1(); }
  LineState state() const override;

 private:
  // Properties of the line
  bool is_dc_codes() const { return settings_.flow == Flow::DcCodes; }
  bool is_softly_held() const { return settings_.flow == Flow::XonXoff || is_dc_codes(); }
  bool understands_dc1() const { return is_softly_held() || settings_.wait_for_xon; }
  /// Whether this is a host whose control requests programs.
  bool waits_for_dc1() const {
    return role_ == Role::Host && (is_dc_codes() || settings_.wait_for_xon);
  }
  void say(char dc);
  void drop_request();
  void start_reading();
  void stop_reading();

  // Sending
  bool may_send() const { return !is_stopped_ && (settings_.flow != Flow::RtsCts || input_.cts); }
  std::optional<LineTime> hold_deadline() const;
  std::optional<std::byte> next_character();
  void pause_after(std::size_t characters, bool ends_block, LineTime now);
  void skip_said();
  void finish_sending(LineTime now);
  void set_stopped(bool is_stopped, LineTime now);
  void note_hold(LineTime now);
  void held_too_long(LineTime now);

  // Receiving
  bool take_dc(char dc, LineTime now);
  void take_data(std::byte character, LineTime now);
  bool is_overrun(LineTime now);
  bool is_stray() const;
  void drop_stray();
  void punch_on(LineTime now);
  void punch_off(LineTime now);
  void hold_off();
  void open_reception(std::string name, LineTime now);
  void end_reception();
  void cut_reception();
  void close_reception();
  void fail_reception(Error error, LineTime now);
  std::optional<LineTime> silence_deadline() const;
  std::optional<std::chrono::milliseconds> pause_limit() const;
  void silent_too_long(LineTime now);

  // TextSink
  void text(std::string_view text) override { emit_text(text); }
  void report(Error error) override { emit_fault(std::move(error)); }
  void next_program(std::string name) override;

  // DisciplineBase
  Result<void> check_text(std::string_view text, std::size_t first_line) override;
  void text_offered(LineTime) override {}
  void transfer_over(LineTime now) override;

  ProgramWriter writer_;
  ProgramReader reader_;
  LineTime character_time_;

  bool is_stopped_;           ///< by DC3, or because no DC1 came yet
  bool has_started_ = false;  ///< a part of this transfer has left
  bool is_release_due_ =
      false;  ///< the control held us when a program was broken off: its DC1 will come
  std::size_t text_under_way_ = 0;  ///< characters of text in the writer
  std::optional<LineTime> held_since_, pause_until_;

  struct Inbound {
    bool is_open = false;
    bool is_punch = false;          ///< DC2 began it, DC4 ends it
    std::optional<LineTime> heard;  ///< the last significant character
  };
  Inbound inbound_;
  bool is_ready_ = true;
  bool is_stop_said_ =
      false;               ///< our DC3 has left, or RTS is off: characters are counted from here
  bool owes_dc1_ = false;  ///< a host that sent DC3 releases, even when no more text comes
  std::size_t after_stop_ = 0;
  std::optional<LineTime> release_again_;  ///< our DC1 may have been lost: it is repeated then
  bool is_asked_ = false;                  ///< the other end's request waits for an answer
};

}  // namespace dripline::wire
