#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "protocol/wire/discipline.hpp"
#include "protocol/wire/impl/line_limits.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::wire {

/// The common part of all ends: the offered text, the control characters that are sent first, and
/// the events not yet taken. Events have no bound of their own: a call creates at most a few for
/// each character.
class DisciplineBase : public Discipline {
 public:
  std::vector<Event> take_events() final;
  void lines(InputLines lines, LineTime now) override;
  OutputLines output_lines() const override { return output_; }
  std::size_t room() const final;
  Result<void> offer(std::string_view text, bool is_last, LineTime now) final;

 protected:
  DisciplineBase(const LineSettings& settings, Role role) : settings_(settings), role_(role) {}

  /// Checks `text` by the rules of this protocol: characters that its code does not have.
  /// `first_line` is the number of its first line in the program, from 1.
  virtual Result<void> check_text(std::string_view text, std::size_t first_line) = 0;
  /// More text is in the queue, or its end is known.
  virtual void text_offered(LineTime now) = 0;
  /// Resets the state of the transfer; the base has dropped its text.
  virtual void transfer_over(LineTime now) = 0;

  // Transfers
  Result<void> check_idle() const;  ///< Busy unless idle
  void begin_transfer(Phase phase, std::string name);
  void end_transfer(LineTime now);   ///< with TransferEnded; idle again
  void drop_transfer(LineTime now);  ///< without an event; idle again
  void fail_transfer(Error error, LineTime now);
  bool is_sending() const { return phase_ == Phase::Sending; }
  bool is_receiving() const { return phase_ == Phase::Receiving; }

  // Events
  void emit(Event event);
  void emit_text(std::string_view text);  ///< appended to the text before it
  void emit_fault(Error error) { emit(LineError{std::move(error)}); }

  /// Whether DSR was on and goes off (a cable without DSR never has it on): the other end was
  /// switched off, or its cable was pulled. Must be called before input_ is replaced.
  bool has_lost_dsr(InputLines lines);
  static Error cut_off() {
    return {Errc::Timeout, "DSR went off: the control was switched off, or its cable was pulled"};
  }

  // Control characters of this end, which go first
  void queue_control(char character);
  bool has_controls() const { return !controls_.empty(); }
  /// Puts the characters that fit into `room`; returns their number.
  std::size_t take_controls(std::span<std::byte> room);

  // Text of the transfer, in order: taken for the line, then counted as sent
  bool has_text() const { return taken_ < text_.size(); }
  std::string_view queued_text() const { return std::string_view(text_).substr(taken_); }
  void take_text(std::size_t characters);  ///< at most queued_text()
  /// `characters` more have been given to transmit's caller.
  void count_sent(std::size_t characters) { text_sent_ += characters; }
  std::uint64_t text_sent() const { return text_sent_; }
  bool is_last_offered() const { return is_last_offered_; }
  bool is_text_taken() const { return is_last_offered_ && !has_text(); }

  LineSettings settings_;
  Role role_;
  Phase phase_ = Phase::Idle;
  InputLines input_;
  OutputLines output_;

 private:
  std::vector<Event> events_;
  std::string controls_;
  std::string text_;
  std::size_t taken_ = 0;  ///< of text_, whose taken part is removed at times
  std::size_t lines_offered_ = 0;
  std::uint64_t text_sent_ = 0;  ///< of this transfer or the last one sent
  bool is_last_offered_ = false;
  bool has_seen_dsr_ = false;
};

// One factory for each protocol; make_discipline() has checked the settings before it calls one.

std::unique_ptr<Discipline> make_plain(const LineSettings& settings, Role role);
std::unique_ptr<Discipline> make_xmodem(const LineSettings& settings, Role role);
std::unique_ptr<Discipline> make_tnc_blockwise_host(const LineSettings& settings);
std::unique_ptr<Discipline> make_tnc_blockwise_control(const LineSettings& settings);
std::unique_ptr<Discipline> make_tnc_standard(const LineSettings& settings, Role role);
std::unique_ptr<Discipline> make_tape_reader_host(const LineSettings& settings);
std::unique_ptr<Discipline> make_tape_reader_control(const LineSettings& settings);

// Characters that control a line, as they are on the line in its code.

inline constexpr char kDc1 = 0x11, kDc2 = 0x12, kDc3 = 0x13, kDc4 = 0x14;

/// People see printable characters (`%`) as part of a program's text, the others not.
constexpr bool is_printable(char character) {
  return character > ' ' && character < 0x7f;
}

/// The character on the line; nullopt: the code does not have it.
std::optional<std::byte> to_line(CharacterCode code, char character);
/// Its 7-bit character; nullopt: wrong parity, or EIA, which has no control characters except those
/// of tape ('%' for its rewind stop).
std::optional<char> from_line(CharacterCode code, std::byte character);

}  // namespace dripline::wire
