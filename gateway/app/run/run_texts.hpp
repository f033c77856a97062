#pragma once

#include <string>
#include <string_view>

#include "gateway/interpreter/core/interpreter.hpp"
#include "protocol/dds/record_text.hpp"

/// The interpreter's and the machine's terms as records write them.
namespace dripline::gateway {

dds::ProbeText probe_text(const interpreter::Probe& probe);
dds::AlarmText diagnostic_text(const interpreter::Diagnostic& diagnostic);
std::string_view to_text(interpreter::StopKind kind);
/// "G54", "G59.3", "G54.1 P7"; empty: the control has none.
std::string work_system_text(const interpreter::ActiveModes& modes);

/// Valid UTF-8 of at most `max_bytes`: programs may hold any byte, records only text. What is not
/// UTF-8 becomes U+FFFD.
std::string valid_text(std::string_view bytes, std::size_t max_bytes);

/// Reasons and alarm texts are cut at this, so that their JSON always fits a record.
inline constexpr std::size_t kMaxReason = 512;

inline constexpr std::string_view kTestRun = "test run: nothing moves";

}  // namespace dripline::gateway
