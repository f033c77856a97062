#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gateway/interpreter/compensation/impl/state.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::compensation::impl {

/// Member by member, so that equal states have equal bytes; only what is in use.
void append_bytes(const State& state, std::vector<std::byte>& out);
/// From the front of `bytes`; how many it took. Errors: Corrupt; `state` is then unchanged.
Result<std::size_t> read_bytes(State& state, std::span<const std::byte> bytes);

}  // namespace dripline::interpreter::compensation::impl
