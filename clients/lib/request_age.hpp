#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace dripline::client {

/// For how long a request has been asked for: what moves a machine must not come after a stop that
/// was given meanwhile (header Dripline-Age, server/api/README.md).
using RequestAge = std::chrono::milliseconds;

/// Adds to the age that the headers have, or gives them one.
void add_age(std::vector<std::pair<std::string, std::string>>& headers, RequestAge age);

}  // namespace dripline::client
