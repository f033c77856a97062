#pragma once

#include <condition_variable>
#include <mutex>
#include <variant>
#include <vector>

#include "gateway/app/panel/panel_command.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

struct ServerSeen {
  bool is_connected = false;
};
struct StopRequested {
  int signal = 0;
};
/// The line has items for `take`.
struct LineChanged {};
using Incoming = std::variant<dds::Command, dds::RecordAck, dds::BlockData, ServerSeen,
                              StopRequested, LineChanged, PanelRequest, dds::LineRequest>;

/// Messages from other threads to the gateway's own thread. Bounded: program text and commands
/// beyond the bound are dropped; their sender repeats them when the answer is missing. Requests of
/// the machine's panel are never dropped; the panel bounds them itself.
class Inbox {
 public:
  /// Called from any thread; never waits.
  void post(Incoming incoming);
  /// For the owner: everything posted so far; waits until there is something, or until `deadline`.
  std::vector<Incoming> take(SteadyTime deadline);

  /// For the owner while it waits for something else: the requests of the panel alone, at once.
  std::vector<PanelRequest> take_panel();

  static constexpr std::size_t kMaxBlocks = 160;  ///< of at most 32 KiB each
  static constexpr std::size_t kMaxOthers = 1024;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Incoming> waiting_;
  std::size_t blocks_ = 0, others_ = 0;
};

}  // namespace dripline::gateway
