// The state of a report, as it was kept. Properties: it is read or refused; what was read is
// written and read again the same, and lines can follow it, whatever template it was made by.
#include <cstdint>
#include <cstdlib>

#include "clients/tools/report_template/report_interpreter.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::report_template;
  static const auto kTemplate = std::make_shared<const ReportTemplate>(*read_template(
      "[[line]]\nform=['A {serial}','{count} D {actual}']\ncharacteristic='D{count}'\n"
      "[[line]]\nform='E {expected}'\nends_part=true\n"));
  const auto state = parse_state({reinterpret_cast<const char*>(data), size});
  if (!state) return 0;
  const auto again = parse_state(to_json(*state));
  if (!again || *again != *state) std::abort();
  ReportInterpreter interpreter(kTemplate, *state);
  for (const char* line : {"1 D 1.5", "A 7", "2 D 1.5", "E 3", "x"})
    (void)interpreter.take({.text = line});
  (void)interpreter.end();
  return 0;
}
