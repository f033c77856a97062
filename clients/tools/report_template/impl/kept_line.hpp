#pragma once

#include <string>
#include <string_view>

namespace dripline::report_template {

/// A line to be compared with another one, and to be shown: in plain characters, each blank once. A
/// hash replaces what is not shown of it.
std::string kept_line(std::string_view line);

}  // namespace dripline::report_template
