#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/ports/port_control.hpp"

/// The JSON bodies of requests about serial ports, decoded and checked. Pure. Errors: Syntax,
/// LimitExceeded; each names the member. PortControl checks the values of a port's settings.
namespace dripline::api {

/// `{machine, address, template?, settings?: {key: text, number or boolean}, rules?, enabled?}`.
/// `line` is the first of the settings, so that `baud` and the like override it.
Result<storage::Port> decode_port(const std::string& name, std::string_view body);

/// `{programs: [NAME or NAME@REVISION]}`.
Result<std::vector<ports::ProgramChoice>> decode_transfer(std::string_view body);

/// `{text}`: a control's text as it would be stored.
Result<std::string> decode_rules_text(std::string_view body);

inline constexpr std::size_t kMaxAddress = 255;
inline constexpr std::size_t kMaxSettingValue = 64;
inline constexpr std::size_t kMaxRulesText = 48 * 1024;

}  // namespace dripline::api
