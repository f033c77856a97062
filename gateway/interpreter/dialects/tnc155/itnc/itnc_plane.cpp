#include "gateway/interpreter/dialects/tnc155/itnc/itnc_reader.hpp"

/// PLANE and FUNCTION TCPM, word by word. Source: iTNC 530, User's Manual, "Programming: multiple
/// axis machining".
namespace dripline::interpreter::tnc155::itnc {
namespace {

struct PlaneFormRow {
  std::string_view name;
  PlaneForm form;
  std::array<std::string_view, 6> words;  ///< all of them, in this order
};
constexpr std::array kPlaneForms{
    PlaneFormRow{"SPATIAL", PlaneForm::Spatial, {"SPA", "SPB", "SPC"}},
    PlaneFormRow{"EULER", PlaneForm::Euler, {"EULPR", "EULNU", "EULROT"}},
    PlaneFormRow{"VECTOR", PlaneForm::Vector, {"BX", "BY", "BZ", "NX", "NY", "NZ"}},
    PlaneFormRow{"RESET", PlaneForm::Reset, {}}};

bool is_written_as_zero(const Formula& formula) {
  return formula.front().kind == FormulaStep::Kind::Number && formula.front().number == 0;
}

bool read_plane_values(Reading& in, const PlaneFormRow& row) {
  PlaneWords& plane = in.words.plane;
  plane.form = row.form;
  plane.is_text_flat = row.form == PlaneForm::Spatial;
  for (std::size_t i = 0; i < row.words.size() && !row.words[i].empty(); ++i) {
    if (!in.cursor.take(row.words[i])) return in.cursor.missing(row.words[i]);
    if (!read_signed(in, plane.values[i])) return false;
    plane.is_text_flat = plane.is_text_flat && is_written_as_zero(plane.values[i]);
  }
  return true;
}

/// One angle, about an axis of the plane in force.
bool read_relative_angle(Reading& in) {
  PlaneWords& plane = in.words.plane;
  plane.form = PlaneForm::Relative;
  constexpr std::array<std::string_view, 3> kAngles{"SPA", "SPB", "SPC"};
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    if (!in.cursor.take(kAngles[i])) continue;
    plane.axis = static_cast<std::uint8_t>(i);
    return read_signed(in, plane.values[0]);
  }
  return in.cursor.missing("SPA, SPB or SPC");
}

bool read_sequence(Reading& in) {
  std::int8_t& sequence = in.words.plane.sequence;
  if (in.cursor.take('+')) return sequence = 1, true;
  if (in.cursor.take('-')) return sequence = -1, true;
  return in.cursor.missing("SEQ");
}

/// What the rotary axes do.
bool read_plane_tail(Reading& in) {
  TextCursor& cursor = in.cursor;
  PlaneWords& plane = in.words.plane;
  if (cursor.take("MOVE")) {
    plane.turn = PlaneTurn::Move;
  } else if (cursor.take("TURN")) {
    plane.turn = PlaneTurn::Turn;
  } else if (!cursor.take("STAY")) {
    return cursor.missing("MOVE, TURN or STAY");
  }
  while (!cursor.is_at_end()) {
    const char* word = cursor.at();
    bool is_read = true;
    if (cursor.take("DIST")) {
      is_read = read_value(in, in.words.length, "DIST");
    } else if (cursor.take("MB")) {
      in.words.retracts_to_limit = cursor.take("MAX");
      is_read = in.words.retracts_to_limit || read_value(in, in.words.retract, "MB");
    } else if (cursor.take("SEQ") || cursor.take("SYM")) {
      is_read = read_sequence(in);
    } else if (cursor.take("TABLE ROT")) {
      plane.rotates_table = true;
    } else if (cursor.take("COORD ROT")) {
      plane.rotates_coordinates = true;
    } else if (cursor.take('F')) {
      is_read = read_feed(in, false);
    } else {
      return refuse(in, word);
    }
    if (!is_read) return false;
  }
  return true;
}

}  // namespace

bool read_plane(Reading& in, const char* start) {
  in.block.kind = BlockKind::Plane;
  in.words.block_has_plane = true;
  if (in.cursor.take("RELATIVE")) return read_relative_angle(in) && read_plane_tail(in);
  for (const PlaneFormRow& row : kPlaneForms) {
    if (!in.cursor.take(row.name)) continue;
    in.words.name = row.name;
    return read_plane_values(in, row) && read_plane_tail(in);
  }
  return refuse(in, start);  // PROJECTED, POINTS, AXIAL: their signs are pictures in the manual
}

bool read_tip_control(Reading& in, const char* start) {
  TextCursor& cursor = in.cursor;
  in.block.kind = BlockKind::TipControl;
  in.words.name = "FUNCTION TCPM";
  in.words.tip = TipWords::Begin;
  // F CONT, AXIS SPAT and PATHCTRL VECTOR mean other feeds, angles and paths: they are alarms.
  if (!cursor.take("F TCP")) return refuse(in, start);
  if (!cursor.take("AXIS POS")) return refuse(in, start);
  if (cursor.take("PATHCTRL") && !cursor.take("AXIS")) return refuse(in, start);
  if (cursor.take("REFPNT") && !cursor.take("TIP-TIP")) return refuse(in, start);
  return cursor.is_at_end() || refuse(in, cursor.at());
}

}  // namespace dripline::interpreter::tnc155::itnc
