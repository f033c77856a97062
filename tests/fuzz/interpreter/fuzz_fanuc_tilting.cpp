#include "protocol/base/invariant.hpp"
#include "tests/fuzz/interpreter/run_in_windows.hpp"

/// Any text on a five-axis machine: the first byte chooses the machine and the windows. The same
/// holds as for every control, and every place that an axis is sent to is a number.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::interpreter;
  static const std::array<Setup, 3> kMachines = [] {
    const auto machine = [](std::string_view control) {
      return parse_setup("[control]\nmodel = \"30i\"\noffset_memory = \"C\"\n" +
                         std::string(control) +
                         "[[tool]]\nnumber = 1\nlength = 50\nradius = 2\n[[offset]]\n"
                         "name = \"G54\"\nX = 3\nA = 10\nB = -5\nC = 20\n")
          .value();
    };
    return std::array<Setup, 3>{
        machine("kinematics = \"table-table\"\nrotary_master = \"A-\"\nrotary_slave = \"C-\"\n"
                "table_centers = [ { Y = 5, Z = -40 }, { X = 12, Y = 8 } ]\n"),
        machine("kinematics = \"head-table\"\nrotary_master = \"B+\"\nrotary_slave = \"C+\"\n"
                "table_centers = [ { X = 1, Y = 2 } ]\nhead_centers = [ { X = 3, Z = 150 } ]\n"
                "rotary_limits = [ { B = -100 }, { B = 100 } ]\n"),
        machine("kinematics = \"head-head\"\nrotary_master = \"C+\"\nrotary_slave = \"A+\"\n"
                "head_centers = [ { X = 2, Y = -1 }, { Y = 4, Z = 180 } ]\n"
                "stroke_limits = [ { X = -900, Z = -900 }, { X = 900, Z = 900 } ]\n")};
  }();
  if (size == 0) return 0;
  const Dialect& dialect = **find_dialect("fanuc");
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Setup& machine = kMachines[data[0] / 32 % 3];
  const auto whole = run_in_windows(dialect, text, ProgramSource::kMaxWindow, machine);
  const auto pieces = run_in_windows(dialect, text, data[0] % 32, machine);
  if (whole != pieces) __builtin_trap();
  for (const std::string& line : whole) {
    const bool is_move = line.starts_with("rapid") || line.starts_with("line");
    if (is_move && (line.find("nan") != std::string::npos || line.find("inf") != std::string::npos))
      __builtin_trap();
  }
  return 0;
}
