#pragma once

#include <string_view>

/// The alarms and errors of boards of the Grbl 1.1 class, by number, in our own words.
/// Sources: the code tables that come with Grbl 1.1 and grblHAL.
namespace dripline::machine::grbl {

/// What has happened, and whether the position is still right.
std::string_view alarm_text(int code);
/// The axes have stopped under control, and the board knows where: of the alarm with this number.
bool keeps_position(int alarm);
/// Why the board did not take a line.
std::string_view error_text(int code);

}  // namespace dripline::machine::grbl
