#include "gateway/interpreter/dialects/prototrak/diagnostics.hpp"

#include <array>

namespace dripline::interpreter::prototrak {
namespace {

using enum Fault;

/// In the order of the enum.
constexpr std::array kRows{
    FaultRow{NoBlockEnd, "PTK0102", "no end of block"},
    FaultRow{Character, "PTK0103", "invalid character"},
    FaultRow{Range, "PTK0104", "value out of range"},
    FaultRow{NoNumber, "PTK0105", "address without number"},
    FaultRow{MemoryFull, "PTK0106", "memory full"},
    FaultRow{NoFunction, "PTK0107", "axis words without motion or event code"},
    FaultRow{MissingWord, "PTK0108", "required word is missing"},
    FaultRow{UnknownWord, "PTK0109", "unknown word"},
    FaultRow{NoEnd, "PTK0110", "end of data without %"},
    FaultRow{TextFailed, "PTK0111", "program text cannot be read"},
    FaultRow{ArcRadii, "PTK0201", "radii at begin and end of the arc differ"},
    FaultRow{RepeatRange, "PTK0202", "bad repeat range"},
    FaultRow{Join, "PTK0203", "conrad or offset join is impossible"},
    FaultRow{ToolDoesNotFit, "PTK0204", "tool does not fit"},
    FaultRow{LoopLimit, "PTK0205", "repeats go on without end"},
    FaultRow{NotConnectable, "PTK0301", "next event cannot be connected"},
    FaultRow{Ignored, "PTK0302", "ignored"},
    FaultRow{SideContradicts, "PTK0303", "tool side contradicts the pocket"},
    FaultRow{Noticed, "PTK0304", "taken as it is"},
};

constexpr bool rows_stand_in_order() {
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    if (static_cast<std::size_t>(kRows[row].fault) != row) return false;
  }
  return true;
}
static_assert(rows_stand_in_order());

}  // namespace

const FaultRow& fault_row(Fault fault) {
  return kRows[static_cast<std::size_t>(fault)];
}

}  // namespace dripline::interpreter::prototrak
