#pragma once

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/entity.hpp"

namespace dripline::dds {

/// Puts the DDS Security plugins and files on a participant's QoS. A file that is not there is an
/// error here; a wrong private key is noticed by Cyclone only when peers do not match.
/// Errors: NotFound, Syntax (a file not named).
Result<void> add_security(const SecurityFiles& files, dds_qos_t* qos);

}  // namespace dripline::dds
