#pragma once

#include <string>
#include <string_view>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::tnc_conversion {

using interpreter::Units;
using interpreter::tnc155::Block;
using interpreter::tnc155::IsoBlock;

/// How the control writes a program.
struct TextLayout {
  char decimal_sign = ',';
  std::string_view line_end = "\r\n";
};

/// Adds the block as the control writes it: its number where it has one, one line, every word that
/// the kind of block may have, "R F M" for those not programmed. `units` decide the decimals.
void write_plain_block(const Block& block, Units units, const TextLayout& layout,
                       std::string& text);

/// Adds the block with its words sorted as the control sorts them, and its `*`.
void write_iso_block(const IsoBlock& block, const TextLayout& layout, std::string& text);

}  // namespace dripline::tnc_conversion
