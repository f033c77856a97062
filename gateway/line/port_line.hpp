#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "gateway/line/line_session.hpp"
#include "gateway/line/loss_log.hpp"
#include "gateway/line/port_view.hpp"
#include "gateway/line/recording/flight_recorder.hpp"
#include "protocol/serial/line_driver.hpp"

namespace dripline::line {

/// How lines are opened: serial::LineDriver::start, or a test's.
using LineOpener =
    std::function<Result<std::unique_ptr<serial::LineDriver>>(serial::LineDriver::Parts)>;

using Task = std::function<void()>;
using PostTask = std::function<void(Task)>;

/// What happens on a port. All at the owner's place for tasks, one at a time, but `on_progress`.
struct PortListener {
  /// `kept` is called, on any thread, once the text is where it stays.
  std::function<void(Incoming, std::function<void()> kept)> on_incoming;
  std::function<void(const SendEnd&)> on_sent;
  std::function<void(const wire::TransferRequest&)> on_request;
  std::function<void()> on_change;  ///< of what `view` shows; not for every character
  /// On the line's thread, which waits: before more of a job may leave, and when more was sent. May
  /// be empty.
  std::function<void(const SendProgress&)> on_progress = {};
  /// The control knows that what it was in the middle of was broken off. May be empty.
  std::function<void()> on_release_refused = {};
};

/// One port in use: its driver, its session on the driver's thread, its recorder, and the path from
/// there to the place where its owner waits for storage. Any thread; alive while tasks need it.
class PortLine final : public std::enable_shared_from_this<PortLine>, private SessionHost {
 public:
  struct Parts {
    PortNames names;
    wire::LineSettings settings;
    const Clock& clock;
    /// Runs tasks one after the other, in the order of posting, never inside of the call. What is
    /// posted when the owner has stopped is dropped.
    PostTask post;
    /// Likewise, for what never waits for storage: text that is near (TextSource::near). Empty: all
    /// text is read by tasks of `post`.
    PostTask post_near = {};
    LineOpener open;  ///< empty: serial::LineDriver::start
    /// False: another server may use the line (LineDriver::Parts::may_transmit). Any thread. Empty:
    /// it is ours alone.
    std::function<bool()> may_send = {};
    FlightRecorder::Options recording;
    std::function<void(const PortTraffic&)> on_traffic;
    PortListener listener;
    bool is_upload_broken = false;  ///< LineSession::expect_rest
    LineMemory before = {};         ///< of a former life
    /// What a next life has to know, before a text may leave and when it has ended. On the line's
    /// thread. Errors: nothing of the text may leave. May be empty.
    std::function<Result<void>(const LineMemory&)> keep = {};
  };
  /// Called as a task, once, with what came of it; of hold, resume and abort as one of `post_near`:
  /// it must not wait.
  using Answer = std::function<void(const Result<void>&)>;

  static std::shared_ptr<PortLine> make(Parts parts);
  ~PortLine() override;
  /// Opens the line; when that cannot even be tried, `view` shows why.
  void open();
  /// In order: the line is closed, what was in progress ends with the reason, the recorder is
  /// flushed. Later calls find a closed line.
  void close(const std::string& reason);

  LineView view() const;
  std::optional<SendProgress> progress() const;
  /// A run is on the line, or the control is sending a program; stray characters and what is
  /// printed do not count.
  bool is_busy() const;
  /// Whether what comes in may be a program.
  void note_kind(bool may_be_program);
  /// Why what comes in cannot be stored now; empty: it can. Shown before all other fault.
  void note_store_fault(const std::string& words);
  FlightRecorder& recorder() { return recorder_; }
  const PortNames& names() const { return parts_.names; }
  void post(Task task) const { parts_.post(std::move(task)); }

  void begin(SendJob job, Answer answer);
  /// Has the control send a program (LineSession::begin_receive).
  void begin_receive(Answer answer);
  void stop_receiving(const std::string& reason, Answer answer);
  void hold(const std::string& id, Answer answer);
  void resume(const std::string& id, Answer answer);
  void abort(const std::string& id, const std::string& reason, Answer answer);
  /// Whatever is sent then, also what `begin` was called for just before this. Errors: Conflict
  /// (nothing is).
  void abort_any(const std::string& reason, Answer answer);
  /// A program replaces an answer that the control may never fetch. Errors: Busy (the control asks
  /// for nothing: it is reading the answer, and would take the program for its rest).
  Result<void> drop_answer();
  /// Answers to what the control asked for.
  void refuse(const std::string& reason);
  void accept_receive(const std::string& name);
  void note(const std::string& text);
  /// More text of a job has come, as a task.
  void on_text();
  /// Bytes that were read and are not sent yet: they wait in the session or in the discipline.
  std::uint64_t text_ahead() const;
  /// Some times a second, as a task: counts, looks at waits, flushes the recorder.
  void tick();

 private:
  using Work = std::function<void(wire::Discipline&, wire::LineTime)>;
  explicit PortLine(Parts parts);
  serial::LineListener line_listener();
  bool with_line(Work work);
  using Ask = std::function<Result<void>(wire::Discipline&, wire::LineTime)>;
  void ask(Ask work, Answer answer);
  void ask_near(Ask work, Answer answer);
  void ask_and_answer(Ask work, Answer answer, const PostTask& post);
  void on_channel(const Error* lost);
  void on_steady();
  void log_line(const std::optional<LossLog::Message>& message) const;
  void refresh();
  void set_fault(const std::string& words);
  void watch_wait();
  std::optional<PortTransfer> show_transfer(const SendJob& job);
  void take_back(std::optional<PortTransfer> before);
  void end_transfer(const SendEnd& end);
  Result<void> keep_memory();
  void answer_request();
  /// Text that the session waits for.
  struct Wanted {
    std::string id;
    std::shared_ptr<TextSource> source;
    std::uint64_t offset = 0, size = 0, piece = 0;
  };
  void post_read(Wanted wanted);
  void read_piece(const Wanted& wanted);
  void supply(const Wanted& wanted, Result<std::string> piece);

  void fetch(const SendJob& job, std::uint64_t offset) override;
  void on_sent(const SendEnd& end) override;
  void on_incoming(Incoming incoming) override;
  void on_request(const wire::TransferRequest& request) override;
  void on_release_refused(const wire::ReleaseRefused& refused) override;
  void on_fault(const Error& error) override;
  void on_progress(const SendProgress& progress) override;

  const Parts parts_;
  FlightRecorder recorder_;
  LossLog losses_;       ///< on the line's thread
  LineSession session_;  ///< on the line's thread; when the line is closed, on the closing thread
  mutable std::mutex mutex_;
  std::unique_ptr<serial::LineDriver> driver_;
  bool is_closed_ = false;
  std::string fault_;
  std::optional<SendProgress> progress_;
  /// The last one; or an answer that a control reads, or was cut off in, without asking for it.
  std::optional<PortTransfer> transfer_;
  std::optional<PortTransfer> before_answer_;  ///< what was shown before it
  bool may_be_in_text_, was_in_text_ = false;  ///< LineMemory; before the text on the line
  bool is_receiving_ = false;
  bool may_be_program_ = true;  ///< what is being received
  std::string store_fault_;
  std::optional<UtcTime> waiting_since_;
  std::optional<PortRequest> request_;
  std::uint64_t text_ahead_ = 0;
  std::optional<Wanted> wanted_;  ///< its text has not come; used by tasks only
};

}  // namespace dripline::line
