#pragma once

#include "gateway/machine/linuxcnc/session.hpp"
#include "gateway/machine/streamed/streamed_machine.hpp"

namespace dripline::machine::linuxcnc {

class HelperLink;

/// A running LinuxCNC as what moves the axes. The README names what it cannot do, and its alarms.
class LinuxCncMachine final : public streamed::StreamedMachine {
 public:
  struct Settings {
    ExecutionSink& sink;
    std::shared_ptr<const Clock> clock;
    interpreter::MachineData machine = {};  ///< what the setup states
    SessionLimits limits = {};
  };
  explicit LinuxCncMachine(const Settings& settings);
  ~LinuxCncMachine() override;

  /// Starts the helper for the LinuxCNC that runs the configuration `ini`, and keeps it running.
  void connect(const std::string& ini);

  // -- the link's side, any thread ----------------------------------------------------------------
  void link_opened();
  void link_lost(const std::string& reason);
  struct Outgoing {
    std::string text;      ///< for the FIFO, first
    std::string commands;  ///< for the helper
    bool wants_feed = false, has_feed = false, is_reading = false;
    std::string reopen_reason;
  };
  /// Takes what the helper has written; returns what must be written. To be called every few
  /// milliseconds.
  Outgoing exchange(std::span<const std::byte> bytes, bool is_dry);
  void feed_opened(const std::string& path);
  /// No action begins any more: the link is about to be closed.
  void link_closing();

 private:
  LinuxCncMachine(Settings settings, std::unique_ptr<Session> session);
  void wake() override;

  std::unique_ptr<Session> session_;
  std::unique_ptr<HelperLink> link_;  ///< last: its thread ends first
};

}  // namespace dripline::machine::linuxcnc
