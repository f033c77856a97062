#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

class AloneResolver {
 public:
  AloneResolver(const IsoBlock& block, ProgramForm& program, BlockParts& parts, Fault& fault)
      : block_(block), program_(program), parts_(parts), fault_(fault) {}

  bool resolve_program(bool is_first) {
    const bool has_unit = block_.has(IsoGroup::Unit);
    if (!has_unit && is_first) return wrong("% has no G70 or G71");
    const bool is_end = !is_first && (has_unit || block_.program == program_.number);
    Block& part = parts_.add(has_unit && is_first ? BlockKind::Begin
                             : is_end             ? BlockKind::End
                                                  : BlockKind::ProgramCall);
    part.target = block_.program;
    if (part.kind == BlockKind::ProgramCall) return true;
    part.is_protected = block_.has(IsoGroup::Protection);
    part.units = !has_unit                           ? program_.units
                 : block_.code(IsoGroup::Unit) == 70 ? Units::Inch
                                                     : Units::Millimeter;
    if (part.kind == BlockKind::Begin) {
      program_.units = part.units;
      program_.number = part.target;
    }
    return true;
  }

  bool resolve_function() {
    Block& part = parts_.add(BlockKind::Function);
    part.function = static_cast<std::uint8_t>(block_.function);
    const bool is_jump = part.function >= 9;
    const bool has_two =
        is_jump || (part.function >= 1 && part.function <= 4) || part.function == 8;
    const unsigned needed = is_jump ? 0b1110u : has_two ? 0b0110u : 0b0010u;
    if (block_.parameters != needed) {
      return wrong(fmt::format("D{:02} has other operands", part.function));
    }
    if (is_jump == (block_.parameter != IsoBlock::kNone)) {
      return wrong(is_jump ? "a jump has no result" : "Q of the result is missing");
    }
    for (std::size_t p = 1; p < 4; ++p) {
      if (block_.has_parameter(p) &&
          (block_.cycle[p].axis || !block_.cycle[p].value.is_programmed())) {
        return wrong(fmt::format("P{:02} has no value", p));
      }
    }
    part.first = block_.cycle[1].value;
    if (has_two) part.second = block_.cycle[2].value;
    part.target = block_.parameter;
    return is_jump ? take_jump_label(part) : true;
  }

  bool take_jump_label(Block& part) {
    const Value& label = block_.cycle[3].value;
    if (label.kind != Value::Kind::Number || label.number % Value::kStepsPerUnit != 0 ||
        label.number < 0 || label.number > kMaxLabel * Value::kStepsPerUnit) {
      return wrong("P03 is a label from 1 to 254");
    }
    part.target = label.number / Value::kStepsPerUnit;
    return part.target != 0 ? true : wrong(ErrorCode::JumpToLabelZero, "P03 0");
  }

  bool resolve_call() {
    Block& part = parts_.add(BlockKind::LabelCall);
    part.target = block_.label;
    part.repeats = part.repeats_left = block_.repeats;
    return true;
  }

 private:
  bool wrong(ErrorCode code, std::string detail) {
    fault_ = {code, 0, std::move(detail)};
    return false;
  }
  bool wrong(std::string detail) {
    return wrong(ErrorCode::BlockFormatIncorrect, std::move(detail));
  }

  const IsoBlock& block_;
  ProgramForm& program_;
  BlockParts& parts_;
  Fault& fault_;
};

}  // namespace

bool resolve_alone(const IsoBlock& block, bool is_first, ProgramForm& program, BlockParts& parts,
                   Fault& fault) {
  AloneResolver resolver(block, program, parts, fault);
  if (block.program != IsoBlock::kNone) return resolver.resolve_program(is_first);
  if (block.function != IsoBlock::kNone) return resolver.resolve_function();
  return resolver.resolve_call();
}

}  // namespace dripline::interpreter::tnc155
