#include "gateway/interpreter/dialects/fanuc/memory/retained_memory.hpp"

#include <cstring>

#include "gateway/interpreter/dialects/fanuc/interpreter.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Bit by bit: a vacant variable is not equal to itself.
template <class Values>
bool note(Values& known, const Values& now) {
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): arrays of doubles have no padding
  const bool is_same = std::memcmp(&known, &now, sizeof now) == 0;
  if (!is_same) known = now;
  return !is_same;
}

}  // namespace

std::vector<MemoryCell> FanucInterpreter::memory_cells() const {
  return cells_of([this](auto visit) {
    for_each_variable(run_.state, run_.options, visit);
    for_each_offset(run_.memory, visit);
  });
}

bool FanucInterpreter::read_memory(std::vector<double>& values) {
  bool has_changed = values.empty();
  has_changed |= note(known_memory_.commons, run_.state.commons);
  has_changed |= note(known_memory_.kept, run_.state.kept);
  has_changed |= note(known_memory_.counters, run_.state.counters);
  has_changed |= note(known_memory_.work, run_.memory.coordinates.work);
  has_changed |= note(known_memory_.tools, run_.memory.tools);
  if (!has_changed) return false;
  read_cells(values, [this](auto visit) {
    for_each_variable(run_.state, run_.options, visit);
    for_each_offset(run_.memory, visit);
  });
  return true;
}

}  // namespace dripline::interpreter::fanuc
