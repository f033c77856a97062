#pragma once

#include <string_view>

namespace dripline::dds {

/// Sends the log of Cyclone DDS to `to` instead of standard error, for the whole process. `to` is
/// called on any thread and must bound its output: each packet of a stranger can cause a line.
void send_log_to(void (*to)(bool is_error, std::string_view text));

}  // namespace dripline::dds
