#include "gateway/interpreter/core/retained_memory.hpp"

#include "gateway/interpreter/dialects/tnc155/interpreter.hpp"

/// What the control retains after a program and at power off: the datum, which M94 shifts by full
/// revolutions of a rotary axis (decisions.md). Q parameters are 0 at every start (manual:
/// parameter functions). The data stored to resume after an interruption are not a program's to
/// leave after.
namespace dripline::interpreter::tnc155 {

std::vector<MemoryCell> TncInterpreter::memory_cells() const {
  return cells_of([](auto visit) {
    for (const std::string_view axis : kAxisSuffixes) visit(CellName{"datum", -1, axis}, 0.0);
  });
}

bool TncInterpreter::read_memory(std::vector<double>& values) {
  const auto& datum = run_.state.transformation.datum;
  if (std::equal(values.begin(), values.end(), datum.begin(), datum.end())) return false;
  values.assign(datum.begin(), datum.end());
  return true;
}

}  // namespace dripline::interpreter::tnc155
