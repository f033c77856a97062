#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/line/inbound/inbound_router.hpp"
#include "server/library/programs.hpp"
#include "server/ports/line_records.hpp"
#include "server/ports/programs/transfer_log.hpp"
#include "server/ports/programs/uploaded_program.hpp"
#include "server/ports/requests/remote_request_handler.hpp"

namespace dripline::ports {

/// Puts what a control on a port sends where it belongs on the server: printed lines become
/// records, programs held revisions, calls are carried out when the line is free. On the machine's
/// strand.
class InboundHandler final : private line::InboundSink {
 public:
  struct Parts {
    storage::MachineStore& machines;
    library::Programs& programs;
    const LineDirectory& directory;
    std::shared_ptr<LineRecords> records;
    std::shared_ptr<TransferLog> transfers;
    std::string machine, port;
    std::shared_ptr<const line::RuleSet> rules;
    bool extracts_programs = false;    ///< a text with several programs becomes several
    bool sends_programs_only = false;  ///< the control prints nothing
    RemoteRequestHandler::Parts calls;
  };
  explicit InboundHandler(Parts parts);

  /// `kept` is called when the text is stored, or needs not be.
  void take(const line::Incoming& incoming, std::function<void()> kept) {
    arrived_ = incoming.arrived;
    router_.take(incoming, std::move(kept));
  }
  void answer(const wire::TransferRequest& request) { calls_.answer(request); }
  void on_answer_over(const SendEnd& end) { calls_.on_answer_over(end); }
  void on_transfer_completed() { calls_.on_transfer_completed(); }
  void on_run_completed() { calls_.on_run_completed(); }
  void on_run_stored() { calls_.on_run_stored(); }
  void on_release_refused() { calls_.on_release_refused(); }
  /// What is printed from now on belongs to this run, until another one is on the line: a control
  /// prints while it executes, which continues after everything has been sent.
  void on_run(const std::string& run) {
    if (run.empty()) return;
    run_ = run;
    calls_.on_run();
  }

 private:
  bool sends_programs_only() const override;
  void note_kind(bool may_be_program) override;
  void print(std::vector<line::PrintedLine> lines, std::function<void()> kept) override;
  void begin_program() override;
  void add_text(const std::string& text) override;
  void damage(const std::string& how) override;
  void store_program(const std::string& name) override;
  void drop_program() override;
  void cut_off_program(const std::string& why) override;
  void note(const std::string& words) override;
  void carry_out(line::RuleAction action, const std::string& argument) override;
  void answer(const std::string& words) override { calls_.report({words}); }

  std::string current_run();
  std::string machine_control() const;

  Parts parts_;
  RemoteRequestHandler calls_;
  line::InboundRouter router_;
  std::optional<UploadedProgram> program_;
  std::string run_;
  SteadyTime arrived_{};  ///< what is taken
};

}  // namespace dripline::ports
