#pragma once

#include <string>

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// Moves an axis while a key is held down: from the key's second repeat on, so that a key that is
/// touched moves nothing, until they end, the input ends or the axis has its distance. `client`
/// waits for the end of the jog, another one keeps it moving.
int hold_jog(Context& context, client::Client& client, const std::string& machine,
             const client::JogToMake& jog);

}  // namespace dripline::cli
