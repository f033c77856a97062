#include "tests/fuzz/interpreter/run_in_windows.hpp"

/// Any text is executed or refused, in a bounded number of steps, and the windows it comes in can
/// not be seen in what it does; no axis word vanishes. The first byte chooses the windows.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::interpreter;
  if (size == 0) return 0;
  const Dialect& dialect = **find_dialect(FUZZED_CONTROL);
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto whole = run_in_windows(dialect, text, ProgramSource::kMaxWindow);
  const auto pieces = run_in_windows(dialect, text, data[0] % 32);
  if (whole != pieces) __builtin_trap();
  expect_no_vanished_word(dialect, text);
  return 0;
}
