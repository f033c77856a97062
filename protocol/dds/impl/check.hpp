#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

/// Checks the members of a message by their rules (members.hpp), and the rules between members, for
/// both directions. Free text is not checked (utf8.hpp).
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
