#include "clients/tools/tnc_conversion/program_text.hpp"
#include "clients/tools/tnc_conversion/value_text.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

/// Words in the order the control sorts them into, each after a blank but the first.
class IsoWriter {
 public:
  IsoWriter(const IsoBlock& block, const TextLayout& layout, std::string& text)
      : block_(block),
        numbers_{layout.decimal_sign, ValueText::kAsNeeded},
        text_(text),
        start_(text.size()) {}

  void write() {
    write_number('N', block_.number);
    if (block_.program != IsoBlock::kNone) return write_program();
    if (block_.function != IsoBlock::kNone) return write_function();
    write_g(IsoGroup::Label);
    write_label();
    write_g(IsoGroup::Tool);
    write_number('T', block_.tool);
    if (block_.length.is_programmed()) write_value('L', block_.length, Sign::Always);
    // The plane of a blank or a rotation follows its own code.
    const bool has_own_plane = block_.has(IsoGroup::Blank) || block_.has_code(IsoGroup::Cycle, 73);
    if (!has_own_plane) write_g(IsoGroup::Plane);
    write_g(IsoGroup::Motion);
    write_g(IsoGroup::Compensation);
    for (const IsoGroup group : {IsoGroup::Corner, IsoGroup::Pole, IsoGroup::Blank, IsoGroup::Stop,
                                 IsoGroup::Probe, IsoGroup::Cycle}) {
      write_g(group);
    }
    if (has_own_plane) write_g(IsoGroup::Plane);
    write_parameters();
    write_g(IsoGroup::Call);
    write_slots();
    write_end();
  }

 private:
  void begin_word() {
    if (text_.size() != start_) text_ += ' ';
  }
  void write_number(char name, std::int32_t number) {
    if (number == IsoBlock::kNone) return;
    begin_word();
    text_ += name;
    add_integer(text_, number);
  }
  void write_g(int code) {
    begin_word();
    text_ += 'G';
    add_integer(text_, code, 2);
  }
  void write_g(IsoGroup group) {
    if (block_.has(group)) write_g(block_.code(group));
  }
  void write_value(char name, const Value& value, Sign sign) {
    begin_word();
    text_ += name;
    numbers_.add(text_, value, sign);
  }

  void write_program() {
    begin_word();
    text_ += '%';
    add_integer(text_, block_.program);
    write_g(IsoGroup::Unit);
    write_g(IsoGroup::Protection);
  }

  void write_function() {
    begin_word();
    text_ += 'D';
    add_integer(text_, block_.function, 2);
    write_number('Q', block_.parameter);
    for (std::size_t p = 1; p < 4; ++p) {
      if (!block_.has_parameter(p)) continue;
      write_parameter_name(p);
      const bool is_label = p == 3 && block_.function >= 9;
      numbers_.add(text_, block_.cycle[p].value, is_label ? Sign::Negative : Sign::Always);
    }
  }
  void write_parameter_name(std::size_t p) {
    begin_word();
    text_ += "P0";
    text_ += static_cast<char>('0' + p);
    text_ += ' ';
  }

  void write_label() {
    write_number('L', block_.label);
    if (block_.repeats == IsoBlock::kNone) return;
    text_ += '.';
    add_integer(text_, block_.repeats);
  }

  void write_parameters() {
    for (std::size_t p = 1; p < 8; ++p) {
      if (!block_.has_parameter(p)) continue;
      const IsoParameter& parameter = block_.cycle[p];
      write_parameter_name(p);
      if (p == 1 && block_.called_program != IsoBlock::kNone) {
        add_integer(text_, block_.called_program);
        continue;
      }
      if (parameter.axis) text_ += letter(*parameter.axis);
      if (parameter.direction) {
        text_ += *parameter.direction == ProbeDirection::Positive ? '+' : '-';
      } else if (parameter.value.is_programmed()) {
        numbers_.add(text_, parameter.value, parameter.axis ? Sign::Always : Sign::Negative);
      } else {
        text_.pop_back();  // P03 of a probing block has words of its own
      }
    }
  }

  /// Words that what was before governs come first, so that no G90 or G91 governs them.
  void write_slots() {
    Distance distance = Distance::AsBefore;
    for (const bool is_explicit : {false, true}) {
      for (std::size_t i = 0; i < kIsoSlots; ++i) {
        const auto slot = static_cast<IsoSlot>(i);
        if (!block_.has(slot)) continue;
        const Distance own = block_.distance(slot);
        if ((own != Distance::AsBefore) != is_explicit) continue;
        if (own != distance) write_g(own == Distance::Absolute ? 90 : 91);
        distance = own;
        write_slot(slot);
      }
    }
    if (block_.last_distance != Distance::AsBefore) {
      write_g(block_.last_distance == Distance::Absolute ? 90 : 91);
    }
  }
  void write_slot(IsoSlot slot) {
    static constexpr std::string_view kLetters = "IJKXYZABCUVWRH";
    const char name = kLetters[static_cast<std::size_t>(slot)];
    const bool is_corner = slot == IsoSlot::R && block_.has(IsoGroup::Corner);
    if (block_.value(slot).is_programmed()) {
      write_value(name, block_.value(slot), is_corner ? Sign::Negative : Sign::Always);
    } else {
      begin_word();
      text_ += name;
    }
  }

  void write_end() {
    if (block_.feed.is_programmed()) write_value('F', block_.feed, Sign::Negative);
    if (block_.factor != IsoBlock::kNone) {
      begin_word();
      text_ += 'F';
      add_millionths(text_, block_.factor, numbers_.decimal_sign, false);
    }
    if (block_.spindle.is_programmed()) write_value('S', block_.spindle, Sign::Negative);
    if (block_.m == IsoBlock::kNone) return;
    begin_word();
    text_ += 'M';
    add_integer(text_, block_.m, 2);
  }

  const IsoBlock& block_;
  ValueText numbers_;
  std::string& text_;
  std::size_t start_;
};

}  // namespace

void write_iso_block(const IsoBlock& block, const TextLayout& layout, std::string& text) {
  IsoWriter(block, layout, text).write();
  text += " *";
  text += layout.line_end;
}

}  // namespace dripline::tnc_conversion
