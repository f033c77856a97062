#pragma once

#include <span>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

/// A cycle definition of plain language, whose sub-blocks follow one another, as one ISO block.
namespace dripline::tnc_conversion {

using interpreter::tnc155::Block;
using interpreter::tnc155::IsoBlock;

/// How many of the blocks, from the first on, are the definition that begins there; 0: it is not
/// complete.
std::size_t definition_length(std::span<const Block> blocks);

/// Puts the words of that definition into `iso`. False: an axis is programmed twice.
bool add_definition_words(std::span<const Block> definition, IsoBlock& iso);

}  // namespace dripline::tnc_conversion
