#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/impl/topic.hpp"

/// Converts generated C structs from the network to checked messages. Pure; any thread. Texts must
/// end within their arrays (the CDR reader ensures it), sequences must be valid.
/// Errors: Syntax (an invalid enumerator, name, number or text), Corrupt (wrong CRC).
namespace dripline::dds {

template <class Sample>
Result<MessageOf<Sample>> decode(const Sample& sample);

}  // namespace dripline::dds
