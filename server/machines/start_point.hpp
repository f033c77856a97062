#pragma once

#include <string_view>

#include "server/machines/machine_control.hpp"

namespace dripline::machines {

/// Where a run is to begin, as people write it: `N120` or `120` the block with that N number, `L7`
/// the seventh line, `B4096` a byte, `T3` a tool, `+25` as many blocks skipped. Errors: Syntax.
Result<StartPoint> parse_start_point(std::string_view text);
/// As a gateway takes it: one of the above; empty for the program's beginning.
std::string start_text(const StartPoint& point);
/// The same, with the other options of the start: "N120 pass=3 memory=begin"; or "restart=RUN
/// at=executed".
std::string start_argument(const StartRequest& request);
/// The switch of its test run is on.
bool is_testing(const MachineView& view);
/// "O0200 revision 3 on mill-3", for the audit trail; "test run of ..." where it asks for one, or
/// the machine's switch is on.
std::string audit_text(const MachineControl& machines, const storage::Run& run, bool asks_for_test);

}  // namespace dripline::machines
