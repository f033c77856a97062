#pragma once

#include <map>
#include <string>

#include "clients/cli/text/table.hpp"
#include "clients/lib/api_types.hpp"

/// What the status window of a control shows: only what the control has, as it has it.

namespace dripline::cli {

/// The position that the control's screen shows, as its operator has chosen: on the machine where
/// nothing is chosen, or the chosen one is not known.
const std::map<std::string, double>& shown_position(const client::MachineStatus& status);
/// "X 12.500 Z -3.000 mm"
std::string with_unit(const std::map<std::string, double>& axes, const client::Display& display);

void add_motion(Details& details, const client::MachineStatus& status,
                const client::Display& display);
/// In the control's order: tool, compensation, programmed feed and speed, coolant ...
void add_modes(Details& details, const client::ActiveModes& modes, const client::Display& display);
/// Texts of blocks, as far as the control shows them and they are at hand.
void add_blocks(Details& details, const client::Screen& screen);
/// Time, distance, feed and blocks of a run, as a control shows them of a program that is fed.
void add_statistics(Details& details, const client::RunStatistics& statistics,
                    const client::Display& display);
/// The five position displays of a control, and where datum, shift, rotation, scale, mirrored axes
/// and the last circle center are.
void add_coordinates(Details& details, const client::MachineStatus& status,
                     const client::Display& display = {});

}  // namespace dripline::cli
