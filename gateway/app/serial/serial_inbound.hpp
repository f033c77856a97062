#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gateway/app/serial/serial_records.hpp"
#include "gateway/app/serial/upload_store.hpp"
#include "gateway/line/inbound/inbound_router.hpp"
#include "gateway/line/port_line.hpp"

namespace dripline::gateway {

/// Puts what the control sends where it belongs on the gateway: printed lines into the outbox,
/// programs on disk until the server has them, requests to the server. One thread.
class SerialInbound final : private line::InboundSink {
 public:
  struct Parts {
    std::string control;
    std::string device;  ///< of the records
    std::shared_ptr<const line::RuleSet> rules;
    const wire::LineSettings& settings;
    SerialRecords& records;
    UploadStore& uploads;
    const Clock& clock;
    std::function<std::string()> run;  ///< that printed lines belong to; may be empty
    /// Why nothing may be sent to the control now.
    std::function<Result<void>()> check_allowed;
    /// What was requested at the control, to be decided by the server.
    std::function<void(line::RuleAction, const std::string& argument)> on_request;
  };
  explicit SerialInbound(Parts parts);
  /// Before anything comes; the line outlives this.
  void use(line::PortLine& port) { port_ = &port; }

  void take(const line::Incoming& incoming, std::function<void()> kept) {
    router_.take(incoming, std::move(kept));
  }
  /// To monitors of the line, and to the control where the rules define how.
  void report(const std::string& words) { router_.tell(words); }
  /// A text that answers what the control requested. Errors: those of `check_allowed`.
  Result<void> send_answer(std::string name, std::string text);
  void answer(const std::string& words) override;

 private:
  bool sends_programs_only() const override { return is_all_programs_; }
  void note_kind(bool may_be_program) override { port_->note_kind(may_be_program); }
  void print(std::vector<line::PrintedLine> lines, std::function<void()> kept) override;
  void begin_program() override;
  void add_text(const std::string& text) override { parts_.uploads.append(text); }
  void damage(const std::string& how) override { parts_.uploads.damage(how); }
  void store_program(const std::string& name) override;
  void drop_program() override { parts_.uploads.drop(); }
  void note(const std::string& words) override { port_->note(words); }
  void carry_out(line::RuleAction action, const std::string& argument) override {
    parts_.on_request(action, argument);
  }

  const Parts parts_;
  const bool is_all_programs_;
  line::InboundRouter router_;
  line::PortLine* port_ = nullptr;
  std::uint64_t uploads_begun_ = 0;
};

}  // namespace dripline::gateway
