#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

#include "gateway/app/panel/panel_command.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// The connection of the machine's own panel: a Unix socket `panel` in the gateway's
/// state folder, open to its owner only (0600), never on the network. Lines of text in, one answer
/// line for each (README.md, "The panel"). A thread of its own does the reading and writing.
/// Bounded: kMaxConnections at a time, and a new one closes the one that has
/// been silent longest, so that a stop is always heard; one open request each; kMaxPanelLine bytes
/// a line. However a connection ends, the stops that it has sent take effect. What is asked more
/// than kMaxAge ago, or by an end that has closed its connection, is late (PanelRequest::why_late):
/// its sender may have given up, as ask_panel does.
class PanelSocket {
 public:
  static constexpr std::size_t kMaxConnections = 8;
  static constexpr const char* kName = "panel";
  static constexpr std::chrono::milliseconds kMaxAge{2000};  ///< less than ask_panel waits

  /// `on_request` is called on the socket's thread and returns at once. Requests may be answered
  /// until they are destroyed, also after the socket is. Errors: Io.
  static Result<std::unique_ptr<PanelSocket>> open(const std::filesystem::path& folder,
                                                   std::function<void(PanelRequest)> on_request);
  ~PanelSocket();
  PanelSocket(const PanelSocket&) = delete;
  PanelSocket& operator=(const PanelSocket&) = delete;

 private:
  class Server;
  explicit PanelSocket(std::unique_ptr<Server> server);
  std::unique_ptr<Server> server_;
};

/// One request from the other end, and its answer. Errors: NotFound (no gateway has this folder),
/// Timeout (no answer within five seconds), Io.
Result<std::string> ask_panel(const std::filesystem::path& folder, const std::string& line);

}  // namespace dripline::gateway
