#include "clients/tools/tnc_conversion/cycle_to_iso.hpp"

#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_cycles.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

constexpr int kDatumShift = 7;
constexpr int kDwell = 9;

/// Gives the values of the sub-blocks P01, P02 and so on, or words of their own.
class DefinitionWords {
 public:
  explicit DefinitionWords(IsoBlock& iso) : iso_(iso) {}

  /// False: the block has the axis already.
  bool add(const Block& part, CycleField field) {
    switch (field) {
      case CycleField::Shift:
        return add_shift(part.coordinates[0]);
      case CycleField::Axes:
        for (std::size_t i = 0; i < part.coordinate_count; ++i) {
          iso_.set(slot_of_axis(part.coordinates[i].axis), {}, Distance::AsBefore);
        }
        return true;
      case CycleField::Rotation:
        set_slot(iso_, IsoSlot::H, part.angle, part.is_angle_incremental);
        return true;
      case CycleField::Scale:
        iso_.factor = part.factor;
        return true;
      default:
        add_value(part, field);
        return true;
    }
  }

 private:
  void add_value(const Block& part, CycleField field) {
    switch (field) {
      case CycleField::Length:
        return add_parameter(part.first);
      case CycleField::Dwell:
        if (part.cycle != kDwell) return add_parameter(part.first);
        iso_.feed = part.first;
        return;
      case CycleField::Feed:
      case CycleField::FeedTurn:
        return add_parameter(part.feed);
      case CycleField::Peck:
        add_parameter(part.first);
        return add_parameter(part.feed);
      case CycleField::Radius:
        return add_parameter(part.radius);
      case CycleField::Side:
        return add_parameter(part.coordinates[0].value, part.coordinates[0].axis);
      case CycleField::Program:
        iso_.called_program = part.target;
        return add_parameter({});
      default:
        return;
    }
  }

  bool add_shift(const Coordinate& shift) {
    const IsoSlot slot = slot_of_axis(shift.axis);
    if (iso_.has(slot)) return false;
    set_slot(iso_, slot, shift.value, shift.is_incremental);
    return true;
  }

  void add_parameter(const Value& value, std::optional<Axis> axis = {}) {
    set_parameter(iso_, next_++, {value, axis, {}});
  }

  IsoBlock& iso_;
  std::size_t next_ = 1;
};

}  // namespace

std::size_t definition_length(std::span<const Block> blocks) {
  const Block& first = blocks.front();
  const std::size_t max = cycle_parts(first.cycle).size();
  std::size_t count = 0;
  while (count < blocks.size() && count < max) {
    const Block& part = blocks[count];
    if (part.kind != BlockKind::CycleDefinition || part.cycle != first.cycle ||
        part.part != count) {
      break;
    }
    ++count;
  }
  const std::size_t min = first.cycle == kDatumShift ? 2 : max;
  return count < min ? 0 : count;
}

bool add_definition_words(std::span<const Block> definition, IsoBlock& iso) {
  const int cycle = definition.front().cycle;
  const auto rows = cycle_parts(cycle);
  std::optional<Turn> turn;
  DefinitionWords words(iso);
  for (std::size_t i = 1; i < definition.size(); ++i) {
    if (definition[i].turn) turn = definition[i].turn;
    if (!words.add(definition[i], rows[i].field)) return false;
  }
  iso.set(IsoGroup::Cycle, static_cast<std::uint8_t>(code_of_cycle(cycle, turn)));
  return true;
}

}  // namespace dripline::tnc_conversion
