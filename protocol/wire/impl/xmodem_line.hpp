#pragma once

#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/xmodem_block.hpp"

namespace dripline::wire {

/// XMODEM, sender and receiver, the same at both ends. The receiver asks for everything: the first
/// block (C or NAK), a repeat (NAK), the end (it has EOT sent twice). The sender never repeats a
/// block without a request, because answers have no numbers and a second one would count as the
/// next block's. Without room for text the ACK is withheld.
class XmodemLine final : public DisciplineBase {
 public:
  XmodemLine(const LineSettings& settings, Role role);

  void receive(std::span<const std::byte> bytes, LineTime now) override;
  void fault(LineFault fault, LineTime now) override;
  void tick(LineTime now) override;
  std::size_t transmit(std::span<std::byte> room, LineTime now) override;
  std::optional<LineTime> deadline() const override { return deadline_; }
  Result<void> begin_send(std::string_view name, LineTime now) override;
  Result<void> begin_receive(std::string_view name, LineTime now) override;
  Result<void> request(const TransferRequest& request, LineTime now) override;
  Result<void> refuse(std::string_view reason, LineTime now) override;
  void set_ready(bool is_ready, LineTime now) override;
  void abort(LineTime now) override;
  LineState state() const override;

 private:
  enum class Step : std::uint8_t {
    Idle,
    // Sender
    AwaitStart,   ///< waits for NAK or C of the receiver
    NeedText,     ///< needs text for a whole block
    SendBlock,    ///< characters of it are left
    AwaitAnswer,  ///< ACK or NAK
    AwaitEnd,     ///< EOT was sent
    // Receiver
    Ask,         ///< asks for the first block
    AwaitBlock,  ///< waits for the next block, EOT or CAN
    InBlock,
    AfterBlock,  ///< a good block; it is bad if another character follows (one came twice)
    AfterEot,    ///< silence proves that it was an EOT
    Purge,       ///< noise came: waits for silence, then sends NAK
    Withhold,    ///< a good block without room: ACK later
  };
  bool is_sender_step() const { return step_ >= Step::AwaitStart && step_ <= Step::AwaitEnd; }

  void take(std::byte character, LineTime now);
  bool is_canceled(char character, LineTime now);
  void take_idle(char character, LineTime now);
  void drop_request();
  void say(char character) { queue_control(character); }
  void cancel();

  // Sender
  void take_answer(char character, LineTime now);
  bool choose_check(char character);
  void take_start(char character, LineTime now);
  void block_accepted(LineTime now);
  void block_refused(LineTime now);
  void fill_block();
  void prepare_block(LineTime now);
  void say_end(LineTime now);
  std::optional<LineTime> patience(LineTime now) const;
  std::optional<LineTime> start_deadline(LineTime now) const;

  // Receiver
  void ask(LineTime now);
  void take_block_start(char character, LineTime now);
  void take_block(std::byte character, LineTime now);
  void block_complete(LineTime now);
  void judge_block(LineTime now);
  void block_good(LineTime now);
  void accept_block(LineTime now);
  void purge(LineTime now);
  void ask_again(LineTime now);
  LineTime asking_period() const;
  void give_up(Error error, LineTime now);

  // DisciplineBase
  Result<void> check_text(std::string_view text, std::size_t first_line) override;
  void text_offered(LineTime now) override;
  void transfer_over(LineTime now) override;

  Step step_ = Step::Idle;
  std::optional<LineTime> deadline_;
  xmodem::Check check_ = xmodem::Check::Crc;
  std::uint8_t number_ = 1;  ///< of the block being sent or expected
  unsigned tries_ = 0;       ///< for that block, or for the start
  bool was_can_ = false;     ///< the last character was CAN; two in a row end the transfer
  bool is_ready_ = true;

  CharacterEncoder checked_, encoder_;
  std::vector<std::byte> data_;   ///< encoded, not yet in an accepted block
  std::uint64_t text_taken_ = 0;  ///< text in data_ and the blocks before it
  std::vector<std::byte> block_;
  std::size_t block_given_ = 0;       ///< characters of the block that transmit returned
  std::size_t block_data_ = 0;        ///< characters of data_ in it
  std::uint64_t block_text_end_ = 0;  ///< text that is complete with this block
  std::optional<LineTime> asked_at_;  ///< last NAK or C while idle
  bool is_asked_ = false;

  CharacterDecoder decoder_;
  xmodem::BlockReader reader_;
  bool is_first_block_ = true;
  bool is_sender_there_ = false;  ///< a block has begun: the sender has chosen its check
  LineTime purging_since_{};
  bool was_eot_refused_ = false;
  bool was_received_ = false;  ///< the last transfer was received: its EOT may come again
};

}  // namespace dripline::wire
