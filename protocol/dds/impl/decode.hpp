#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/impl/topic.hpp"

/// Converts generated C structs from the network to checked messages. Pure; any thread. Texts must
/// end within their arrays (the CDR reader ensures it), sequences must be valid.
/// Errors: Syntax (an invalid enumerator, name, number or text), Corrupt (wrong CRC).
namespace dripline::dds {

Result<Announce> decode(const dripline_idl_Announce& sample);
Result<Status> decode(const dripline_idl_Status& sample);
Result<Record> decode(const dripline_idl_Record& sample);
Result<RecordAck> decode(const dripline_idl_RecordAck& sample);
Result<Command> decode(const dripline_idl_Command& sample);
Result<CommandResult> decode(const dripline_idl_CommandResult& sample);
Result<BlockRequest> decode(const dripline_idl_BlockRequest& sample);
Result<BlockData> decode(const dripline_idl_BlockData& sample);

}  // namespace dripline::dds
