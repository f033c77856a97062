#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

/// What must hold for a message besides its types, in one place for both directions: names well
/// formed, numbers finite, lengths within bounds. Free text is not looked at (utf8.hpp).
namespace dripline::dds {

Result<void> check(const Announce& message);
Result<void> check(const Status& message);
Result<void> check(const Record& message);
Result<void> check(const RecordAck& message);
Result<void> check(const Command& message);
Result<void> check(const CommandResult& message);
Result<void> check(const BlockRequest& message);
Result<void> check(const BlockData& message);

}  // namespace dripline::dds
