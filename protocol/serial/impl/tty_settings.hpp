#pragma once

#include <termios.h>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::serial {

/// Makes `modes` raw, with the settings' rate and character format and faults marked (PARMRK). Flow
/// control belongs to the discipline: the kernel's would act too late and unseen.
/// Errors: Unsupported (a baud rate or format that ttys do not have, named); `modes` is then
/// unchanged.
Result<void> fill_modes(const wire::LineSettings& settings, termios& modes);

/// What a device made of `wanted`; nullopt-like empty text: all of it. Otherwise what differs.
std::string difference(const termios& wanted, const termios& got);

}  // namespace dripline::serial
