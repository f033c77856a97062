#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "protocol/base/result.hpp"

namespace dripline::tnc_conversion {

using interpreter::Units;
using interpreter::tnc155::Block;
using interpreter::tnc155::IsoBlock;
using interpreter::tnc155::ReaderOptions;

struct PlainProgram {
  std::vector<Block> blocks;
  std::vector<std::uint64_t> lines;  ///< where they begin
  Units units = Units::Millimeter;
};

/// The words of a block and the line they begin in.
struct NumberedIsoBlock {
  IsoBlock block;
  std::uint64_t line = 0;
};
struct IsoProgram {
  std::vector<NumberedIsoBlock> blocks;
  Units units = Units::Millimeter;
};

/// All blocks up to the program's last one. Errors: Syntax, "line 3, column 8: ..."; Unsupported
/// (text after the last block).
Result<PlainProgram> read_plain_program(std::string_view text, const ReaderOptions& options = {});
Result<IsoProgram> read_iso_program(std::string_view text, const ReaderOptions& options = {});

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
