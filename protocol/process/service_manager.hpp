#pragma once

#include <chrono>
#include <optional>
#include <string_view>

/// The service manager that started this daemon: systemd, for units of Type=notify (sd_notify(3)).
/// Without one the calls do nothing. Any thread.
namespace dripline::process {

/// Whether there is one.
bool has_service_manager();

/// The daemon does its work from now on; `status` is one line for `systemctl status`.
void notify_ready(std::string_view status);
/// The daemon ends itself.
void notify_stopping();

/// How often the manager wants to hear notify_alive (half of WatchdogSec=); nullopt: never.
std::optional<std::chrono::microseconds> alive_interval();
/// To be called by the loop that must not hang, with a new status: the manager restarts a daemon
/// that is silent.
void notify_alive(std::string_view status);

}  // namespace dripline::process
