#pragma once

#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// The content of a RunEnded record, with the server's own judgment of the bytes the machine
/// executed: the gateway reports the SHA-256 of the first bytes of the program it received, and the
/// server hashes the same bytes of the revision. Reads content when that is only a part of the
/// program. Errors: Syntax (the text is not what gateways write). An unknown run is no error: then
/// nothing is compared.
Result<storage::RunEnding> read_run_ending(const storage::Store& store, const dds::Record& record);

}  // namespace dripline::machines
