#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/text/table.hpp"
#include "clients/lib/api_types.hpp"

/// Machines and runs in words, shared by listings and watches.

namespace dripline::cli {

Style style_of_execution(const std::string& execution);
Style style_of_state(const std::string& state);
bool has_ended(const client::Run& run);

/// "X 12.500 Z -3.000", "X dia 0.9843 Z -0.1181 in"
std::string position_text(const client::MachineStatus& status, const client::Display& display = {});
/// "line 1234 N1200", as far as known.
std::string place_text(const client::MachineStatus& status);
/// Text of the executing block; empty: it is not known.
std::string block_line(const client::MachineStatus& status);
/// How much of the program's text the machine has executed, 0 to 1.
double fraction_executed(const client::MachineStatus& status);
/// "by anna", "by report template bore version 1: part 12 is scrap: D40 is ..."
std::string hold_text(const client::Hold& hold);
/// What its gateway reported last; where it is held, the message says by whom and why.
client::MachineStatus status_of(const client::Machine& machine);
/// One line of what the machine does now.
std::string status_line(const client::Machine& machine);
/// "single_block, dry_run"; empty: none is on.
std::string switches_text(const client::MachineStatus& status);
/// What the machine executes; of one that is not connected, the last that it reported.
Cell execution_cell(const client::Machine& machine);
/// "1 block", "2 blocks"
std::string count_text(std::uint64_t count, std::string_view thing);
Details machine_details(const client::Machine& machine);

/// The state of the run, as lines that fit a terminal of 80 columns; `status` is the machine's when
/// it speaks of this run, or null. When the run waits for an operator, the last says what to type.
std::vector<std::string> run_lines(const client::Run& run, const client::MachineStatus* status,
                                   const client::Display& display = {});
/// The same as one line.
std::string run_line(const client::Run& run, const client::MachineStatus* status,
                     const client::Display& display = {});
/// What it waits for and what an operator types next; empty while it waits for no operator.
std::string waiting_line(const client::Run& run, const client::MachineStatus& status);
/// A record of the run for people: "alarm  line 3  MCH0004 a feed per revolution ...".
std::string record_line(const client::Record& record);
/// How the run ended, in one line.
std::string outcome_line(const client::Run& run);

}  // namespace dripline::cli
