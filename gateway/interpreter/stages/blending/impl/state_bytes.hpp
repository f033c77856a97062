#pragma once

#include <cstddef>
#include <vector>

#include "gateway/interpreter/stages/blending/impl/state.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::blending::impl {

/// Member by member, so that equal states have equal bytes; only what is in use.
std::vector<std::byte> to_bytes(const State& state);
/// Errors: Corrupt; `state` is then unchanged.
Result<void> from_bytes(State& state, const std::vector<std::byte>& bytes);

}  // namespace dripline::interpreter::blending::impl
