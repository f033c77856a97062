#include "gateway/interpreter/core/interpreter.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace dripline::interpreter {

namespace {

/// Least significant byte first, so that a digest is the same on every machine.
template <class Number>
void add_number(Sha256& hash, Number number) {
  std::array<std::byte, sizeof(Number)> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::byte>((number >> (8 * i)) & 0xFF);
  }
  hash.update(bytes);
}

}  // namespace

Diagnostic diagnostic(const DiagnosticRow& row, std::string_view detail, std::uint64_t line,
                      std::uint32_t column) {
  Diagnostic made{row.id, std::string(row.text), line, column};
  if (!detail.empty()) made.text.append(": ").append(detail);
  return made;
}

bool fits(const Question& question, const Answer& answer) {
  if (std::holds_alternative<ProbeQuestion>(question)) {
    return std::holds_alternative<ProbeResult>(answer);
  }
  if (std::holds_alternative<PromptQuestion>(question)) {
    return std::holds_alternative<PromptAnswer>(answer);
  }
  if (std::holds_alternative<InputQuestion>(question)) return std::holds_alternative<bool>(answer);
  if (std::holds_alternative<TimeQuestion>(question))
    return std::holds_alternative<LocalTime>(answer);
  return std::holds_alternative<SignalValue>(answer);
}

Digest Snapshot::digest() const {
  Sha256 hash;
  // The length keeps the name apart from what follows it.
  add_number(hash, static_cast<std::uint64_t>(dialect.size()));
  hash.update(dialect);
  add_number(hash, version);
  hash.update(bytes);
  return hash.digest();
}

Result<void> Snapshot::check_kind(std::string_view expected_dialect,
                                  std::uint32_t expected_version) const {
  if (dialect == expected_dialect && version == expected_version) return {};
  return fail(Errc::Unsupported, "snapshot of {} version {}; this is {} version {}", dialect,
              version, expected_dialect, expected_version);
}

tl::unexpected<Error> Snapshot::damage() const {
  return fail(Errc::Corrupt, "snapshot of {} bytes does not read back", bytes.size());
}

std::string_view hole_cycle_name(int g_code) {
  using Row = std::pair<int, std::string_view>;
  constexpr std::array kNames{
      Row{73, "peck drill with short retracts"},
      Row{74, "left tap"},
      Row{76, "fine bore"},
      Row{81, "drill"},
      Row{82, "drill with dwell"},
      Row{83, "peck drill"},
      Row{84, "tap"},
      Row{85, "bore"},
      Row{86, "bore with spindle stop"},
      Row{87, "back bore"},
      Row{88, "bore with manual retract"},
      Row{89, "bore with dwell"},
  };
  const auto* row = std::ranges::find(kNames, g_code, &Row::first);
  return row != kNames.end() ? row->second : std::string_view();
}

CoordinateFrame::Values CoordinateFrame::to_program(const Values& machine) const {
  Values program = base_;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      program[row] += turn_[3 * row + column] * machine[column];
  for (std::size_t i = 3; i < kAxisCount; ++i) program[i] += machine[i];
  return program;
}

}  // namespace dripline::interpreter
