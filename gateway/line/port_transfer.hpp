#pragma once

#include <string>

#include "gateway/line/port_line.hpp"

/// Programs to a control's memory and out of it, without a run: the same on a port of the server
/// and on a gateway. To be called as tasks of the line's owner, as which the answers come, too.
namespace dripline::line {

/// The control does not ask for its programs: what is sent is read at once. With DC1, a heading or
/// an answer to every block the control itself begins each program.
bool sends_at_once(const wire::LineSettings& settings);

/// Nothing is on the line, or only an answer, which is dropped. Errors: Timeout (the line is not
/// open), Busy.
Result<void> check_ready(PortLine& line);
/// Errors: those of check_ready and of LineSession::begin.
void send_programs(PortLine& line, SendJob job, const PortLine::Answer& answer);
/// Asks the control for a program. Errors: Unsupported (only over XMODEM does the receiver begin),
/// those of check_ready.
void receive_program(PortLine& line, const PortLine::Answer& answer);
/// Ends what is sent or received, unless it is a run. Errors: Conflict (there is nothing, or a
/// run).
void stop_transfer(PortLine& line, const std::string& reason, const PortLine::Answer& answer);

/// The end of a transfer, for monitors of the line and its recording.
std::string transfer_words(const SendEnd& end);
/// Whose transfers carry a program's number and nothing else of its name.
bool has_numbered_programs(wire::Flow flow);

}  // namespace dripline::line
