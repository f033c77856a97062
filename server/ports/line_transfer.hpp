#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/machines/run_sources.hpp"
#include "server/ports/line_types.hpp"
#include "server/ports/port_control.hpp"
#include "server/ports/programs/broken_program.hpp"
#include "server/ports/programs/transfer_log.hpp"

/// Programs to a control's memory and out of it, without a run. The functions wait for the line's
/// answer, at most kTransferAnswerLimit; not to be called on a strand or a line's thread.
namespace dripline::ports {

inline constexpr std::chrono::seconds kTransferAnswerLimit{10};

/// A line, where its transfers are kept, and whether its control is in no program.
struct LineInUse {
  std::shared_ptr<PortLine> line;
  std::shared_ptr<TransferLog> log;
  const ResetGate& resets;
};

/// What is sent for these programs over this line. Errors: those of PortControl::send that the line
/// itself has no part in.
Result<SendJob> make_transfer(const machines::RunSources& sources, const LineView& port,
                              const std::vector<ProgramChoice>& programs);
/// Promises: PortControl.
Result<PortTransfer> send_programs(const LineInUse& in_use, const machines::RunSources& sources,
                                   const std::vector<ProgramChoice>& programs);
Result<void> receive_program(const LineInUse& in_use);
Result<void> stop_transfer(const std::shared_ptr<PortLine>& line, const std::string& reason);

}  // namespace dripline::ports
