#include "tests/support/tnc155_trace.hpp"

#include <optional>

#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/offline/trace_writer.hpp"
#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::interpreter {
namespace {

constexpr std::uint64_t kMaxBlocks = 20'000;

/// Two programs that may be called, one of each form; the second leaves other modes in force.
std::optional<std::string> called_program(std::string_view name) {
  if (name == "8") {
    return "0 BEGIN PGM 8 MM\n1 CC IX+5 IY+0\n2 CP IPA+90 DR- R F M\n3 END PGM 8 MM\n";
  }
  if (name == "9") {
    return "%9 G71 *\nN1 G17 G00 G40 G91 X+2 *\nN2 I+5 J+0 *\nN3 G12 H+90 *\nN9999 %9 G71 *\n";
  }
  return std::nullopt;
}

/// Leaves out `"name":value,` where value has no comma.
void erase_member(std::string& line, std::string_view name) {
  const auto at = line.find(name);
  if (at == std::string::npos) return;
  const auto end = line.find_first_of(",}", at + name.size());
  if (end != std::string::npos) line.erase(at, end - at + (line[end] == ',' ? 1 : 0));
}

std::string without_places(std::string line) {
  if (line.starts_with("{\"event\":\"alarm\"") || line.starts_with("{\"event\":\"warning\"")) {
    const auto id = line.find("\"code\":");
    return line.substr(id == std::string::npos ? 0 : id, line.find(',', id) - id);
  }
  erase_member(line, "\"line\":");
  erase_member(line, "\"block\":");
  erase_member(line, "\"blocks\":");
  return line;
}

}  // namespace

std::string tnc155_trace(std::string_view text) {
  const Dialect& dialect = **find_dialect("tnc155");
  MemorySource source(text, called_program);
  std::string written;
  std::string trace;
  {
    TraceWriter writer([&](std::string_view lines) { written += lines; });
    const auto setup = parse_setup("[control]\nprogram_start = \"any\"\n");
    const auto outcome = run_offline(dialect, *setup, source, writer, {kMaxBlocks});
    writer.flush();
    if (!outcome) trace = "...";
  }
  std::string lines;
  for (std::size_t at = 0; at < written.size();) {
    const auto end = written.find('\n', at);
    lines += without_places(written.substr(at, end - at)) + "\n";
    at = end == std::string::npos ? written.size() : end + 1;
  }
  return lines + trace;
}

}  // namespace dripline::interpreter
