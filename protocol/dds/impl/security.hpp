#pragma once

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/entity.hpp"

namespace dripline::dds {

/// Puts the DDS Security plugins and files on a participant's QoS. A missing file is an
/// error here; a wrong private key shows only because peers do not match.
/// Errors: NotFound, Syntax (a file not named).
Result<void> add_security(const SecurityFiles& files, dds_qos_t* qos);

}  // namespace dripline::dds
