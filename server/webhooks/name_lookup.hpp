#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::webhooks {

/// The addresses of a host as text, in the order in which they are tried. It may take long, and
/// nothing can end it. Errors: Timeout (none is known).
using NameLookup = std::function<Result<std::vector<std::string>>(const std::string& host)>;

/// The system's (getaddrinfo).
Result<std::vector<std::string>> look_up(const std::string& host);

/// Waits for `lookup` until `end` or `stop`; it then ends by itself in a thread that uses nothing
/// but what it owns. Bounded: kMaxLookups at a time. Errors: those of `lookup`, Timeout,
/// LimitExceeded.
Result<std::vector<std::string>> addresses_of(const std::string& host, const NameLookup& lookup,
                                              SteadyTime end, const std::stop_token& stop);

inline constexpr int kMaxLookups = 64;  ///< in a process, those with them that are not waited for

}  // namespace dripline::webhooks
