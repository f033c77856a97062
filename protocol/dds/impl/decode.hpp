#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/impl/topic.hpp"

/// Generated C structs, as they came from the network, to checked messages. Pure; any thread.
/// Texts must end within their arrays (the CDR reader sees to it), sequences must be valid.
/// Errors: Syntax (an enumerator, name, number or text that must not be), Corrupt (wrong CRC).
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
