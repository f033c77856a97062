#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The values that a control keeps when a program is over: variables, work offsets, tool offsets.
/// Each is a cell with the control's own name ("P10", "#500", "G54.X") and a number in the unit
/// that the control's memory has at the start. At the next start the cells come back as variables
/// of the setup, by these names, after all others.
namespace dripline::interpreter {

/// The number of an empty cell.
inline constexpr double kVacant = std::numeric_limits<double>::quiet_NaN();

enum class Keeps : std::uint8_t {
  Always,         ///< in the control's battery-backed memory or its files
  UntilPowerOff,  ///< from program to program, until the control is switched off
};

struct MemoryCell {
  std::string name;
  Keeps keeps = Keeps::Always;
};

/// An interpreter whose control keeps values; found by dynamic_cast, because some keep none.
class RetainedMemory {
 public:
  virtual ~RetainedMemory() = default;
  /// Always the same list for one setup, whatever variables it restores.
  virtual std::vector<MemoryCell> memory_cells() const = 0;
  /// The cells' numbers in that order, as the block finished last has left them. `values` are of
  /// the call before, or empty, to read all. False, and `values` as they are: nothing has changed.
  virtual bool read_memory(std::vector<double>& values) = 0;
};

/// A name before it is composed: a dialect lists thousands of cells for every one that is read.
struct CellName {
  std::string_view prefix;
  int number = -1;  ///< none
  std::string_view suffix = {};
  Keeps keeps = Keeps::Always;
  bool may_be_vacant = false;

  std::string text() const {
    std::string name(prefix);
    if (number >= 0) name += std::to_string(number);
    return name.append(suffix);
  }
};

/// Letters of the axes of event.hpp as ends of a name.
inline constexpr std::string_view kAxisSuffixes[] = {".X", ".Y", ".Z", ".A", ".B",
                                                     ".C", ".U", ".V", ".W"};

/// A dialect lists its cells once, in a function that calls `visit(CellName, value)` for each.
/// These three use it.
template <class ForEach>
std::vector<MemoryCell> cells_of(ForEach for_each) {
  std::vector<MemoryCell> cells;
  for_each([&](const CellName& name, const auto&) { cells.push_back({name.text(), name.keeps}); });
  return cells;
}

template <class ForEach>
void read_cells(std::vector<double>& values, ForEach for_each) {
  values.clear();
  for_each(
      [&](const CellName&, const auto& value) { values.push_back(static_cast<double>(value)); });
}

/// Whether a cell of this kind can hold `given`.
template <class Value>
bool cell_holds(const CellName& name, double given) {
  if (!std::isfinite(given)) return name.may_be_vacant && std::isnan(given);
  if constexpr (std::is_integral_v<Value>) {
    return given >= static_cast<double>(std::numeric_limits<Value>::min()) &&
           given <= static_cast<double>(std::numeric_limits<Value>::max()) &&
           given == std::trunc(given);
  }
  return true;
}

/// Returns the rest: unknown names, and numbers that their cell cannot hold.
template <class ForEach>
std::map<std::string, double> write_cells(std::map<std::string, double> given, ForEach for_each) {
  if (given.empty()) return given;
  for_each([&](const CellName& name, auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    const auto found = given.find(name.text());
    if (found == given.end() || !cell_holds<Value>(name, found->second)) return;
    value = static_cast<Value>(found->second);
    given.erase(found);
  });
  return given;
}

}  // namespace dripline::interpreter
