#include "clients/tools/tnc_conversion/program_text.hpp"
#include "clients/tools/tnc_conversion/value_text.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

class PlainWriter {
 public:
  PlainWriter(const Block& block, Units units, const TextLayout& layout, std::string& text)
      : block_(block),
        numbers_{layout.decimal_sign, units == Units::Inch ? 4 : 3},
        decimal_sign_(layout.decimal_sign),
        text_(text) {}

  void write() {
    if (block_.number != Block::kNone) {
      add_integer(text_, block_.number);
      text_ += ' ';
    }
    write_kind();
  }

 private:
  void write_kind() {
    switch (block_.kind) {
      case BlockKind::Begin:
        return write_frame("BEGIN PGM ");
      case BlockKind::End:
        return write_frame("END PGM ");
      case BlockKind::ToolDefinition:
        return write_tool_definition();
      case BlockKind::ToolCall:
        return write_tool_call();
      case BlockKind::Stop:
        text_ += "STOP";
        return write_m();
      case BlockKind::CycleCall:
        text_ += "CYCL CALL";
        return write_m();
      case BlockKind::Chamfer:
        text_ += "L ";
        return numbers_.add(text_, block_.radius, Sign::Negative);
      case BlockKind::Rounding:
        text_ += "RND R";
        return numbers_.add(text_, block_.radius, Sign::Negative);
      case BlockKind::Label:
        text_ += "LBL ";
        return add_integer(text_, block_.target);
      case BlockKind::LabelCall:
        return write_label_call();
      case BlockKind::ProgramCall:
        text_ += "CALL PGM ";
        return add_integer(text_, block_.target);
      case BlockKind::Function:
        return write_function();
      case BlockKind::CycleDefinition:
        return write_cycle();
      case BlockKind::BlankForm:
        return write_blank();
      case BlockKind::Probe:
        return write_probe();
      default:
        return write_path();
    }
  }

  void write_path() {
    switch (block_.kind) {
      case BlockKind::PolarLine:
        text_ += "LP";
        write_polar(true);
        break;
      case BlockKind::Center:
        text_ += "CC";
        return write_coordinates();
      case BlockKind::Arc:
        text_ += "C";
        write_coordinates();
        break;
      case BlockKind::PolarArc:
        text_ += "CP";
        write_polar(false);
        write_coordinates();
        break;
      case BlockKind::TangentArc:
        text_ += "CT";
        write_coordinates();
        break;
      case BlockKind::SingleAxis:
        write_coordinate(block_.coordinates[0]);
        break;
      default:
        text_ += "L";
        write_coordinates();
    }
    write_turn();
    write_tail();
  }

  void write_frame(const char* words) {
    text_ += words;
    add_integer(text_, block_.target);
    text_ += block_.units == Units::Inch ? " INCH" : " MM";
    if (block_.is_protected) text_ += " P";
  }

  void write_tool_definition() {
    text_ += "TOOL DEF ";
    add_integer(text_, block_.target);
    write_value(" L", block_.length, Sign::Always);
    write_value(" R", block_.radius, Sign::Always);
  }

  void write_tool_call() {
    text_ += "TOOL CALL";
    if (block_.target != Block::kNone) {
      text_ += ' ';
      add_integer(text_, block_.target);
    }
    if (block_.is_fourth_axis) {
      text_ += " IV";
    } else if (block_.axis) {
      text_ += ' ';
      text_ += letter(*block_.axis);
    }
    if (!block_.spindle.is_programmed()) return;
    text_ += " S ";
    ValueText{decimal_sign_, 3}.add(text_, block_.spindle, Sign::Negative);
  }

  void write_label_call() {
    text_ += "CALL LBL ";
    add_integer(text_, block_.target);
    text_ += " REP";
    if (block_.repeats == Block::kNone) return;
    text_ += ' ';
    add_integer(text_, block_.repeats);
    text_ += '/';
    add_integer(text_, block_.repeats_left);
  }

  void write_function() {
    static constexpr std::array kWords{"",    "+",   "-",   "*",  "DIV", "SQRT", "SIN",
                                       "COS", "LEN", "EQU", "NE", "GT",  "LT"};
    const char* word = kWords[block_.function];
    const bool is_jump = block_.function >= 9;
    text_ += "FN ";
    add_integer(text_, block_.function);
    text_ += is_jump ? ": IF" : ": Q";
    if (!is_jump) {
      add_integer(text_, block_.target);
      text_ += " =";
    }
    const bool is_unary = block_.function >= 5 && block_.function <= 7;
    if (is_unary) write_word(word);
    write_value(" ", block_.first, Sign::Always);
    if (is_unary || block_.function == 0) return;
    write_word(word);
    write_value(" ", block_.second, Sign::Always);
    if (!is_jump) return;
    text_ += " GOTO LBL ";
    add_integer(text_, block_.target);
  }
  void write_word(const char* word) {
    text_ += ' ';
    text_ += word;
  }

  void write_cycle() {
    const CyclePart& row = cycle_parts(block_.cycle)[block_.part];
    text_ += "CYCL DEF ";
    add_integer(text_, block_.cycle);
    text_ += '.';
    add_integer(text_, block_.part);
    switch (row.field) {
      case CycleField::Side:
      case CycleField::Shift:
        return write_coordinates();
      case CycleField::Axes:
        for (std::size_t i = 0; i < block_.coordinate_count; ++i) {
          text_ += ' ';
          text_ += letter(block_.coordinates[i].axis);
        }
        return;
      case CycleField::Rotation:
        text_ += block_.is_angle_incremental ? " IROT " : " ROT ";
        return ValueText{decimal_sign_, 3}.add(text_, block_.angle, Sign::Always);
      default:
        text_ += ' ';
        text_ += row.word;
        return write_cycle_value(row.field);
    }
  }

  void write_cycle_value(CycleField field) {
    switch (field) {
      case CycleField::Length:
        return write_value(" ", block_.first, Sign::Always);
      case CycleField::Dwell:
        text_ += ' ';
        return ValueText{decimal_sign_, 3}.add(text_, block_.first, Sign::Negative);
      case CycleField::Feed:
        return add_feed();
      case CycleField::Peck:
        write_value(" ", block_.first, Sign::Always);
        text_ += " F";
        return add_feed();
      case CycleField::FeedTurn:
        add_feed();
        return write_turn();
      case CycleField::Radius:
        return write_value(" ", block_.radius, Sign::Negative);
      case CycleField::Scale:
        text_ += ' ';
        return add_millionths(text_, block_.factor, decimal_sign_, true);
      case CycleField::Program:
        text_ += ' ';
        return add_integer(text_, block_.target);
      default:
        return;
    }
  }

  void write_blank() {
    text_ += block_.is_maximum ? "DEF BLK FORM MAX" : "DEF BLK FORM MIN";
    if (block_.axis) {
      text_ += ' ';
      text_ += letter(*block_.axis);
    }
    write_coordinates();
  }

  void write_probe() {
    if (block_.part == 1) {
      text_ += "TCH PROBE 0.1";
      return write_coordinates();
    }
    text_ += "TCH PROBE 0.0 REF. PLANE Q";
    add_integer(text_, block_.target);
    text_ += ' ';
    text_ += letter(*block_.axis);
    text_ += block_.direction == ProbeDirection::Positive ? '+' : '-';
  }

  void write_polar(bool has_radius) {
    if (has_radius) {
      write_value(block_.is_radius_incremental ? " IPR" : " PR", block_.radius, Sign::Always);
    }
    if (!block_.angle.is_programmed()) return;
    text_ += block_.is_angle_incremental ? " IPA" : " PA";
    ValueText{decimal_sign_, 3}.add(text_, block_.angle, Sign::Always);
  }

  void write_coordinates() {
    for (std::size_t i = 0; i < block_.coordinate_count; ++i) {
      text_ += ' ';
      write_coordinate(block_.coordinates[i]);
    }
  }
  void write_coordinate(const Coordinate& coordinate) {
    if (coordinate.is_incremental) text_ += 'I';
    text_ += letter(coordinate.axis);
    if (is_rotary(coordinate.axis)) {
      ValueText{decimal_sign_, 3}.add(text_, coordinate.value, Sign::Always);
    } else {
      numbers_.add(text_, coordinate.value, Sign::Always);
    }
  }

  void write_value(const char* name, const Value& value, Sign sign) {
    if (!value.is_programmed()) return;
    text_ += name;
    numbers_.add(text_, value, sign);
  }

  void write_turn() {
    if (block_.turn) text_ += *block_.turn == Turn::Counterclockwise ? " DR+" : " DR-";
  }

  void write_tail() {
    static constexpr std::array kCompensations{" R", " R0", " RL", " RR", " R+", " R-"};
    text_ += kCompensations[static_cast<std::size_t>(block_.compensation)];
    if (block_.is_rapid) {
      text_ += " F MAX";
    } else {
      text_ += " F";
      if (block_.feed.is_programmed()) add_feed();
    }
    write_m();
  }
  void add_feed() {
    ValueText{decimal_sign_, ValueText::kAsNeeded}.add(text_, block_.feed, Sign::Negative);
  }
  void write_m() {
    text_ += " M";
    if (block_.m != Block::kNone) add_integer(text_, block_.m, 2);
  }

  const Block& block_;
  ValueText numbers_;
  char decimal_sign_;
  std::string& text_;
};

}  // namespace

void write_plain_block(const Block& block, Units units, const TextLayout& layout,
                       std::string& text) {
  PlainWriter(block, units, layout, text).write();
  text += layout.line_end;
}

}  // namespace dripline::tnc_conversion
