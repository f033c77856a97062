#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "server/ports/port_control.hpp"

/// The JSON bodies of serial ports, decoded and checked as those of bodies.hpp. Pure. What a
/// setting's value means is judged by PortControl.
namespace dripline::api {

/// `{machine, address, template?, settings?: {key: text, number or boolean}, rules?, enabled?}`.
/// `line` comes first of the settings, so that `baud` and its like change what it says. Errors:
/// Syntax, LimitExceeded; each names the member.
Result<storage::Port> decode_port(const std::string& name, std::string_view body);

/// `{programs: [NAME or NAME@REVISION]}`.
Result<std::vector<ports::ProgramChoice>> decode_transfer(std::string_view body);

/// `{text}`: what a control sent, as it would be kept.
Result<std::string> decode_rules_text(std::string_view body);

inline constexpr std::size_t kMaxAddress = 255;
inline constexpr std::size_t kMaxSettingValue = 64;
inline constexpr std::size_t kMaxRulesText = 48 * 1024;

}  // namespace dripline::api
