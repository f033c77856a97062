#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"

#include <algorithm>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/interpreter.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

std::string name_of(const StoredProgram& program) {
  return program.number < 0 ? "the program" : fmt::format("program {}", program.number);
}

std::string blocks_text(const StoredProgram& program) {
  constexpr std::size_t kMax = MemoryLimits::kMaxCounted;
  return program.blocks > kMax ? fmt::format("more than {} blocks", kMax)
                               : fmt::format("{} blocks", program.blocks);
}

}  // namespace

std::vector<StoredProgram>::iterator ProgramMemory::find(std::int32_t number) {
  return std::ranges::lower_bound(programs_, number, {}, &StoredProgram::number);
}

std::size_t ProgramMemory::used_blocks() const {
  std::size_t used = 0;
  for (const StoredProgram& program : programs_) used += program.blocks;
  return used;
}

Result<void> ProgramMemory::store(const StoredProgram& program) {
  const auto place = find(program.number);
  const bool replaces = place != programs_.end() && place->number == program.number;
  if (replaces && place->is_protected) {
    return fail(Errc::Denied, "{} is protected", name_of(program));
  }
  if (program.number > MemoryLimits::kHighestNumber) {
    return fail(Errc::LimitExceeded, "program number {} has more than 8 digits", program.number);
  }
  if (!replaces && programs_.size() >= limits_.programs) {
    return fail(Errc::LimitExceeded,
                "PROGRAM MEMORY EXCEEDED: {} is more than the {} programs the control keeps",
                name_of(program), limits_.programs);
  }
  if (program.blocks > limits_.blocks_per_program) {
    return fail(Errc::LimitExceeded, "PROGRAM MEMORY EXCEEDED: {} has {}, {} is most",
                name_of(program), blocks_text(program), limits_.blocks_per_program);
  }
  const std::size_t vacant = vacant_blocks() + (replaces ? place->blocks : 0);
  if (program.blocks > vacant) {
    return fail(Errc::LimitExceeded, "PROGRAM MEMORY EXCEEDED: {} has {}, {} are vacant",
                name_of(program), blocks_text(program), vacant);
  }
  if (replaces) {
    *place = program;
  } else {
    programs_.insert(place, program);
  }
  return {};
}

Result<void> ProgramMemory::erase(std::int32_t number) {
  const auto place = find(number);
  if (place == programs_.end() || place->number != number) {
    return fail(Errc::NotFound, "PGM {} UNAVAILABLE", number);
  }
  if (place->is_protected) return fail(Errc::Denied, "program {} is protected", number);
  programs_.erase(place);
  return {};
}

std::string ProgramMemory::listing() const {
  std::string text;
  for (const StoredProgram& program : programs_) {
    const bool is_iso = program.form == Form::Iso;
    text += fmt::format("{:8}{}{:5}\n", program.number, is_iso ? "/" : " ",
                        is_iso ? program.characters : program.blocks);
  }
  return text + fmt::format("VACANT BLOCKS = {}\n", vacant_blocks());
}

// What the control retains after a program and at power off: the datum, which M94 shifts by full
// revolutions of a rotary axis (decisions.md). Q parameters are 0 at every start (manual:
// parameter functions). The data stored to resume after an interruption are not a program's to
// leave after.

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
