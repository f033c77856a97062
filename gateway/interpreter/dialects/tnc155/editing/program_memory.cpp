#include "gateway/interpreter/dialects/tnc155/editing/program_memory.hpp"

#include <algorithm>

#include "gateway/interpreter/dialects/tnc155/conversion/text_layout.hpp"
#include "gateway/interpreter/dialects/tnc155/editing/program_text.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

struct AnyProgram {
  Form form = Form::Plain;
  PlainProgram plain;
  IsoProgram iso;
};

Result<AnyProgram> read_program(std::string_view text) {
  AnyProgram program;
  program.form = detect_form(text);
  if (program.form == Form::Plain) {
    auto read = read_plain_program(text);
    if (!read) return fail(read.error());
    program.plain = std::move(*read);
  } else if (program.form == Form::Iso) {
    auto read = read_iso_program(text);
    if (!read) return fail(read.error());
    program.iso = std::move(*read);
  } else {
    return fail(Errc::Syntax, "line 1: neither plain language nor ISO of a TNC");
  }
  return program;
}

std::string write_program(const AnyProgram& program) {
  const TextLayout layout;
  std::string text;
  for (const Block& block : program.plain.blocks) {
    write_plain_block(block, program.plain.units, layout, text);
  }
  for (const auto& [block, line] : program.iso.blocks) write_iso_block(block, layout, text);
  return text;
}

bool is_head(const IsoBlock& block) {
  return block.program != IsoBlock::kNone && block.has(IsoGroup::Unit);
}

Result<StoredProgram> describe_plain(const PlainProgram& program) {
  if (program.blocks.empty() || program.blocks.front().kind != BlockKind::Begin) {
    return fail(Errc::Syntax, "line 1: no BEGIN PGM");
  }
  const Block& head = program.blocks.front();
  const Block& last = program.blocks.back();
  if (last.kind == BlockKind::End && (last.target != head.target || last.units != head.units)) {
    return fail(Errc::Syntax, "line {}: END PGM {} ends program {}", program.lines.back(),
                last.target, head.target);
  }
  return StoredProgram{head.target,       Form::Plain,           head.units,
                       head.is_protected, program.blocks.size(), 0};
}

Result<StoredProgram> describe_iso(const IsoProgram& program) {
  if (program.blocks.empty() || !is_head(program.blocks.front().block)) {
    return fail(Errc::Syntax, "line 1: no % with G70 or G71");
  }
  const IsoBlock& head = program.blocks.front().block;
  const auto& [last, line] = program.blocks.back();
  const bool is_end = program.blocks.size() > 1 && is_head(last);
  if (is_end &&
      (last.program != head.program || last.code(IsoGroup::Unit) != head.code(IsoGroup::Unit))) {
    return fail(Errc::Syntax, "line {}: %{} ends program {}", line, last.program, head.program);
  }
  return StoredProgram{head.program,          Form::Iso,
                       program.units,         head.has(IsoGroup::Protection),
                       program.blocks.size(), 0};
}

Result<StoredProgram> describe(const AnyProgram& program) {
  return program.form == Form::Plain ? describe_plain(program.plain) : describe_iso(program.iso);
}

std::string name_of(const StoredProgram& program) {
  return program.number < 0 ? "the program" : fmt::format("program {}", program.number);
}

std::string blocks_text(const StoredProgram& program) {
  constexpr std::size_t kMax = MemoryLimits::kMaxCounted;
  return program.blocks > kMax ? fmt::format("more than {} blocks", kMax)
                               : fmt::format("{} blocks", program.blocks);
}

}  // namespace

Result<StoredProgram> describe_program(std::string_view text) {
  const auto program = read_program(text);
  if (!program) return fail(program.error());
  auto described = describe(*program);
  if (described) described->characters = write_program(*program).size();
  return described;
}

Result<std::string> with_protection(std::string_view text, bool is_protected) {
  auto program = read_program(text);
  if (!program) return fail(program.error());
  if (auto described = describe(*program); !described) return fail(described.error());
  for (Block& block : program->plain.blocks) {
    const bool is_frame = block.kind == BlockKind::Begin || block.kind == BlockKind::End;
    if (is_frame) block.is_protected = is_protected;
  }
  if (program->form == Form::Iso) {
    IsoBlock& head = program->iso.blocks.front().block;
    head.groups = static_cast<std::uint16_t>(head.groups &
                                             ~(1u << static_cast<unsigned>(IsoGroup::Protection)));
    if (is_protected) head.set(IsoGroup::Protection, 50);
  }
  return write_program(*program);
}

Result<std::string> renumbered(std::string_view text, std::int32_t increment) {
  auto program = read_program(text);
  if (!program) return fail(program.error());
  if (auto described = describe(*program); !described) return fail(described.error());
  std::int32_t number = 0;
  for (Block& block : program->plain.blocks) block.number = number++;
  number = 0;
  for (auto& [block, line] : program->iso.blocks) {
    if (is_head(block)) continue;
    block.number = increment > 0 ? number += increment : IsoBlock::kNone;
  }
  return write_program(*program);
}

std::vector<StoredProgram>::iterator ProgramMemory::find(std::int32_t number) {
  return std::ranges::lower_bound(programs_, number, {}, &StoredProgram::number);
}

std::size_t ProgramMemory::used_blocks() const {
  std::size_t used = 0;
  for (const StoredProgram& program : programs_) used += program.blocks;
  return used;
}

Result<void> ProgramMemory::store(const StoredProgram& program) {
  const auto place = find(program.number);
  const bool replaces = place != programs_.end() && place->number == program.number;
  if (replaces && place->is_protected) {
    return fail(Errc::Denied, "{} is protected", name_of(program));
  }
  if (program.number > MemoryLimits::kHighestNumber) {
    return fail(Errc::LimitExceeded, "program number {} has more than 8 digits", program.number);
  }
  if (!replaces && programs_.size() >= limits_.programs) {
    return fail(Errc::LimitExceeded,
                "PROGRAM MEMORY EXCEEDED: {} is more than the {} programs the control keeps",
                name_of(program), limits_.programs);
  }
  if (program.blocks > limits_.blocks_per_program) {
    return fail(Errc::LimitExceeded, "PROGRAM MEMORY EXCEEDED: {} has {}, {} is most",
                name_of(program), blocks_text(program), limits_.blocks_per_program);
  }
  const std::size_t vacant = vacant_blocks() + (replaces ? place->blocks : 0);
  if (program.blocks > vacant) {
    return fail(Errc::LimitExceeded, "PROGRAM MEMORY EXCEEDED: {} has {}, {} are vacant",
                name_of(program), blocks_text(program), vacant);
  }
  if (replaces) {
    *place = program;
  } else {
    programs_.insert(place, program);
  }
  return {};
}

Result<void> ProgramMemory::erase(std::int32_t number) {
  const auto place = find(number);
  if (place == programs_.end() || place->number != number) {
    return fail(Errc::NotFound, "PGM {} UNAVAILABLE", number);
  }
  if (place->is_protected) return fail(Errc::Denied, "program {} is protected", number);
  programs_.erase(place);
  return {};
}

std::string ProgramMemory::listing() const {
  std::string text;
  for (const StoredProgram& program : programs_) {
    const bool is_iso = program.form == Form::Iso;
    text += fmt::format("{:8}{}{:5}\n", program.number, is_iso ? "/" : " ",
                        is_iso ? program.characters : program.blocks);
  }
  return text + fmt::format("VACANT BLOCKS = {}\n", vacant_blocks());
}

}  // namespace dripline::interpreter::tnc155
