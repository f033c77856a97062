#include <algorithm>
#include <cmath>

#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/tape_reader_commands.hpp"
#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {
namespace {

/// Time from the command to the first row.
constexpr LineTime kStartUp = std::chrono::milliseconds(10);
/// From a stop after the last character to the end: a control that winds back does so before.
constexpr LineTime kSettled = std::chrono::seconds(1);

/// The host as the reader: each text is a tape with leader, rewind stop and trailer that the
/// control runs, stops and rewinds. Rewinding asks the owner for the same program again, and so
/// does running it after its end (a looped tape).
class TapeReaderHost final : public DisciplineBase {
 public:
  explicit TapeReaderHost(const LineSettings& settings)
      : DisciplineBase(settings, Role::Host),
        encoder_(settings.code, settings.end_of_block),
        row_time_(
            static_cast<std::int64_t>(std::llround(1e9 / settings.reader.characters_per_second))) {}

  void receive(std::span<const std::byte> bytes, LineTime now) override {
    for (const auto byte : bytes) {
      const char c = static_cast<char>(byte & std::byte{0x7F});
      if (c == kReaderRun) run(now);
      if (c == kReaderStop) stop(now);
      if (c == kReaderBack) wind_back(now);
    }
  }
  void fault(LineFault, LineTime) override {}  // the control repeats its commands

  void lines(InputLines lines, LineTime now) override {
    const InputLines before = input_;
    DisciplineBase::lines(lines, now);
    if (before.dsr && !lines.dsr && lines.cts) wind_back(now);
    if (before.cts && !lines.cts) stop(now);
    if (!before.cts && lines.cts && lines.dsr) run(now);
  }

  void tick(LineTime now) override {
    if (is_sending() && closes_at_ && *closes_at_ <= now) return end_reading(now);
    if (!is_sending() || is_running_ || !limit_ || *limit_ > now) return;
    fail_transfer({Errc::Timeout, "the control did not run the reader in time"}, now);
  }

  std::optional<LineTime> deadline() const override {
    if (!is_sending()) return std::nullopt;
    if (closes_at_) return closes_at_;
    if (!is_running_) return limit_;
    const bool has_rows = row_at_ < rows_.size() || has_more();
    return has_rows ? std::optional(next_row_) : std::nullopt;
  }

  std::size_t transmit(std::span<std::byte> room, LineTime now) override {
    std::size_t count = 0;
    while (count < room.size() && is_sending() && is_running_ && next_row_ <= now) {
      if (row_at_ == rows_.size() && !refill(now)) break;
      const auto row = rows_[row_at_++];
      if (row_at_ == rows_.size() && stage_ == Stage::Text && !std::exchange(is_head_, false)) {
        count_sent(1);
      }
      if (auto spoiled = pass(row, now)) room[count++] = *spoiled;
      end_of_row(row, now);
    }
    return count;
  }

  Result<void> begin_send(std::string_view name, LineTime now) override {
    if (auto idle = check_idle(); !idle) return idle;
    begin_transfer(Phase::Sending, std::string(name));
    encoder_ = CharacterEncoder(settings_.code, settings_.end_of_block);
    checker_ = CharacterEncoder(settings_.code, settings_.end_of_block);
    blanks_ = std::exchange(is_wound_back_, false) ? 0 : settings_.leader;
    gap_ = settings_.leader;
    stage_ = Stage::Leader;
    is_asked_ = is_over_ = has_begun_ = false;
    // A control that has run the reader after its last tape has not stopped it since.
    const bool is_run = std::exchange(runs_next_, false) || !settings_.wait_for_xon;
    const bool runs_at_once = is_run && input_.cts && !is_stopped_;
    runs_at_once ? run(now) : wait(now);
    if (!runs_at_once) limit_ = after(settings_.start_limit, now);
    return {};
  }
  Result<void> begin_receive(std::string_view, LineTime) override {
    return fail(Errc::Unsupported, "a tape reader does not punch");
  }
  Result<void> request(const TransferRequest&, LineTime) override {
    return fail(Errc::Unsupported, "a tape reader asks for nothing");
  }
  Result<void> refuse(std::string_view, LineTime) override {
    if (!is_asked_) return fail(Errc::Conflict, "the control has asked for nothing");
    is_asked_ = false;
    return {};
  }
  void set_ready(bool, LineTime) override {}
  void abort(LineTime now) override {
    is_asked_ = false;
    if (phase_ != Phase::Idle) drop_transfer(now);
  }

  LineState state() const override {
    LineState state;
    state.phase = phase_;
    state.is_stopped = is_sending() && !is_running_;
    if (state.is_stopped) state.waiting_for = "run";
    state.may_wait_without_limit = state.is_stopped && !limit_;
    state.is_asked = is_asked_;
    state.awaits_start = state.is_stopped && row_ == 0;
    state.text_sent = text_sent();
    return state;
  }

 private:
  enum class Stage : std::uint8_t { Leader, Text, Trailer };

  Result<void> check_text(std::string_view text, std::size_t) override {
    std::vector<std::byte> rows;
    return checker_.encode(text, rows);
  }
  /// That nothing follows may be known only after the control has stopped or wound back.
  void text_offered(LineTime now) override {
    next_row_ = std::max(next_row_, now);
    if (!is_sending()) return;
    if (std::exchange(is_back_pending_, false)) return wind_back(now);
    if (is_stopped_ && is_read()) closes_at_ = now + kSettled;
  }
  void transfer_over(LineTime) override {
    rows_.clear();
    row_at_ = 0;
    row_ = 0;
    is_running_ = is_back_pending_ = false;
    limit_.reset();
    closes_at_.reset();
  }

  bool has_more() const {
    const bool has_said = has_text() || is_last_offered();
    return stage_ == Stage::Text ? has_said : blanks_ > 0 || has_said;
  }

  /// The next rows: those of one character, or one blank. False: there are none now.
  bool refill(LineTime now) {
    rows_.clear();
    row_at_ = 0;
    if (stage_ != Stage::Text && blanks_ > 0) {
      --blanks_;
      rows_.push_back(std::byte{0});
      return true;
    }
    if (stage_ == Stage::Leader && (has_text() || is_last_offered())) return begin_text(now);
    if (stage_ == Stage::Text && has_text()) {
      const char c = queued_text().front();
      if (c == '%' && has_begun_ && gap_ > 0) {  // the next program's leader
        --gap_;
        is_head_ = true;
        rows_.push_back(std::byte{0});
        return true;
      }
      gap_ = settings_.leader;
      has_begun_ = true;
      take_text(1);
      (void)encoder_.encode({&c, 1}, rows_);  // check_text has checked it
      if (!rows_.empty()) return true;
      count_sent(1);  // CR belongs to its LF
      return refill(now);
    }
    end_tape(now);
    return is_sending() && stage_ == Stage::Trailer && refill(now);
  }

  /// The trailer follows the last row of the text.
  void end_tape(LineTime now) {
    if (stage_ == Stage::Text && is_text_taken()) {
      stage_ = Stage::Trailer;
      blanks_ = settings_.trailer;
    }
    if (stage_ == Stage::Trailer && blanks_ == 0) end_reading(now);
  }

  /// A control reads nothing before an end of block, and rewinds to the rewind stop.
  bool begin_text(LineTime now) {
    stage_ = Stage::Text;
    if (has_text() && queued_text().front() == '%') return refill(now);
    rows_.push_back(static_cast<std::byte>(*encode_row(settings_.code, '%')));
    for (const char row : end_of_block_rows(settings_.code, settings_.end_of_block)) {
      rows_.push_back(static_cast<std::byte>(row));
    }
    is_head_ = true;
    return true;
  }

  /// Counts the row; returns it damaged if it is the one with the fault.
  std::optional<std::byte> pass(std::byte row, LineTime) {
    if (++row_ != settings_.reader.fault_row) return row;
    const auto bits = static_cast<unsigned>(row);
    switch (settings_.reader.fault) {
      case ReaderFault::Parity:
        return static_cast<std::byte>(bits ^ 0x40U);
      case ReaderFault::Chad:
        return static_cast<std::byte>(bits & (bits - 1));
      case ReaderFault::MissingSprocket:
        return std::nullopt;
      case ReaderFault::SprocketSpacing:
        next_row_ += row_time_ / 2;
        return row;
      case ReaderFault::None:
        break;
    }
    return row;
  }

  void end_of_row(std::byte row, LineTime now) {
    // Rows keep their rate although the caller is a little late each time.
    next_row_ = std::max(next_row_ + row_time_, now - 2 * row_time_);
    const auto kind = decode_row(settings_.code, static_cast<std::uint8_t>(row)).kind;
    if (kind == RowKind::Text || kind == RowKind::WrongParity) is_in_block_ = true;
    if (kind == RowKind::BlockEnd || kind == RowKind::CarriageReturn || kind == RowKind::RewindStop)
      is_in_block_ = false;
    const bool is_last_row = row_at_ == rows_.size();
    if (is_last_row) end_tape(now);
    if (!is_sending()) return;
    const bool is_block_end = kind == RowKind::BlockEnd || kind == RowKind::CarriageReturn;
    if (is_last_row && is_block_end && settings_.reader.stops_at_end_of_block) wait(now);
  }

  /// The tape stays in the reader.
  void end_reading(LineTime now) {
    end_transfer(now);
    is_over_ = true;
  }
  /// What is left holds no block and ends none: the rest of an end of block, and perhaps a rewind
  /// stop after the last program.
  bool has_no_block_left() const {
    if (is_in_block_) return false;
    constexpr std::string_view kNoBlock = "%\r\n \t";
    const bool are_rows_blank = std::ranges::all_of(
        rows_.begin() + static_cast<std::ptrdiff_t>(row_at_), rows_.end(), [&](std::byte row) {
          const auto kind = decode_row(settings_.code, static_cast<std::uint8_t>(row)).kind;
          return kind != RowKind::Text && kind != RowKind::WrongParity;
        });
    return are_rows_blank && queued_text().find_first_not_of(kNoBlock) == std::string_view::npos;
  }
  bool is_read() const {
    return stage_ != Stage::Leader && has_begun_ && is_last_offered() && has_no_block_left();
  }
  void ask() {
    if (std::exchange(is_asked_, true)) return;
    emit(TransferRequest{TransferRequest::Kind::SendProgram, ""});
  }

  void run(LineTime now) {
    is_stopped_ = false;
    if (is_sending() && closes_at_) end_reading(now);
    if (!is_sending() && std::exchange(is_over_, false)) {
      runs_next_ = true;
      return ask();
    }
    if (!is_sending() || is_running_) return;
    is_running_ = true;
    limit_.reset();
    next_row_ = now + kStartUp;
    if (std::exchange(was_held_, false)) emit(FlowChanged{false});
  }

  void stop(LineTime now) {
    is_stopped_ = true;
    runs_next_ = false;
    if (is_sending() && is_read()) closes_at_ = now + kSettled;  // M02; M30 winds back now
    if (!is_sending() || !is_running_) return;
    wait(now);
    was_held_ = true;
    emit(FlowChanged{true});
  }

  void wait(LineTime now) {
    is_running_ = false;
    limit_ = after(settings_.hold_limit, now);
  }
  static std::optional<LineTime> after(std::optional<std::chrono::milliseconds> limit,
                                       LineTime now) {
    return limit ? std::optional(now + *limit) : std::nullopt;
  }

  void wind_back(LineTime now) {
    is_wound_back_ = true;
    const bool has_rest = !has_begun_ || !has_no_block_left();
    if (is_sending() && stage_ == Stage::Text && !has_rest && !is_last_offered()) {
      is_back_pending_ = true;
      return;
    }
    if (is_sending()) {
      if (is_read())
        end_reading(now);
      else
        fail_transfer({Errc::Corrupt, "the control wound the tape back"}, now);
    }
    is_over_ = false;
    ask();
  }

  CharacterEncoder encoder_;
  CharacterEncoder checker_{settings_.code, settings_.end_of_block};
  LineTime row_time_;
  LineTime next_row_{};
  std::optional<LineTime> limit_;
  Stage stage_ = Stage::Leader;
  unsigned blanks_ = 0;
  unsigned gap_ = 0;  ///< blanks before the next rewind stop in the text
  std::vector<std::byte> rows_;
  std::size_t row_at_ = 0;
  std::uint64_t row_ = 0;  ///< of the transfer
  bool is_running_ = false, is_stopped_ = false, was_held_ = false;
  bool is_asked_ = false, is_wound_back_ = false, is_head_ = false;
  bool has_begun_ = false;             ///< a character of the text was read
  bool is_in_block_ = false;           ///< its end was not read yet
  bool is_over_ = false;               ///< the tape was read to its end, and not wound back
  bool runs_next_ = false;             ///< the control has run the reader since
  std::optional<LineTime> closes_at_;  ///< stopped after the last character: then it is over
  bool is_back_pending_ = false;       ///< wound back, and whether text is left is not known
};

}  // namespace

std::unique_ptr<Discipline> make_tape_reader_host(const LineSettings& settings) {
  return std::make_unique<TapeReaderHost>(settings);
}

}  // namespace dripline::wire
