#pragma once

#include <memory>
#include <string>
#include <utility>

#include "gateway/line/inbound/rule_set.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/releases.hpp"
#include "server/ports/requests/offer_trail.hpp"
#include "server/ports/requests/requested_line.hpp"

namespace dripline::ports {

/// Does what an operator asks for from the control: sends a program, lists them, begins the last
/// run again at a block, begins a run of the next job. What cannot be done is reported to the
/// control where it can show it: a refused request, or a program of comments when the rules name
/// one. On the machine's strand.
///
/// The rules define what a text from the control does. A request of the protocol (DC1, NAK or C of
/// XMODEM, a TNC's heading) sends nothing by itself: it is there for the run that is started next,
/// unless the port's `offer` defines what else such a control gets.
class RemoteRequestHandler {
 public:
  /// A control that asks for "the next program" is offered each one once. It begins with the first
  /// one again when it has been silent for so long: after the answer that none is left, or in the
  /// middle.
  static constexpr std::chrono::seconds kOfferLife{60};
  static constexpr std::chrono::minutes kOfferPause{10};

  struct Parts {
    const storage::Store& store;
    library::Releases& releases;
    std::shared_ptr<RequestedLine> line;
    const Clock& clock;
    std::string machine;
    std::string port = {};  ///< whose transfers the store has; empty: it has none
    std::string reply;      ///< the program that messages come in; empty: none do
    wire::Offer offer = wire::Offer::None;
    bool refuses = false;  ///< a request that is not answered at once is worth nothing: blockwise
    bool tells_aborts =
        false;  ///< the protocol reports to the control that a program is broken off
    bool follows_answers = false;  ///< on_answer_over is called
  };
  explicit RemoteRequestHandler(Parts parts)
      : parts_(std::move(parts)), offered_(parts_.store.audit, parts_.clock, parts_.machine) {}

  /// Send, Directory, Restart or NextJob; `asked`: when the control's text arrived. One that waited
  /// for longer than an operator's command may is left without an answer.
  void carry_out(line::RuleAction action, const std::string& argument, SteadyTime asked);
  /// A request of the protocol itself.
  void answer(const wire::TransferRequest& request);
  /// What `answer` put on the line has been sent, or not.
  void on_answer_over(const SendEnd& end) {
    asked_at_ = parts_.clock.steady_now();
    offered_.end(end);
  }
  /// All programs of a transfer to the control have arrived.
  void on_transfer_completed() {
    is_sent_since_ = true;
    on_run_completed();
  }
  /// A run's program has arrived.
  void on_run_completed() {
    if (parts_.offer == wire::Offer::All) offered_.close("another program went through since");
  }
  /// A run is on the line, or was.
  void on_run() { is_sent_since_ = false; }
  /// The control knows by its protocol that what it was in the middle of was broken off.
  void on_release_refused() {
    if (!parts_.tells_aborts) return;
    offers_.reset();  // it begins with the first one again
    offered_.close("the control knows that it was broken off");
  }
  /// The end of a run is stored, or may be.
  void on_run_stored() {
    // What was started meanwhile may have answered the request.
    if (std::exchange(waits_for_end_, false) && parts_.line->is_asked()) repeat();
  }
  /// The end of the last run is still to be stored before the request can be answered.
  bool waits_for_end() const { return waits_for_end_; }
  /// Short messages to the control, as a program; nothing when there is no program for it.
  void report(const std::vector<std::string>& words) const;

 private:
  void leave(const wire::TransferRequest& request) const;
  Result<void> check_age() const;
  void send(const std::string& name, bool is_request);
  void restart(const std::string& block);
  void repeat();
  void start_next_job();
  void send_listing(bool is_request);
  void send_next();
  Result<void> check_last_program() const;
  Result<void> check_last_offer();
  /// The audit entry comes before the control gets anything.
  Result<void> note(std::string action, std::string subject, std::string detail) const;
  std::function<Result<void>(const storage::Run&)> note_start(std::string action) const;
  Result<void> list_offers();
  /// The library's programs, each with the revision that this machine gets as its latest.
  Result<std::vector<storage::ProgramSummary>> programs() const;
  /// `refusal`: what the control has a message of its own for.
  void refuse(const std::string& why, bool is_request,
              library::Refusal refusal = library::Refusal::None) const;
  void send_answer(std::string name, std::string text) const;
  RequestedLine::Started on_started(bool is_request) const;
  /// The library's name for what the control calls `name`. Errors: NotFound.
  Result<std::string> find_program(const std::string& name) const;
  /// The same for a request: only what is known to be for the machine's control.
  Result<std::string> find_offered(const std::string& name) const;
  std::string control() const;

  Parts parts_;
  OfferTrail offered_;
  /// Of a control that asks for one program after the other (its directory, all programs); none
  /// between such sequences.
  std::optional<std::vector<storage::Revision>> offers_;
  std::size_t next_offer_ = 0;
  bool is_end_told_ = false;
  bool waits_for_end_ =
      false;  ///< the tape is asked for again, and its run's end is not stored yet
  bool is_sent_since_ = false;  ///< a transfer went through after the last run
  SteadyTime asked_at_{};
  std::optional<SteadyTime> asked_;  ///< by a text; absent: by the protocol
};

}  // namespace dripline::ports
