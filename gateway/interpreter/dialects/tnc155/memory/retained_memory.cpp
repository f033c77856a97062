#include "gateway/interpreter/core/retained_memory.hpp"

#include "gateway/interpreter/dialects/tnc155/interpreter.hpp"

/// What the control keeps when a program is over and when it is switched off (spec 28.1): the
/// datum, which M94 moves by whole turns of a rotary axis. Q parameters begin as 0 at every start
/// (L3525); what the control stores for going on after an interruption is not a program's to leave
/// after.
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
