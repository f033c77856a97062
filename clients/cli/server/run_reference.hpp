#pragma once

#include <string>

#include "clients/lib/client.hpp"

namespace dripline::cli {

/// The help text of every verb for its run.
inline constexpr const char* kRunHelp = "The run: its id, the beginning of it, or latest";

/// The run that `reference` means: a full id, a prefix that fits only one run, or `latest`.
/// Failures: those of the calls; Refused with NotFound (none fits) or Conflict (several fit;
/// named).
client::Reply<client::Run> find_run(client::Client& client, const std::string& reference);

}  // namespace dripline::cli
