#include "gateway/interpreter/dialects/rs274ngc/memory/retained_memory.hpp"

#include <fmt/format.h>
#include <cstring>

#include "gateway/interpreter/dialects/rs274ngc/interpreter.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

template <class Visit>
void for_each_parameter(const Parameters& parameters, const std::vector<int>& in_file,
                        Visit visit) {
  std::size_t next = 0;  // of the sorted numbers that the file lists
  for (int number = kFirstFree; number <= kLastFree; ++number) {
    while (next < in_file.size() && in_file[next] < number) ++next;
    const bool is_listed = next < in_file.size() && in_file[next] == number;
    visit(CellName{"#", number, {}, is_listed ? Keeps::Always : Keeps::UntilPowerOff},
          parameters[static_cast<std::size_t>(number)]);
  }
  for (int number = kFirstInFile; number <= kLastInFile; ++number) {
    visit(CellName{"#", number}, parameters[static_cast<std::size_t>(number)]);
  }
}

}  // namespace

std::vector<MemoryCell> Rs274NgcInterpreter::memory_cells() const {
  return cells_of([this](auto visit) {
    for_each_parameter(run_.parameters, in_file_, visit);
    for_each_tool_cell(run_.tools, visit);
  });
}

bool Rs274NgcInterpreter::read_memory(std::vector<double>& values) {
  const bool is_known =
      !values.empty() &&
      // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): arrays of doubles have no padding
      std::memcmp(&known_parameters_, &run_.parameters, sizeof known_parameters_) == 0 &&
      known_tools_ == run_.tools;
  if (is_known) return false;
  known_parameters_ = run_.parameters;
  known_tools_ = run_.tools;
  read_cells(values, [this](auto visit) {
    for_each_parameter(run_.parameters, in_file_, visit);
    for_each_tool_cell(run_.tools, visit);
  });
  return true;
}

std::vector<std::string> Rs274NgcInterpreter::live_names() const {
  std::vector<std::string> names;
  const NamedParameters& named = run_.names;
  for (std::size_t id = 0; id < named.count(); ++id)
    names.push_back(fmt::format("#<{}>", named.name(static_cast<NameId>(id))));
  return names;
}

bool Rs274NgcInterpreter::read_live(std::vector<double>& values) {
  const NamedParameters& named = run_.names;
  const SeenNames now{named.changes(), run_.state.calls.size(), named.count()};
  if (names_seen_ == now) return false;
  names_seen_ = now;
  values.clear();
  for (std::size_t id = 0; id < now.count; ++id) {
    const double* const value = named.value(static_cast<NameId>(id), now.level);
    values.push_back(value != nullptr ? *value : kVacant);
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
