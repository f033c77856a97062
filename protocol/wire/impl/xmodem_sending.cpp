#include <algorithm>

#include "protocol/wire/impl/xmodem_line.hpp"

namespace dripline::wire {

using namespace xmodem;

namespace {

/// The receiver asks again after answer_limit; the sender waits long enough for a few requests.
constexpr int kPatience = 6;
/// A request of this age is still valid: receivers ask every three seconds or more slowly.
constexpr LineTime kFreshRequest = std::chrono::seconds(1);

}  // namespace

Result<void> XmodemLine::begin_send(std::string_view name, LineTime now) {
  if (const auto idle = check_idle(); !idle) return idle;
  const bool is_asked = asked_at_ && now - *asked_at_ <= kFreshRequest;
  is_asked_ = false;
  was_received_ = false;
  checked_ = encoder_ = CharacterEncoder(settings_.code, settings_.end_of_block);
  data_.clear();
  text_taken_ = block_text_end_ = 0;
  number_ = 1;
  tries_ = 0;
  begin_transfer(Phase::Sending, std::string(name));
  step_ = is_asked ? Step::NeedText : Step::AwaitStart;
  deadline_ = is_asked ? std::nullopt : start_deadline(now);
  return {};
}

/// A host waits for the operator at the control, a control for its host.
std::optional<LineTime> XmodemLine::start_deadline(LineTime now) const {
  if (role_ == Role::Control) return patience(now);
  return settings_.start_limit ? std::optional(now + *settings_.start_limit) : std::nullopt;
}

std::optional<LineTime> XmodemLine::patience(LineTime now) const {
  if (!settings_.answer_limit) return std::nullopt;
  return now + kPatience * LineTime(*settings_.answer_limit);
}

Result<void> XmodemLine::check_text(std::string_view text, std::size_t /*first_line*/) {
  std::vector<std::byte> scratch;
  return checked_.encode(text, scratch);
}

void XmodemLine::text_offered(LineTime now) {
  if (step_ == Step::NeedText) prepare_block(now);
}

/// Moves text into data_ until it fills a block.
void XmodemLine::fill_block() {
  while (has_text() && data_.size() < kBlockSize) {
    (void)encoder_.encode(queued_text().substr(0, 1), data_);  // offer() has checked it
    take_text(1);
    ++text_taken_;
  }
}

void XmodemLine::prepare_block(LineTime now) {
  fill_block();
  if (data_.empty() && is_text_taken()) return say_end(now);
  if (data_.size() < kBlockSize && !is_text_taken()) {
    step_ = Step::NeedText;
    deadline_.reset();
    return;
  }
  block_data_ = std::min(data_.size(), kBlockSize);
  // The last character of text may be in this block and the next: it belongs to the next.
  const bool is_split = data_.size() > kBlockSize;
  block_text_end_ = text_taken_ - (is_split ? 1 : 0);
  block_ = make_block(number_, std::span(data_).first(block_data_), check_);
  block_given_ = 0;
  tries_ = 0;
  step_ = Step::SendBlock;
  deadline_.reset();
}

std::size_t XmodemLine::transmit(std::span<std::byte> room, LineTime now) {
  std::size_t count = take_controls(room);
  if (step_ != Step::SendBlock) return count;
  const std::size_t more = std::min(room.size() - count, block_.size() - block_given_);
  std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(block_given_), more,
              room.begin() + static_cast<std::ptrdiff_t>(count));
  block_given_ += more;
  count += more;
  if (block_given_ == block_.size()) {
    count_sent(block_text_end_ - std::min(block_text_end_, text_sent()));
    step_ = Step::AwaitAnswer;
    deadline_ = patience(now);
  }
  return count;
}

/// Answers that come before the block has left are ignored: a doubled ACK, an old NAK.
void XmodemLine::take_answer(char character, LineTime now) {
  switch (step_) {
    case Step::AwaitStart:
      return take_start(character, now);
    case Step::NeedText:
      // The receiver may have changed its mind while the first block was not full.
      if (number_ == 1 && block_.empty()) choose_check(character);
      return;
    case Step::AwaitAnswer:
      if (character == kAck) return block_accepted(now);
      if (character == kNak || (character == kCrcWanted && number_ == 1)) block_refused(now);
      return;
    case Step::AwaitEnd:
      if (has_controls()) return;  // EOT has not left: this is a doubled answer to the last block
      if (character == kAck) {
        if (text_taken_ > block_text_end_) emit(TextAccepted{text_taken_});
        return end_transfer(now);
      }
      if (character == kNak || character == kCrcWanted) say_end(now);
      return;
    default:
      return;
  }
}

bool XmodemLine::choose_check(char character) {
  if (character != kNak && character != kCrcWanted) return false;
  check_ = character == kCrcWanted ? Check::Crc : Check::Sum;
  return true;
}

void XmodemLine::take_start(char character, LineTime now) {
  if (choose_check(character)) prepare_block(now);
}

void XmodemLine::block_accepted(LineTime now) {
  data_.erase(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(block_data_));
  ++number_;
  tries_ = 0;
  emit(TextAccepted{block_text_end_});
  prepare_block(now);
}

void XmodemLine::block_refused(LineTime now) {
  if (++tries_ > settings_.retries) {
    return give_up({Errc::Corrupt, fmt::format("block {} was refused {} times",
                                               static_cast<unsigned>(number_), tries_)},
                   now);
  }
  block_given_ = 0;
  step_ = Step::SendBlock;
  deadline_.reset();
}

/// The sender may repeat EOT without a request: a second one does no harm.
void XmodemLine::say_end(LineTime now) {
  if (step_ != Step::AwaitEnd) tries_ = 0;
  if (++tries_ > settings_.retries + 2) {  // the first one is always refused
    return give_up({Errc::Timeout, fmt::format("the end was not accepted, {} times", tries_)}, now);
  }
  step_ = Step::AwaitEnd;
  say(kEot);
  deadline_.reset();
  if (settings_.answer_limit) deadline_ = now + *settings_.answer_limit;
}

}  // namespace dripline::wire
