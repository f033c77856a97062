#include "clients/tools/program_editing/tnc155/whole_program.hpp"

#include "clients/tools/tnc_conversion/program_text.hpp"

namespace dripline::program_editing {

using namespace interpreter;
using namespace interpreter::tnc155;
using namespace tnc_conversion;

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

}  // namespace dripline::program_editing
