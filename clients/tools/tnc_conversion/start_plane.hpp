#pragma once

#include <cstdint>
#include <span>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::tnc_conversion {

using interpreter::tnc155::Block;

/// The plane function that a program of plain language gets in ISO where its first move comes
/// before a TOOL CALL has named an axis: that of the first TOOL CALL or BLK FORM. G17, in which the
/// control begins, where the program does something before that depends on the plane.
std::uint8_t start_plane(std::span<const Block> blocks);

}  // namespace dripline::tnc_conversion
