#include "tests/fuzz/interpreter/run_in_windows.hpp"

/// Any text is executed or refused, in a bounded number of steps, and the windows it comes in can
/// not be seen in what it does; no axis word vanishes. The first byte chooses the windows, and the
/// form: the rest follows a start that makes the text plain language or ISO.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::interpreter;
  if (size == 0) return 0;
  const Dialect& dialect = **find_dialect("tnc155");
  const bool is_iso = (data[0] & 0x20) != 0;
  std::string text;
  if ((data[0] & 0x40) != 0) {
    text = is_iso
               ? "%1 G71 *\nN1 G99 T1 L+0 R+2 *\nN2 T1 G17 S100 *\nN3 G01 G40 G90 X+0 Y+0 F100 *\n"
               : "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+2\n2 TOOL CALL 1 Z S100\n"
                 "3 L X+0 Y+0 R0 F100\n";
  }
  text.append(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto whole = run_in_windows(dialect, text, ProgramSource::kMaxWindow);
  const auto pieces = run_in_windows(dialect, text, data[0] % 32);
  if (whole != pieces) __builtin_trap();
  expect_no_vanished_word(dialect, text);
  return 0;
}
