#pragma once

#include "gateway/machine/grbl/board_session.hpp"
#include "gateway/machine/grbl/operator_tool_change.hpp"
#include "gateway/machine/streamed/streamed_machine.hpp"

namespace dripline::machine::grbl {

class BoardLink;

/// A board of the Grbl 1.1 class (Grbl, grblHAL) as what moves the axes. The README names what it
/// cannot do, and its alarms.
///
/// The line's functions are called by BoardLink, or a test.
class GrblMachine final : public streamed::StreamedMachine {
 public:
  struct Settings {
    ExecutionSink& sink;
    std::shared_ptr<const Clock> clock;
    interpreter::MachineData machine = {};  ///< what the setup states; the board must agree
    SessionLimits limits = {};
  };
  explicit GrblMachine(const Settings& settings);
  ~GrblMachine() override;

  /// Connects to the board at `address` and keeps the connection (see board_link.hpp).
  void connect(const std::string& address);

  // -- the line's side, any thread ----------------------------------------------------------------
  void line_opened();
  void line_lost(const std::string& reason);
  /// Takes what came; returns what must be written. To be called at least every 10 ms.
  BoardOutput exchange(std::span<const std::byte> bytes);
  /// The line is about to be closed: a board that executes a program is held, one that homes is
  /// reset.
  void line_closing();
  /// Why the line should be opened again; empty: it should not.
  std::string reopen_reason() const;
  bool may_open() const;

  // -- the owner's side ---------------------------------------------------------------------------
  void begin(const interpreter::Position& at) override;
  interpreter::EventSink& events() override { return tool_change_; }
  void begin_probe(const interpreter::Probe& probe) override;

 private:
  GrblMachine(const Settings& settings, std::unique_ptr<BoardSession> session);
  void wake() override;

  OperatorToolChange tool_change_;  ///< owner's thread only
  std::unique_ptr<BoardSession> session_;
  std::unique_ptr<BoardLink> link_;  ///< last: its thread ends first
};

}  // namespace dripline::machine::grbl
