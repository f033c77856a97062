#pragma once

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/tnc_frames.hpp"

namespace dripline::wire {

/// The common part of both ends of a TNC's blockwise transfer: one block at a time, acknowledged,
/// repeated when refused. The two roles decide who may begin and how a transfer ends.
///
/// A control that runs the program while it arrives withholds its ACK while its memory is full, so
/// the host waits for an ACK without a limit unless `hold_limit` sets one; it never repeats an
/// unanswered block unless `repeats_unanswered`, as a slow control would accept it twice.
class TncBlockwise : public DisciplineBase {
 public:
  void receive(std::span<const std::byte> bytes, LineTime now) final;
  void fault(LineFault fault, LineTime now) final;
  void tick(LineTime now) final;
  std::size_t transmit(std::span<std::byte> room, LineTime now) final;
  std::optional<LineTime> deadline() const final;
  void set_ready(bool is_ready, LineTime now) final;
  void abort(LineTime now) final;
  LineState state() const final;

 protected:
  enum class Wait : std::uint8_t {
    Nothing,
    Heading,        ///< host: the control asks for the program that is ready
    HeadingAnswer,  ///< control: ACK of its heading
    BlockAnswer,    ///< sender: ACK of its block
    Block,          ///< receiver: the next block
    EndAnswer,      ///< host that sent ETX: EOT
    AfterEnd,       ///< host that received ETX: EOT
  };

  TncBlockwise(const LineSettings& settings, Role role);

  virtual void on_heading(const std::string& text, LineTime now) = 0;
  virtual void on_ack(LineTime now) = 0;  ///< no block waits for it
  virtual void on_nak(LineTime now) = 0;
  virtual void on_etx(LineTime now) = 0;
  virtual void on_eot(LineTime now) = 0;
  /// A good or broken block came while nothing is being received.
  virtual void on_stray_block(LineTime now) = 0;
  virtual void on_limit(
      LineTime now) = 0;  ///< the limit of a wait other than BlockAnswer has passed
  virtual void send_end(LineTime now) = 0;         ///< all text is accepted
  virtual void on_out_sent(LineTime) {}            ///< all of `out` was given to the line
  virtual bool is_asked() const { return false; }  ///< a heading waits for its answer
  virtual void drop_request() {}
  /// Notifies the other end that the transfer ends early.
  virtual void tell_abort(std::string_view reason) = 0;

  Result<void> check_text(std::string_view text, std::size_t first_line) final;
  void text_offered(LineTime now) final { send_next(now); }
  void transfer_over(LineTime now) override;

  void send_next(LineTime now);
  void resend_block(LineTime now);
  bool has_block_out() const { return !block_.empty(); }
  /// The last `tail` characters (DC1) follow the part that is answered.
  void put_out(std::string characters, std::size_t tail = 0);
  /// Whether the other end can have received what it answers; the tail then counts as sent and goes
  /// before the next characters.
  bool is_out_heard(LineTime now);
  /// Whether everything given to `put_out` has left.
  bool is_out_empty() const { return out_at_ == out_.size(); }
  void wait_for(Wait wait, std::optional<LineTime> limit);
  void begin_receiving(std::string name, LineTime now);
  void take_block(const std::string& text, LineTime now);
  bool has_received() const { return has_received_; }
  bool has_accepted() const { return accepted_ > 0; }
  /// Errors: Corrupt, when the received text begins like a program and does not end like one.
  Result<void> check_complete() const;
  void give_up(Error error, LineTime now);
  std::optional<LineTime> after_answer_limit(LineTime now, unsigned times = 1) const;
  std::optional<LineTime> after_pause_limit(LineTime now, unsigned times = 1) const;
  std::optional<LineTime> after_hold_limit(LineTime now) const;
  /// Another attempt after a refusal or a missing answer; false: there are none left.
  bool may_try_again();
  void begin_tries() { tries_ = 0; }

  Wait wait_ = Wait::Nothing;

 private:
  void handle(const TncFrame& frame, LineTime now);
  void on_block(const TncFrame& frame, LineTime now);
  void on_block_answer(bool is_good, LineTime now);
  void on_noise(LineTime now);
  void on_block_limit(LineTime now);
  void out_sent(LineTime now);
  void send_block(std::string_view line, std::size_t bytes);
  void acknowledge(LineTime now);
  void set_stopped(bool is_stopped);
  bool repeats_unanswered() const {
    return role_ == Role::Control || settings_.heidenhain.repeats_unanswered;
  }
  bool has_no_limit() const;  ///< of the current wait

  TncFrameReader reader_;
  std::optional<LineTime> limit_, silence_, hold_seen_;
  std::string out_;  ///< block, heading or end being sent
  std::size_t out_at_ = 0, out_tail_ = 0;
  std::string block_;  ///< the last one sent, until it is accepted
  std::size_t block_bytes_ = 0, block_tail_ = 0;
  std::uint64_t accepted_ = 0;
  std::size_t column_ = 0;  ///< of the text offered
  unsigned tries_ = 0;
  bool is_counted_ = false;  ///< block_ as sent
  bool is_garbled_ = false;  ///< characters came in place of an answer
  bool is_stopped_ = false;
  // Receiving
  bool is_ready_ = true, owes_ack_ = false, has_received_ = false;
  std::string first_line_, last_line_;
};

}  // namespace dripline::wire
