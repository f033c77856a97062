#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/tape_reader_commands.hpp"
#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {
namespace {

enum class TapeEnd { None, Stop, Rewind };

/// Calls `take(number)` for each word with this address until it returns true.
template <class Take>
void for_each_word(std::string_view block, char address, Take take) {
  bool is_comment = false;
  for (std::size_t at = 0; at < block.size(); ++at) {
    if (block[at] == '(') is_comment = true;
    if (block[at] == ')') is_comment = false;
    if (is_comment || block[at] != address) continue;
    std::uint64_t number = 0;
    const char* first = block.data() + at + 1;
    const auto [end, error] = std::from_chars(first, block.data() + block.size(), number);
    if (error == std::errc{} && end != first && take(number)) return;
  }
}

/// The number after `address`, outside comments: "N012G1" has N 12. nullopt: no such word.
std::optional<std::uint64_t> word_value(std::string_view block, char address) {
  std::optional<std::uint64_t> value;
  for_each_word(block, address, [&](std::uint64_t number) {
    value = number;
    return true;
  });
  return value;
}

/// M02 stops the reader after this block, M30 rewinds the tape.
TapeEnd tape_end(std::string_view block) {
  TapeEnd end = TapeEnd::None;
  for_each_word(block, 'M', [&](std::uint64_t number) {
    if (number == 2) end = TapeEnd::Stop;
    if (number == 30) end = TapeEnd::Rewind;
    return number == 30;
  });
  return end;
}

constexpr std::size_t kMaxTapeBlock = 1024;
constexpr std::size_t kShownText = 40;

/// The control reading tape, as the Tektronix 1704 does.
///
///     hunt    everything is skipped, unchecked, up to an end of block
///     data    parity is checked; blocks are taken whole
///     rewind  backwards to the rewind stop, then hunt
///     error   READ ERROR: the block being read is dropped, the reader stops, the operator resets
///
/// M02, M30 and the rewind stop end the program; M30 rewinds. The name of a program is the
/// operator's command to the reader: none, "%" to rewind first, "N40" to search for that block.
class TapeReaderControl final : public DisciplineBase {
 public:
  explicit TapeReaderControl(const LineSettings& settings)
      : DisciplineBase(settings, Role::Control), decoder_(settings.code) {
    output_.rts = false;
  }

  void receive(std::span<const std::byte> bytes, LineTime now) override {
    for (const auto byte : bytes) {
      if (is_receiving()) read(static_cast<std::uint8_t>(byte), now);
    }
  }

  void fault(LineFault, LineTime now) override {
    if (!is_receiving()) return;
    ++row_;
    if (!is_hunting_) read_error("the line spoiled a character", now);
  }

  void tick(LineTime now) override {
    if (!limit_ || *limit_ > now) return;
    limit_.reset();
    if (!is_receiving()) return;
    if (!block_.empty()) return read_error("the tape ends inside a block", now);
    if (search_) return stop_with({Errc::NotFound, not_found()}, now);
    emit_fault({Errc::Timeout, "end of tape without M02, M30 or rewind stop"});
    end_program(TapeEnd::Stop, now);
  }

  std::size_t transmit(std::span<std::byte> room, LineTime) override { return take_controls(room); }
  std::optional<LineTime> deadline() const override { return limit_; }

  Result<void> begin_send(std::string_view, LineTime) override {
    return fail(Errc::Unsupported, "a tape control has a reader, no punch");
  }

  Result<void> begin_receive(std::string_view name, LineTime) override {
    if (auto idle = check_idle(); !idle) return idle;
    search_.reset();
    if (name.starts_with('N')) {
      std::uint64_t number = 0;
      const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
      if (error != std::errc{} || end != name.data() + name.size()) {
        return fail(Errc::Unsupported, "'{}' is no block number to search for", name);
      }
      search_ = number;
    } else if (!name.empty() && name != "%") {
      return fail(Errc::Unsupported, "a tape has no program '{}': nothing, % or N and a number",
                  name);
    }
    begin_transfer(Phase::Receiving, std::string(name));
    // Also after M02 and M30; after an error the next block boundary applies.
    is_hunting_ = true;
    if (name == "%") wind_back();
    if (is_ready_) run();
    return {};
  }

  Result<void> request(const TransferRequest& request, LineTime now) override {
    if (request.kind == TransferRequest::Kind::SendProgram) return begin_receive(request.name, now);
    return fail(Errc::Unsupported, "a tape reader has no directory and takes nothing");
  }
  Result<void> refuse(std::string_view, LineTime) override {
    return fail(Errc::Unsupported, "a tape reader asks for nothing");
  }

  void set_ready(bool is_ready, LineTime now) override {
    if (std::exchange(is_ready_, is_ready) == is_ready || !is_receiving()) return;
    if (is_ready) {
      run();
      restart_silence(now);
    } else {
      stop();
    }
  }

  void abort(LineTime now) override {
    if (phase_ == Phase::Idle) return;
    drop_transfer(now);
    stop();
  }

  LineState state() const override {
    LineState state;
    state.phase = phase_;
    state.is_stopping = is_receiving() && !is_ready_;
    if (is_receiving() && is_ready_) state.waiting_for = is_hunting_ ? "end of block" : "tape";
    state.may_wait_without_limit = is_receiving() && !limit_;
    return state;
  }

 private:
  Result<void> check_text(std::string_view, std::size_t) override { return {}; }
  void text_offered(LineTime) override {}
  void transfer_over(LineTime) override {
    limit_.reset();
    block_.clear();
    row_ = 0;
    is_stop_last_ = has_block_ = false;
    is_head_text_ = true;
    head_.clear();
    decoder_ = CharacterDecoder(settings_.code);
  }

  void read(std::uint8_t row, LineTime now) {
    const auto& reader = settings_.reader;
    const bool is_spoiled = ++row_ == reader.fault_row;
    restart_silence(now);
    if (is_spoiled && reader.fault == ReaderFault::MissingSprocket) {
      return read_error("missing sprocket hole", now);
    }
    if (is_spoiled && reader.fault == ReaderFault::SprocketSpacing) {
      return read_error("wrong sprocket hole spacing", now);
    }
    if (is_spoiled && reader.fault == ReaderFault::Chad) row &= static_cast<std::uint8_t>(row - 1);
    if (is_spoiled && reader.fault == ReaderFault::Parity) row ^= 0x40;
    const TapeRow meaning = decode_row(settings_.code, row);
    is_hunting_ ? hunt(row, meaning, now) : take(row, meaning, now);
  }

  void hunt(std::uint8_t row, TapeRow meaning, LineTime now) {
    using enum RowKind;
    if (meaning.kind == Blank || meaning.kind == Delete) return;
    if (meaning.kind != BlockEnd && meaning.kind != CarriageReturn) return note_head(meaning);
    (void)decoder_.decode(
        static_cast<std::byte>(row));  // so that it knows the companion characters
    is_hunting_ = false;
    const bool has_stop = std::exchange(is_stop_last_, false);
    // The program's first line is its head, also where that is no rewind stop: its reader decides
    // what it means that a block is there.
    if (!search_) emit_text(has_stop ? "%\n" : is_head_text_ ? head_ + "\n" : "\n");
    if (!has_stop) say_head();
    run_on(now);
  }

  /// The head of a tape is a rewind stop directly followed by an end of block.
  void say_head() {
    if (is_head_text_ && !head_.empty()) {
      emit_fault({Errc::Corrupt, fmt::format("no end of block before '{}', which was skipped",
                                             std::string_view(head_).substr(0, kShownText))});
    } else {
      emit_fault({Errc::Corrupt, "no rewind stop just before the first end of block"});
    }
  }

  /// The skipped rows: a title, or a first block without an end of block before it.
  void note_head(TapeRow meaning) {
    is_stop_last_ = meaning.kind == RowKind::RewindStop;
    if (is_stop_last_) head_.clear();
    if (is_stop_last_) is_head_text_ = true;
    if (meaning.kind == RowKind::WrongParity) is_head_text_ = false;
    if (meaning.kind == RowKind::Text && head_.size() < kMaxTapeBlock) head_ += meaning.character;
  }

  void take(std::uint8_t row, TapeRow meaning, LineTime now) {
    if (meaning.kind == RowKind::WrongParity) {
      return read_error(fmt::format("wrong parity, 0x{:02X}", static_cast<unsigned>(row)), now);
    }
    if (meaning.kind == RowKind::RewindStop) return end_of_tape(now);
    // Skipped like the control does, but reported: one lost hole makes a blank of EIA's minus, 0,
    // 1, 2, 4, 8 and end of block.
    if (meaning.kind == RowKind::Blank && settings_.code == CharacterCode::Eia && !block_.empty()) {
      emit_fault({Errc::Corrupt, fmt::format("row {}: blank tape after '{}'", row_, block_)});
    }
    auto decoded = decoder_.decode(static_cast<std::byte>(row));
    if (decoded.error) emit_fault(std::move(*decoded.error));
    if (!decoded.text) return;
    if (*decoded.text == '\n') return end_block(now);
    if (block_.size() >= kMaxTapeBlock) {
      return read_error(fmt::format("no end of block in {} characters", kMaxTapeBlock), now);
    }
    block_ += *decoded.text;
  }

  /// Read forwards, the rewind stop ends the program.
  void end_of_tape(LineTime now) {
    if (!has_block_) {  // at the head, after an end of block in the leader
      is_hunting_ = is_stop_last_ = is_head_text_ = true;
      head_.clear();
      return;
    }
    if (search_) return stop_with({Errc::NotFound, not_found()}, now);
    if (!block_.empty()) return read_error("rewind stop inside a block", now);
    emit_text("%\n");
    end_program(TapeEnd::Stop, now);
  }

  void end_block(LineTime now) {
    const std::string block = std::exchange(block_, {});
    if (block.empty() && !has_block_) return run_on(now);  // this is still the head
    has_block_ = true;
    if (search_ && word_value(block, 'N') == search_) {
      search_.reset();
      emit_text("%\n");  // the blocks before it are the head
    }
    if (!search_) emit_text(block + "\n");
    const TapeEnd end = tape_end(block);
    if (end != TapeEnd::None && search_) return stop_with({Errc::NotFound, not_found()}, now);
    if (end != TapeEnd::None) return end_program(end, now);
    run_on(now);
  }

  void end_program(TapeEnd end, LineTime now) {
    end_transfer(now);
    stop();
    if (end == TapeEnd::Rewind) wind_back();
  }

  void read_error(std::string_view what, LineTime now) {
    stop_with({Errc::Corrupt, fmt::format("READ ERROR at row {}: {}", row_, what)}, now);
  }
  void stop_with(Error error, LineTime now) {
    fail_transfer(std::move(error), now);
    stop();
  }
  std::string not_found() const { return fmt::format("block N{} is not on the tape", *search_); }

  // The reader
  void run() {
    output_.rts = true;
    queue_control(kReaderRun);
  }
  /// Starts a reader again that stops at each end of block.
  void run_on(LineTime) {
    if (settings_.reader.stops_at_end_of_block && is_ready_) queue_control(kReaderRun);
  }
  void stop() {
    output_.rts = false;
    queue_control(kReaderStop);
    limit_.reset();
  }
  void wind_back() { queue_control(kReaderBack); }

  void restart_silence(LineTime now) {
    limit_ = is_ready_ && !is_hunting_ ? std::optional<LineTime>(now + settings_.idle_end)
                                       : std::nullopt;
  }

  CharacterDecoder decoder_;
  std::optional<LineTime> limit_;
  std::optional<std::uint64_t> search_;
  std::string block_;
  std::uint64_t row_ = 0;
  bool is_hunting_ = true, is_stop_last_ = false, is_ready_ = true, has_block_ = false;
  std::string head_;  ///< the skipped characters, up to kMaxTapeBlock
  bool is_head_text_ = true;
};

}  // namespace

std::unique_ptr<Discipline> make_tape_reader_control(const LineSettings& settings) {
  return std::make_unique<TapeReaderControl>(settings);
}

}  // namespace dripline::wire
