#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/serial/line_driver.hpp"

namespace dripline::feed {

/// One item from a line; they arrive in sequence.
struct LineItem {
  enum class What : std::uint8_t {
    Began,    ///< a program; `text` is its name, may be empty
    Text,     ///< of the program
    Ended,    ///< it is complete
    Failed,   ///< it broke off; `text` is the reason
    Offered,  ///< the host wants to send one, `text` is its name: answer with `expect`
    Asked,    ///< the host wants one, `text` is its name
    Fault,    ///< any other fault; `text` describes it
    Channel,  ///< the line is open (empty text), or why it is not
    Steady,   ///< it has stayed open for some time (serial::LineListener::on_steady)
  };
  What what = What::Text;
  std::string text;
};

/// A control's end of a line: takes programs into a memory of limited size, holds the sender while
/// that is full, and sends text back. The line has a thread of its own; everything here may be
/// called from one other thread. Bounds: the memory, plus what the sender sends after being held
/// (beyond kMaxOverrun the program fails); kMaxOutput of text to be sent.
class ControlLine {
 public:
  struct Parts {
    std::string address;
    wire::LineSettings settings;
    std::size_t buffer_bytes = 64 * 1024;  ///< the control's memory for a program being fed
    /// There are items for `take`; called on the line's thread.
    std::function<void()> wake;
    std::function<Result<std::unique_ptr<serial::Channel>>()> open = {};  ///< for tests
  };
  /// The channel may open later. Errors: Unsupported (settings that exclude each other).
  static Result<std::unique_ptr<ControlLine>> start(Parts parts);
  ControlLine(const ControlLine&) = delete;
  ControlLine& operator=(const ControlLine&) = delete;

  /// Everything since the last call.
  std::vector<LineItem> take();
  /// This part of the taken text is used up: its memory is free.
  void release(std::size_t bytes);

  /// Listens for a program, or asks for one by `request`, as soon as the line is not busy sending.
  /// A failure arrives as a Fault; on a line that is listening it is not significant.
  void expect(const wire::TransferRequest* request = nullptr);
  void refuse(std::string reason);
  /// Aborts the program being received, and notifies the host where the protocol can; output stays.
  void abort();
  /// Queues text to be sent. False: there is no room for it.
  bool send(std::string_view text);
  /// The line has been silent for so long that the next text is a new transfer.
  bool is_quiet() const;
  /// Everything queued was sent, or has failed.
  bool has_sent_all() const;

  bool is_open() const { return driver_->is_open(); }
  wire::LineState state() const { return driver_->state(); }
  const std::string& address() const { return parts_.address; }
  const wire::LineSettings& settings() const { return parts_.settings; }

  static constexpr std::size_t kMaxOverrun = 64 * 1024;
  static constexpr std::size_t kMaxOutput = 1024 * 1024;
  static constexpr std::size_t kMaxItems = 4096;

 private:
  explicit ControlLine(Parts parts) : parts_(std::move(parts)) {}
  // On the line's thread
  void on_event(wire::Event& event);
  void on_text(std::string&& text);
  void listen(wire::Discipline& end, wire::LineTime now);
  void pump(wire::Discipline& end, wire::LineTime now);
  void post_pump();
  void resume_line();
  void put(LineItem::What what, std::string text);

  Parts parts_;
  mutable std::mutex mutex_;
  std::vector<LineItem> items_;
  std::size_t held_ = 0;  ///< bytes of text not released
  bool is_ready_ = true;
  std::string output_;
  enum class Sending : std::uint8_t { Nothing, Text, End } sending_ = Sending::Nothing;
  bool is_overrun_ = false;
  bool is_expecting_ = false;                     ///< on the line's thread, as the next ones
  std::optional<wire::TransferRequest> request_;  ///< to be made; none: only listens
  std::atomic<std::int64_t> heard_{0};            ///< steady nanoseconds
  std::unique_ptr<serial::LineDriver> driver_;    ///< last: its thread ends first
};

}  // namespace dripline::feed
