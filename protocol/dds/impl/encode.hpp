#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/impl/topic.hpp"

/// Converts messages to generated C structs. The struct borrows the message's arrays: it is valid
/// as long as the message and must never be freed with dds_sample_free. Free text (record text,
/// messages, reasons, descriptions) is made sendable visibly (utf8.hpp); a record text over
/// kMaxRecordText is refused, since a record is never shortened silently. Errors: Syntax
/// (check.hpp), LimitExceeded (a member does not fit its bound in the IDL).
namespace dripline::dds {

Result<void> encode(const Announce& message, dripline_idl_Announce& sample);
Result<void> encode(const Status& message, dripline_idl_Status& sample);
Result<void> encode(const Record& message, dripline_idl_Record& sample);
Result<void> encode(const RecordAck& message, dripline_idl_RecordAck& sample);
Result<void> encode(const Command& message, dripline_idl_Command& sample);
Result<void> encode(const CommandResult& message, dripline_idl_CommandResult& sample);
Result<void> encode(const BlockRequest& message, dripline_idl_BlockRequest& sample);
Result<void> encode(const BlockData& message, dripline_idl_BlockData& sample);

}  // namespace dripline::dds
