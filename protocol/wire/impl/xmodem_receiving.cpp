#include "protocol/wire/impl/xmodem_line.hpp"

namespace dripline::wire {

using namespace xmodem;

namespace {

constexpr LineTime kCrcAskingPeriod = std::chrono::seconds(3);
constexpr unsigned kCrcAsks = 4;  ///< then the checksum is asked for
/// Asking period where the settings name no limit.
constexpr LineTime kAskingPeriod = std::chrono::seconds(10);
/// Silence inside a block, after noise, or after an EOT.
constexpr LineTime kSilence = std::chrono::seconds(1);
constexpr int kSilenceAfterBlock = 2;  ///< character times
constexpr LineTime kLongestNonsense = std::chrono::seconds(60);

}  // namespace

Result<void> XmodemLine::begin_receive(std::string_view name, LineTime now) {
  if (const auto idle = check_idle(); !idle) return idle;
  begin_transfer(Phase::Receiving, std::string(name));
  decoder_ = CharacterDecoder(settings_.code);
  check_ = settings_.xmodem_crc ? Check::Crc : Check::Sum;
  number_ = 1;
  tries_ = 0;
  is_asked_ = false;
  is_first_block_ = true;
  is_sender_there_ = false;
  was_eot_refused_ = was_received_ = false;
  ask(now);
  return {};
}

LineTime XmodemLine::asking_period() const {
  return settings_.answer_limit ? LineTime(*settings_.answer_limit) : kAskingPeriod;
}

/// Asks for the first block: the sender may not be ready yet.
void XmodemLine::ask(LineTime now) {
  const unsigned limit = settings_.retries + kCrcAsks;
  const bool is_limited = settings_.answer_limit || role_ == Role::Host;
  if (is_limited && tries_ > limit) {
    return give_up({Errc::Timeout, fmt::format("no block came, asked {} times", tries_)}, now);
  }
  if (!is_sender_there_ && tries_ >= kCrcAsks) check_ = Check::Sum;
  step_ = Step::Ask;
  ++tries_;
  say(check_ == Check::Crc ? kCrcWanted : kNak);
  deadline_ = now + (check_ == Check::Crc ? kCrcAskingPeriod : asking_period());
}

void XmodemLine::take_block_start(char character, LineTime now) {
  if (step_ == Step::Withhold) return;
  if (step_ == Step::Purge || step_ == Step::AfterEot || step_ == Step::AfterBlock) {
    return purge(now);
  }
  if (character == kSoh || (character == kStx && check_ == Check::Crc)) {
    is_sender_there_ = true;
    reader_.begin(character, check_);
    step_ = Step::InBlock;
    deadline_ = now + kSilence;
    return;
  }
  if (character == kEot) {
    if (was_eot_refused_) {
      say(kAck);
      was_received_ = true;
      return end_transfer(now);
    }
    step_ = Step::AfterEot;
    deadline_ = now + kSilence;
    return;
  }
  if (step_ == Step::AwaitBlock) purge(now);
}

void XmodemLine::take_block(std::byte character, LineTime now) {
  deadline_ = now + kSilence;
  if (reader_.take(character)) block_complete(now);
}

void XmodemLine::block_complete(LineTime now) {
  was_can_ = false;
  if (!reader_.is_good()) return purge(now);
  step_ = Step::AfterBlock;
  deadline_ = now + kSilenceAfterBlock * character_time(settings_);
}

void XmodemLine::judge_block(LineTime now) {
  if (reader_.number() == number_) return block_good(now);
  const auto before = static_cast<std::uint8_t>(number_ - 1);
  if (reader_.number() == before && !is_first_block_) {
    say(kAck);  // our answer was lost: this block is already accepted
    step_ = Step::AwaitBlock;
    deadline_ = now + asking_period();
    return;
  }
  give_up({Errc::Corrupt,
           fmt::format("block {} came where block {} belongs",
                       static_cast<unsigned>(reader_.number()), static_cast<unsigned>(number_))},
          now);
}

void XmodemLine::block_good(LineTime now) {
  std::string text;
  for (const std::byte character : reader_.data()) {
    const DecodedCharacter decoded = decoder_.decode(character);  // padding adds no text
    if (decoded.text) text += *decoded.text;
  }
  emit_text(text);
  ++number_;
  tries_ = 0;
  is_first_block_ = false;
  was_eot_refused_ = false;
  if (is_ready_) return accept_block(now);
  step_ = Step::Withhold;
  deadline_.reset();
}

void XmodemLine::accept_block(LineTime now) {
  say(kAck);
  step_ = Step::AwaitBlock;
  deadline_ = now + asking_period();
}

/// Noise: the sender must be silent before the receiver asks again.
void XmodemLine::purge(LineTime now) {
  if (step_ != Step::Purge) purging_since_ = now;
  if (now - purging_since_ > kLongestNonsense) {
    return give_up({Errc::Corrupt, "what comes is no XMODEM, and it does not end"}, now);
  }
  step_ = Step::Purge;
  deadline_ = now + kSilence;
}

void XmodemLine::ask_again(LineTime now) {
  if (is_first_block_) return ask(now);
  if (++tries_ > settings_.retries) {
    return give_up({Errc::Corrupt, fmt::format("block {} did not come right, asked {} times",
                                               static_cast<unsigned>(number_), tries_)},
                   now);
  }
  say(kNak);
  step_ = Step::AwaitBlock;
  deadline_ = now + asking_period();
}

void XmodemLine::set_ready(bool is_ready, LineTime now) {
  is_ready_ = is_ready;
  if (is_ready && step_ == Step::Withhold) accept_block(now);
}

void XmodemLine::tick(LineTime now) {
  if (!deadline_ || *deadline_ > now) return;
  switch (step_) {
    case Step::AwaitStart:
      return give_up({Errc::Timeout, "the receiver did not ask for the first block"}, now);
    case Step::AwaitAnswer:
      return give_up(
          {Errc::Timeout, fmt::format("no answer to block {}", static_cast<unsigned>(number_))},
          now);
    case Step::AwaitEnd:
      return say_end(now);
    case Step::Ask:
      return ask(now);
    case Step::AfterBlock:
      return judge_block(now);
    case Step::AfterEot:
      was_eot_refused_ = true;
      return ask_again(now);
    case Step::AwaitBlock:
    case Step::InBlock:
    case Step::Purge:
      return ask_again(now);
    case Step::Idle:
      return drop_request();
    default:
      deadline_.reset();
  }
}

}  // namespace dripline::wire
