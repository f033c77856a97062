#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/line/block_ledger.hpp"
#include "gateway/line/text_source.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/wire/discipline.hpp"

namespace dripline::line {

enum class JobKind : std::uint8_t {
  Run,
  Transfer,  ///< programs sent as they are, without a run
  Answer,    ///< a text that answers a request of the control
};

/// Something to be sent over a line: a run's program or several programs, fetched piece by piece,
/// or an answer to the control, which is here as a whole.
struct SendJob {
  JobKind kind = JobKind::Run;
  std::string id;                      ///< a run's is the run's own
  std::string name;                    ///< of the program, for protocols that carry it
  std::vector<std::string> programs;   ///< of a transfer, for people
  std::shared_ptr<TextSource> source;  ///< where pieces come from
  std::uint64_t size = 0;              ///< its bytes
  std::uint64_t prefetch = 0;          ///< bytes ahead of the line; 0: LineSession::kPrefetch
  std::uint64_t first_byte = 0;        ///< where the run begins
  std::uint64_t first_line = 1;        ///< the same in blocks
  std::string head = {};               ///< sent before it, and not counted
  std::optional<std::string> text;
};

/// What is known of the job on the line now.
struct SendProgress {
  JobKind kind = JobKind::Run;
  std::string id;
  std::uint64_t size = 0;
  BlockPlace sent;  ///< sent, or accepted where the protocol checks
  /// Bytes of the program since the run's beginning that may have left: what a kill makes uncertain
  /// lies between.
  std::uint64_t offered = 0;
  bool is_checked = false;  ///< the other end acknowledges what it takes
  bool is_held = false;     ///< by the operator
  bool is_waiting_for_line = false;
};

enum class SendOutcome : std::uint8_t { Completed, Aborted, Interrupted };
std::string_view to_string(SendOutcome outcome);
struct SendEnd {
  SendProgress progress;
  SendOutcome outcome = SendOutcome::Completed;
  std::string reason;
  bool may_have_left = true;  ///< a part of it; it did not wait for the control's start to its end
};

/// What the control sends, in order. Received text ends with Ended or Failed.
struct Incoming {
  enum class What : std::uint8_t { Began, Text, Damaged, Ended, Failed };
  What what = What::Text;
  std::string text;  ///< Began: the name, when the protocol carries it; Text; Damaged, Failed: why
  bool is_program = false;  ///< Began: a program was requested; it is no printed line
  /// Began: just after the line was opened, before anything was sent, so that it may be the rest of
  /// what came before.
  bool may_be_rest = false;
  /// Began: the first since the line was opened, not long after: it may be the rest of what the
  /// control began before, though a silence was between.
  bool is_first = false;
  /// Ended: by silence, so its last line may not be whole. Damaged: text is missing.
  bool is_cut = false;
  SteadyTime arrived{};  ///< at the line, before it waited for its listener
};

/// What a session asks of its owner. Called on the line's thread; must return soon.
class SessionHost {
 public:
  virtual ~SessionHost() = default;
  /// Program text from that byte on; answered with LineSession::supply or supply_failed.
  virtual void fetch(const SendJob& job, std::uint64_t offset) = 0;
  virtual void on_sent(const SendEnd& end) = 0;
  /// Answered with LineSession::kept once it is where it stays.
  virtual void on_incoming(Incoming incoming) = 0;
  virtual void on_request(const wire::TransferRequest& request) = 0;
  virtual void on_release_refused(const wire::ReleaseRefused& /*refused*/) {}
  virtual void on_fault(const Error& error) = 0;
  /// Of the job on the line: before more of it may leave, and when more was sent.
  virtual void on_progress(const SendProgress& /*progress*/) {}
};

/// One port's state: what is being sent, what is being received. Without threads, clocks or
/// storage: everything comes in by calls, all from the line's thread (`line` is the discipline at
/// hand), and goes out through the host.
///
/// Text waits in the discipline for at most half a second of the line's time, so that a hold or an
/// abort is felt soon; up to kPrefetch more waits here. Received text that is not yet kept holds
/// the other end up from kHoldBacklog on.
class LineSession {
 public:
  static constexpr std::size_t kPrefetch = 64 * 1024;
  static constexpr std::size_t kHoldBacklog = 1024;
  /// A control that does not let itself be held loses what comes beyond this.
  static constexpr std::size_t kMaxBacklog = 1024 * 1024;
  /// A run that waits for a lost line to come back is given up after this.
  static constexpr std::chrono::minutes kLineLimit{5};
  /// How long the rest of a program that was cut off is expected.
  static constexpr std::chrono::minutes kRestLimit{10};

  LineSession(const wire::LineSettings& settings, SessionHost& host);

  /// Errors: Busy, and those of begin_send.
  Result<void> begin(SendJob job, wire::Discipline& line, wire::LineTime now);
  /// Has the control send a program, where the protocol lets a host begin (XMODEM). Errors: Busy,
  /// and those of begin_receive.
  Result<void> begin_receive(wire::Discipline& line, wire::LineTime now);
  /// Ends what comes in, unless something is being sent beside it. False: there is no such thing.
  bool stop_receiving(const std::string& reason, wire::Discipline& line, wire::LineTime now);
  /// These concern the job with that id; nothing happens when it is another one's turn.
  bool hold(const std::string& id);
  bool resume(const std::string& id, wire::Discipline& line, wire::LineTime now);
  bool abort(const std::string& id, const std::string& reason, wire::Discipline& line,
             wire::LineTime now);
  void supply(const std::string& id, std::uint64_t offset, const std::string& piece,
              wire::Discipline& line, wire::LineTime now);
  void supply_failed(const std::string& id, const Error& error, wire::Discipline& line,
                     wire::LineTime now);
  /// So much of the received text is where it stays.
  void kept(std::size_t bytes, wire::Discipline& line, wire::LineTime now);

  void on_event(wire::Event event, wire::Discipline& line, wire::LineTime now);
  void on_room(wire::Discipline& line, wire::LineTime now);
  /// The channel is lost. A checked protocol continues by itself when it is back; with any other,
  /// characters sent may be lost, so only a run of which nothing was sent waits for the line.
  void on_lost(const Error& error, wire::Discipline& line);
  void on_open(wire::Discipline& line, wire::LineTime now);
  /// A program that the control was sending was cut off before this object was created: what comes
  /// first after the line is open is its rest, when it comes within kRestLimit.
  void expect_rest() { is_rest_due_ = true; }
  /// Called some times a second.
  void poll(wire::Discipline& line, wire::LineTime now);
  /// The owner stops, and the line has stopped in that state: what is in progress ends, with all
  /// that was sent. An operator continues after it.
  void stop(const std::string& reason, const wire::LineState& last);

  std::optional<SendProgress> progress() const;
  /// Bytes of the program that were fetched and are not sent yet.
  std::uint64_t text_ahead() const;
  bool is_receiving() const { return is_receiving_; }

 private:
  struct Sending {
    SendJob job;
    BlockLedger ledger;
    std::string text;              ///< fetched, not yet offered
    std::uint64_t next_fetch = 0;  ///< bytes of the program fetched so far end here
    std::uint64_t accepted = 0;
    std::uint64_t offered = 0;  ///< see SendProgress
    bool is_fetching = false, is_fetched = false, is_offered = false, is_held = false;
    bool awaits_start = false;  ///< as the line was counted last
    bool waits_for_line = false;
    std::optional<wire::LineTime> waits_since;
  };
  Result<void> start_over(wire::Discipline& line, wire::LineTime now);
  void fill(wire::Discipline& line, wire::LineTime now);
  bool offer_some(wire::Discipline& line, wire::LineTime now);
  void fetch_more();
  void count(const wire::LineState& line);
  void note_offer(std::size_t size);
  void finish(SendOutcome outcome, std::string reason);
  void on_failed(const Error& error, wire::Discipline& line);
  void begin_receiving(std::string name, wire::LineTime now);
  void end_receiving(Incoming incoming);
  void lose_text();
  void take_text(std::string text, wire::Discipline& line, wire::LineTime now);

  SessionHost& host_;
  const bool is_checked_;
  const std::size_t ahead_;
  /// Silence between two texts of a control; 0: a character begins each.
  const std::chrono::milliseconds idle_end_;
  /// Silence since the line was opened after which a text is no rest; 0: there are none.
  const std::chrono::milliseconds rest_gap_;
  std::optional<wire::LineTime> opened_;  ///< and nothing was sent or received since
  bool is_rest_due_ = false;
  std::optional<Sending> sending_;
  bool is_receiving_ = false;
  bool is_asking_ = false;  ///< what begins next was requested, and reported, by the server
  std::size_t backlog_ = 0;
  bool is_held_off_ = false;  ///< the other end, by the server
  bool is_losing_ = false;    ///< text, since it is not held
};

}  // namespace dripline::line
