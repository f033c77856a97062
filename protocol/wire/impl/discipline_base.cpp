#include "protocol/wire/impl/discipline_base.hpp"

#include <algorithm>
#include <bit>

#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {

namespace {

std::string_view phase_text(Phase phase) {
  constexpr std::string_view kTexts[] = {"idle", "sending", "receiving", "asking the other end"};
  return kTexts[static_cast<std::size_t>(phase)];
}

}  // namespace

std::vector<Event> DisciplineBase::take_events() {
  return std::exchange(events_, {});
}

void DisciplineBase::lines(InputLines lines, LineTime) {
  input_ = lines;
}

bool DisciplineBase::has_lost_dsr(InputLines lines) {
  const bool is_lost = has_seen_dsr_ && input_.dsr && !lines.dsr;
  has_seen_dsr_ = lines.dsr;
  return is_lost;
}

std::size_t DisciplineBase::room() const {
  if (!is_sending() || is_last_offered_) return 0;
  return kTextQueueSize - (text_.size() - taken_);
}

Result<void> DisciplineBase::offer(std::string_view text, bool is_last, LineTime now) {
  if (!is_sending()) return fail(Errc::Conflict, "nothing is being sent on this line");
  if (is_last_offered_) {
    return fail(Errc::Conflict, "the last text of this transfer was offered before");
  }
  if (text.size() > room()) {
    return fail(Errc::LimitExceeded, "{} characters offered, there is room for {}", text.size(),
                room());
  }
  if (const auto checked = check_text(text, lines_offered_ + 1); !checked) {
    const Error& error = checked.error();
    fail_transfer(error, now);
    return fail(error);
  }
  if (taken_ > 0) text_.erase(0, std::exchange(taken_, 0));
  text_ += text;
  lines_offered_ += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  is_last_offered_ = is_last;
  text_offered(now);
  return {};
}

Result<void> DisciplineBase::check_idle() const {
  if (phase_ == Phase::Idle) return {};
  return fail(Errc::Busy, "the line is {}", phase_text(phase_));
}

void DisciplineBase::begin_transfer(Phase phase, std::string name) {
  phase_ = phase;
  text_.clear();
  taken_ = lines_offered_ = 0;
  is_last_offered_ = false;
  if (phase == Phase::Sending) text_sent_ = 0;
  emit(TransferBegan{phase == Phase::Receiving, std::move(name)});
}

void DisciplineBase::end_transfer(LineTime now) {
  const bool was_receiving = is_receiving();
  emit(TransferEnded{.is_receiving = was_receiving});
  drop_transfer(now);
}

void DisciplineBase::drop_transfer(LineTime now) {
  phase_ = Phase::Idle;
  text_.clear();
  taken_ = lines_offered_ = 0;
  is_last_offered_ = false;
  transfer_over(now);
}

void DisciplineBase::fail_transfer(Error error, LineTime now) {
  emit(TransferFailed{std::move(error)});
  drop_transfer(now);
}

void DisciplineBase::emit(Event event) {
  events_.push_back(std::move(event));
}

void DisciplineBase::emit_text(std::string_view text) {
  if (text.empty()) return;
  if (!events_.empty()) {
    if (auto* last = std::get_if<TextReceived>(&events_.back())) {
      last->text += text;
      return;
    }
  }
  emit(TextReceived{std::string(text)});
}

void DisciplineBase::queue_control(char character) {
  if (controls_.size() < kControlQueueSize) controls_ += character;
}

std::size_t DisciplineBase::take_controls(std::span<std::byte> room) {
  const std::size_t count = std::min(room.size(), controls_.size());
  std::transform(controls_.begin(), controls_.begin() + static_cast<std::ptrdiff_t>(count),
                 room.begin(), [](char character) { return static_cast<std::byte>(character); });
  controls_.erase(0, count);
  return count;
}

void DisciplineBase::take_text(std::size_t characters) {
  taken_ += characters;
  if (taken_ == text_.size()) {
    text_.clear();
    taken_ = 0;
  }
}

std::optional<std::byte> to_line(CharacterCode code, char character) {
  const auto bits = static_cast<std::uint8_t>(character);
  if (bits > 0x7f) return std::nullopt;
  switch (code) {
    case CharacterCode::Ascii:
      return std::byte{bits};
    case CharacterCode::Iso:
      return static_cast<std::byte>(bits | (std::popcount(bits) % 2 == 1 ? 0x80 : 0));
    case CharacterCode::Eia:
      if (const auto row = encode_row(code, character)) return std::byte{*row};
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<char> from_line(CharacterCode code, std::byte character) {
  const auto bits = static_cast<std::uint8_t>(character);
  if (code == CharacterCode::Eia) {
    const TapeRow row = decode_row(code, bits);
    if (row.kind == RowKind::Text || row.kind == RowKind::RewindStop) return row.character;
    return std::nullopt;
  }
  if (code == CharacterCode::Iso && std::popcount(bits) % 2 == 1) return std::nullopt;
  return static_cast<char>(bits & 0x7f);
}

}  // namespace dripline::wire
