#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/library/programs.hpp"
#include "server/ports/programs/inbound_splitter.hpp"
#include "server/ports/programs/uploaded_program.hpp"
#include "server/ports/requests/remote_request_handler.hpp"

namespace dripline::ports {

/// Takes everything a control sends, sorts it by the port's rules and puts it where it belongs:
/// printed lines become records, programs held revisions, calls are carried out when the line is
/// free. On
/// the machine's strand.
class InboundHandler {
 public:
  struct Parts {
    storage::MachineStore& machines;
    library::Programs& programs;
    std::shared_ptr<LineRecords> records;
    std::string machine, port;
    std::shared_ptr<const RuleSet> rules;
    bool extracts_programs = false;    ///< a text with several programs becomes several
    bool sends_programs_only = false;  ///< the control prints nothing
    RemoteRequestHandler::Parts calls;
  };
  explicit InboundHandler(Parts parts);

  /// `kept` is called when the text is stored, or needs not be.
  void take(const Incoming& incoming, std::function<void()> kept);
  void answer(const wire::TransferRequest& request) { calls_.answer(request); }
  void on_answer_over() { calls_.on_answer_over(); }
  void on_transfer_completed() { calls_.on_transfer_completed(); }
  /// What is printed from now on belongs to this run, until another one is on the line: a control
  /// prints while it executes, which continues after everything has been sent.
  void on_run(const std::string& run) {
    if (run.empty()) return;
    run_ = run;
    calls_.on_run();
  }

 private:
  struct Call {
    RuleAction action = RuleAction::Ignore;
    std::string argument;
  };
  void handle(InboundSplitter::Item& item, std::vector<LineRecords::Entry>& entries);
  void handle_line(const std::string& line, std::vector<LineRecords::Entry>& entries);
  std::string current_run();
  std::string machine_control() const;
  void begin_program(const std::string& name);
  void end_program(const std::string& head);
  void store_program(const std::string& name);
  void report(const std::string& words);
  void call(RuleAction action, const std::string& argument);
  void do_calls();

  Parts parts_;
  RemoteRequestHandler calls_;
  InboundSplitter splitter_;
  std::optional<UploadedProgram> program_;
  std::string program_name_;  ///< as the protocol carried it
  std::string run_;
  bool is_in_transfer_ = false;
  std::string early_damage_;   ///< since the last program began; the next may begin after it
  std::vector<Call> waiting_;  ///< for the end of the transfer they came in; at most kMaxWaiting
};

}  // namespace dripline::ports
