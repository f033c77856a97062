#include <algorithm>

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/tnc_blockwise.hpp"

namespace dripline::wire {
namespace {

constexpr std::string_view kHeadingTypes = "%HD";

std::string_view without_zeros(std::string_view number) {
  const auto first = number.find_first_not_of('0');
  return first == number.npos ? number.substr(0, number.empty() ? 0 : 1) : number.substr(first);
}

bool is_same_program(std::string_view one, std::string_view other) {
  return one.empty() || other.empty() || without_zeros(one) == without_zeros(other);
}

/// The device at a control: answers its headings.
///
///     idle     heading E: SendProgram, heading A: TakeProgram; broken: NAK
///     sending  ACK and blocks; after the last one ETX, the control's EOT
///     receiving  ACK for each block until ETX, EOT
class TncBlockwiseHost final : public TncBlockwise {
 public:
  explicit TncBlockwiseHost(const LineSettings& settings) : TncBlockwise(settings, Role::Host) {}

  Result<void> begin_send(std::string_view name, LineTime now) override {
    if (auto idle = check_idle(); !idle) return idle;
    if (pending_ && pending_->kind != TransferRequest::Kind::SendProgram) {
      return fail(Errc::Busy, "the control wants to send program {}", pending_->name);
    }
    begin_transfer(Phase::Sending, std::string(name));
    armed_ = std::string(name);
    wait_for(Wait::Heading, after_start_limit(now));
    if (const auto asked = std::exchange(pending_, std::nullopt)) begin_armed(*asked, now);
    return {};
  }

  Result<void> begin_receive(std::string_view name, LineTime now) override {
    if (auto idle = check_idle(); !idle) return idle;
    if (pending_ && pending_->kind != TransferRequest::Kind::TakeProgram) {
      return fail(Errc::Busy, "the control wants program {}", pending_->name);
    }
    const bool is_asked = std::exchange(pending_, std::nullopt).has_value();
    begin_receiving(std::string(name), now);
    armed_ = std::string(name);
    is_asked ? accept(now) : wait_for(Wait::Heading, std::nullopt);
    return {};
  }

  Result<void> request(const TransferRequest&, LineTime) override {
    return fail(Errc::Unsupported, "a TNC asks its host; the host cannot ask it");
  }

  /// Without a reason: no program is left, which ends a list of programs.
  Result<void> refuse(std::string_view reason, LineTime) override {
    if (!pending_) return fail(Errc::Conflict, "the control has asked for nothing");
    pending_.reset();
    if (reason.empty()) {
      queue_control(settings_.heidenhain.eot);
    } else {
      refuse_heading(reason);
    }
    return {};
  }

 private:
  void on_heading(const std::string& text, LineTime now) override {
    const auto heading = parse(text);
    if (!heading) return refuse_broken("a heading came that says nothing: " + text);
    if (phase_ != Phase::Idle && wait_ != Wait::Heading) {
      if (text == heading_ && !has_accepted() && !has_received()) return answer_again(now);
      fail_transfer({Errc::Corrupt, "the control gave up the transfer and began again"}, now);
    }
    broken_ = 0;
    heading_ = text;
    if (wait_ == Wait::Heading) return begin_armed(*heading, now);
    if (pending_ && pending_->kind == heading->kind && pending_->name == heading->name) return;
    pending_ = heading;
    emit(*heading);
  }

  /// '%15E': type, number if there is one, E for input into the control, A for output.
  std::optional<TransferRequest> parse(std::string_view text) const {
    if (text.size() < 2 || text.size() > 10) return std::nullopt;
    const bool is_known_type = kHeadingTypes.find(text.front()) != text.npos ||
                               text.front() == settings_.heidenhain.heading;
    const auto number = text.substr(1, text.size() - 2);
    const bool is_digits = number.find_first_not_of("0123456789") == number.npos;
    const bool is_input = text.back() == 'E';
    if (!is_known_type || !is_digits || (!is_input && text.back() != 'A')) return std::nullopt;
    using enum TransferRequest::Kind;
    return TransferRequest{is_input ? SendProgram : TakeProgram, std::string(number)};
  }

  /// The owner has already named the program that is ready.
  void begin_armed(const TransferRequest& heading, LineTime now) {
    const bool is_wanted = (heading.kind == TransferRequest::Kind::SendProgram) == is_sending();
    if (is_wanted && is_same_program(armed_, heading.name)) return accept(now);
    emit_fault({Errc::NotFound, fmt::format("the control asked for '{}', ready is program '{}'",
                                            heading_, armed_)});
    refuse_heading(fmt::format("{} NOT READY", heading.name));
  }

  void accept(LineTime now) {
    queue_control(settings_.heidenhain.ack);
    if (is_receiving()) {
      return wait_for(Wait::Block, after_pause_limit(now, settings_.retries + 1));
    }
    wait_for(Wait::Nothing, std::nullopt);
    send_next(now);
  }

  /// Our ACK was lost, and the control asks again.
  void answer_again(LineTime now) {
    queue_control(settings_.heidenhain.ack);
    if (has_block_out()) resend_block(now);
  }

  void refuse_heading(std::string_view reason) {
    std::string text;
    for (const char c : reason.substr(0, kMaxTncErrorText)) {
      text += c >= ' ' && c < 0x7F && c != settings_.heidenhain.etb ? c : ' ';
    }
    refusal_ = make_tnc_block(settings_.heidenhain.soh, text, settings_.heidenhain);
    refusals_ = 0;
    put_out(refusal_);
  }

  void refuse_broken(std::string text) {
    emit_fault({Errc::Corrupt, std::move(text)});
    if (++broken_ <= settings_.retries) queue_control(settings_.heidenhain.nak);
  }

  void on_ack(LineTime) override { refusal_.clear(); }
  void on_nak(LineTime) override {
    if (refusal_.empty() || !is_out_empty() || ++refusals_ > settings_.retries) return;
    put_out(refusal_);
  }

  void on_etx(LineTime now) override {
    if (is_receiving() && wait_ == Wait::Block) wait_for(Wait::AfterEnd, after_pause_limit(now));
  }

  void on_eot(LineTime now) override {
    refusal_.clear();
    if (phase_ == Phase::Idle || wait_ == Wait::Heading) return;
    if (wait_ == Wait::EndAnswer) return end_transfer(now);
    if (wait_ == Wait::AfterEnd) return end_receiving(now);
    fail_transfer({Errc::Corrupt, "the control ended the transmission"}, now);
  }

  void end_receiving(LineTime now) {
    const auto complete = check_complete();
    complete ? end_transfer(now) : fail_transfer(complete.error(), now);
  }

  void on_stray_block(LineTime) override {
    // Between headings this can only be a broken heading; a control repeats it after a NAK.
    if (phase_ == Phase::Idle) refuse_broken("a block came that is no heading");
  }

  std::optional<LineTime> after_start_limit(LineTime now) const {
    return settings_.start_limit ? std::optional(now + *settings_.start_limit) : std::nullopt;
  }

  void on_limit(LineTime now) override {
    if (wait_ == Wait::Heading) {
      return fail_transfer({Errc::Timeout, "the control did not ask for the program in time"}, now);
    }
    if (wait_ == Wait::AfterEnd) {
      emit_fault({Errc::Timeout, "no EOT after ETX"});
      return end_receiving(now);
    }
    if (wait_ == Wait::EndAnswer && may_try_again()) return put_out(std::string(1, etx()));
    give_up({Errc::Timeout, wait_ == Wait::EndAnswer ? "no EOT in time" : "no block in time"}, now);
  }

  void send_end(LineTime) override {
    begin_tries();
    put_out(std::string(1, etx()));
    wait_for(Wait::EndAnswer, std::nullopt);
  }

  void tell_abort(std::string_view reason) override { refuse_heading(reason); }
  bool is_asked() const override { return pending_.has_value(); }
  void drop_request() override { pending_.reset(); }
  char etx() const { return settings_.heidenhain.etx; }

  std::optional<TransferRequest> pending_;  ///< of the control, not yet answered
  std::string armed_, heading_;
  std::string refusal_;  ///< the error block sent last, until it is acknowledged
  unsigned refusals_ = 0, broken_ = 0;
};

}  // namespace

std::unique_ptr<Discipline> make_tnc_blockwise_host(const LineSettings& settings) {
  return std::make_unique<TncBlockwiseHost>(settings);
}

}  // namespace dripline::wire
