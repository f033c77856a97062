#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/impl/topic.hpp"

/// Converts messages to generated C structs. The struct borrows the message's arrays: it is valid
/// as long as the message and must never be freed with dds_sample_free. Free text (record text,
/// messages, reasons, descriptions) is made sendable visibly (check.hpp); a record text over
/// kMaxRecordText is refused, since a record is never shortened silently. Errors: Syntax
/// (check.hpp), LimitExceeded (a member does not fit its bound in the IDL).
namespace dripline::dds {

template <class Message>
Result<void> encode(const Message& message, SampleOf<Message>& sample);

}  // namespace dripline::dds
