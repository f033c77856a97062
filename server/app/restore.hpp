#pragma once

#include "protocol/base/clock.hpp"
#include "server/app/settings.hpp"

namespace dripline::app {

/// `dncd --restore`: brings a backup into the state folder, which must be missing or empty, prints
/// how far it is on standard output, and returns its name. Errors: NotFound (no such backup, or
/// none at all), Busy (the folder is in use), Corrupt, Io.
Result<std::string> restore_backup(const Settings& settings);

}  // namespace dripline::app
