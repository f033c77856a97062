#pragma once

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/tnc_frames.hpp"

namespace dripline::wire {

/// The TNC's standard interface, both ends: unchecked lines of text, with DC3 and DC1 or RTS as
/// flow control.
///
///     into the control: DC1 from it; blanks, lines, ETX from the host; EOT from it
///     out of it:        blanks, lines, ETX EOT; the host may hold it
///
/// Detectable errors are reported: parity, a program without its END line, a gap in the block
/// numbers of plain language.
class TncStandard final : public DisciplineBase {
 public:
  TncStandard(const LineSettings& settings, Role role)
      : DisciplineBase(settings, role), is_held_by_cts_(wire::is_held_by_cts(settings)) {}

  void receive(std::span<const std::byte> bytes, LineTime now) override;
  void fault(LineFault fault, LineTime now) override;
  void lines(InputLines lines, LineTime now) override;
  void tick(LineTime now) override;
  std::size_t transmit(std::span<std::byte> room, LineTime now) override;
  std::optional<LineTime> deadline() const override { return limit_; }
  Result<void> begin_send(std::string_view name, LineTime now) override;
  Result<void> begin_receive(std::string_view name, LineTime now) override;
  Result<void> request(const TransferRequest& request, LineTime now) override;
  Result<void> refuse(std::string_view reason, LineTime now) override;
  void set_ready(bool is_ready, LineTime now) override;
  void abort(LineTime now) override;
  void expect_release() override { is_release_due_ = is_host(); }
  LineState state() const override;

 private:
  enum class Stage : std::uint8_t { Start, Leader, Text, End, Answer };  ///< of sending

  Result<void> check_text(std::string_view text, std::size_t first_line) override;
  void text_offered(LineTime) override {}
  void transfer_over(LineTime now) override;

  bool is_host() const { return role_ == Role::Host; }
  void give_up(Error error, LineTime now);
  // Sending
  void refill(LineTime now);
  void encode_next();
  void end_sent(LineTime now);
  bool is_release();
  void on_dc1(LineTime now);
  void on_dc3(LineTime now);
  void on_eot(LineTime now);
  void note_sent(char c);
  bool is_cts_off() const { return is_held_by_cts_ && !input_.cts; }
  bool is_held() const { return is_stopped_ || is_cts_off(); }
  void note_hold(LineTime now);
  // Receiving
  void on_character(char c, LineTime now);
  void add(char c, LineTime now);
  void end_line(LineTime now);
  void take_line(const std::string& line, LineTime now);
  void check_number(const TncLine& read);
  void end_program(LineTime now);
  void restart_silence(LineTime now);
  void hold(bool is_holding);

  const bool is_held_by_cts_;
  std::optional<LineTime> limit_;
  std::optional<LineTime> spoiled_;  ///< time of a line fault while idle
  Stage stage_ = Stage::Start;
  unsigned blanks_left_ = 0;
  std::string out_;
  std::size_t out_at_ = 0;
  std::string sent_line_;          ///< the beginning of the line being sent
  bool has_sent_end_ = false;      ///< an END line was sent
  bool is_asked_ = false;          ///< host: DC1 came while idle
  bool is_release_due_ = false;    ///< host: the next DC1 is of a program that was broken off
  bool is_stopped_ = false;        ///< by the other end's DC3
  bool is_hold_reported_ = false;  ///< by an event

  std::string wanted_;  ///< control: the program that it reads; empty: any
  std::string line_;
  std::optional<unsigned> number_;  ///< of the last block
  bool has_received_ = false, is_open_ = false, has_end_ = false, is_skipping_ = false;
  bool is_ready_ = true;
  bool is_silent_ = false;   ///< silence ends the line in hand and its text
  bool is_holding_ = false;  ///< this end holds the other one in a reception
};

}  // namespace dripline::wire
