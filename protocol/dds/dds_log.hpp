#pragma once

#include <string_view>

namespace dripline::dds {

/// Where what Cyclone DDS says goes, instead of to standard error; for the whole process. `to` is
/// called on any thread and must bound what it writes: a stranger's packets can cause a line each.
void send_log_to(void (*to)(bool is_error, std::string_view text));

}  // namespace dripline::dds
