// A template, a NUL, and lines. Properties: any template is read or refused; any line is
// interpreted; the state written and read between two lines changes nothing and stays bounded; a
// value has a name, is finite and has a verdict by its limits.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "clients/tools/report_template/report_interpreter.hpp"

namespace {

using namespace dripline::report_template;

void check(const std::vector<ReportEvent>& events) {
  for (const auto& event : events) {
    const auto* value = std::get_if<Value>(&event);
    if (value == nullptr) continue;
    const auto& made = value->characteristic;
    if (made.name.empty() || made.name.size() > kMaxName || !std::isfinite(value->actual))
      std::abort();
    if (made.lower && made.upper && *made.lower > *made.upper) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto end = input.find('\0');
  auto read = read_template(input.substr(0, end));
  if (!read || end == std::string_view::npos) return 0;
  const auto content = std::make_shared<const ReportTemplate>(*std::move(read));
  ReportInterpreter whole(content);
  ReportState state;
  std::string_view rest = input.substr(end + 1);
  while (!rest.empty()) {
    const auto line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::string_view kind = line.starts_with('{') ? "probe" : "output";
    ReportInterpreter resumed(content, state);
    const auto taken = resumed.take({.text = line, .kind = kind});
    check(taken.events);
    const auto again = parse_state(to_json(resumed.state()));
    if (!again || again->missing.size() > 256) std::abort();
    state = *again;
    const auto expected = whole.take({.text = line, .kind = kind});
    // Bytes that are not UTF-8 are replaced in a written state: such texts may differ.
    if (line.find_first_of("\x80\xff") == std::string_view::npos &&
        taken.is_understood != expected.is_understood)
      std::abort();
  }
  check(whole.end());
  return 0;
}
