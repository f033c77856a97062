#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/tnc_blockwise.hpp"

namespace dripline::wire {
namespace {

constexpr std::size_t kMaxProgramNumber = 8;
constexpr std::string_view kNoneLeft = "the device has no program left";

/// The control: sends headings to its device, and withholds the ACK of a block while it has no
/// room.
class TncBlockwiseControl final : public TncBlockwise {
 public:
  explicit TncBlockwiseControl(const LineSettings& settings)
      : TncBlockwise(settings, Role::Control) {}

  Result<void> begin_send(std::string_view name, LineTime) override { return ask(name, 'A'); }
  Result<void> begin_receive(std::string_view name, LineTime) override { return ask(name, 'E'); }

  /// Directory, and a program without a name, ask for the next program: the protocol has one
  /// heading for both.
  Result<void> request(const TransferRequest& request, LineTime) override {
    using enum TransferRequest::Kind;
    if (request.kind == TakeProgram) return ask(request.name, 'A');
    return ask(request.kind == Directory ? "" : request.name, 'E');
  }
  Result<void> refuse(std::string_view, LineTime) override {
    return fail(Errc::Unsupported, "a TNC is never asked");
  }

 private:
  Result<void> ask(std::string_view name, char direction) {
    if (auto idle = check_idle(); !idle) return idle;
    if (name.size() > kMaxProgramNumber || name.find_first_not_of("0123456789") != name.npos) {
      return fail(Errc::Unsupported, "a TNC program is named by up to {} digits, not '{}'",
                  kMaxProgramNumber, name);
    }
    const auto& tnc = settings_.heidenhain;
    name_ = name;
    is_output_ = direction == 'A';
    heading_ = make_tnc_block(tnc.soh, tnc.heading + name_ + direction, tnc) + kDc1;
    phase_ = Phase::Requesting;
    begin_tries();
    send_heading();
    return {};
  }

  void send_heading() {
    put_out(heading_, 1);
    wait_for(Wait::HeadingAnswer, std::nullopt);
  }

  void on_ack(LineTime now) override {
    if (wait_ != Wait::HeadingAnswer || !is_out_heard(now)) return;
    if (!is_output_) return begin_receiving(name_, now);
    begin_transfer(Phase::Sending, name_);
    wait_for(Wait::Nothing, std::nullopt);
  }

  void on_nak(LineTime now) override {
    if (wait_ != Wait::HeadingAnswer || !is_out_heard(now)) return;
    if (may_try_again()) return send_heading();
    give_up({Errc::Corrupt, "the device refused the heading again and again"}, now);
  }

  /// A device sends no headings: this is its error text, which ends the transfer.
  void on_heading(const std::string& text, LineTime now) override {
    if (phase_ != Phase::Idle) {
      fail_transfer({Errc::NotFound, fmt::format("the device says: {}", text)}, now);
    }
    queue_control(settings_.heidenhain.ack);
    queue_control(settings_.heidenhain.eot);
  }

  void on_etx(LineTime now) override {
    if (phase_ == Phase::Idle) return queue_control(settings_.heidenhain.eot);  // ours was lost
    if (is_end_of_list(now)) return end_list(now);
    if (!is_receiving() || wait_ != Wait::Block) return;
    const auto complete = check_complete();
    if (!complete) return give_up(complete.error(), now);
    end_transfer(now);
    queue_control(settings_.heidenhain.eot);
  }

  /// A heading without a number asks for the next of all programs. When none is left, the device
  /// sends EOT in place of the ACK, or a second ETX before a block, with or without the ACK.
  bool is_end_of_list(LineTime now) {
    if (!name_.empty() || is_output_ || has_received()) return false;
    return wait_ == Wait::HeadingAnswer ? is_out_heard(now)
                                        : is_receiving() && wait_ == Wait::Block;
  }
  void end_list(LineTime now) {
    fail_transfer({Errc::NotFound, std::string(kNoneLeft)}, now);
    queue_control(settings_.heidenhain.eot);
  }

  void on_eot(LineTime now) override {
    if (phase_ == Phase::Idle) return;
    const bool is_answer = wait_ == Wait::HeadingAnswer;
    fail_transfer(is_answer ? Error{Errc::NotFound, std::string(kNoneLeft)}
                            : Error{Errc::Corrupt, "the device ended the transmission"},
                  now);
  }

  void on_stray_block(LineTime now) override {
    if (phase_ == Phase::Idle) return queue_control(settings_.heidenhain.eot);
    if (wait_ != Wait::HeadingAnswer || is_output_ || !is_out_heard(now)) return;
    // The ACK before it was lost. The block comes again after a refusal.
    begin_receiving(name_, now);
    queue_control(settings_.heidenhain.nak);
  }

  void on_limit(LineTime now) override {
    if (wait_ == Wait::HeadingAnswer && may_try_again()) return send_heading();
    give_up({Errc::Timeout,
             wait_ == Wait::HeadingAnswer ? "the device does not answer" : "no block in time"},
            now);
  }

  void send_end(LineTime) override {
    put_out({settings_.heidenhain.etx, settings_.heidenhain.eot});
    is_ending_ = true;
  }
  void on_out_sent(LineTime now) override {
    if (std::exchange(is_ending_, false)) end_transfer(now);
  }
  void tell_abort(std::string_view) override { queue_control(settings_.heidenhain.eot); }
  void transfer_over(LineTime now) override {
    is_ending_ = false;
    TncBlockwise::transfer_over(now);
  }

  std::string name_, heading_;
  bool is_output_ = false, is_ending_ = false;
};

}  // namespace

std::unique_ptr<Discipline> make_tnc_blockwise_control(const LineSettings& settings) {
  return std::make_unique<TncBlockwiseControl>(settings);
}

}  // namespace dripline::wire
