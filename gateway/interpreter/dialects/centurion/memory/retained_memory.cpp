#include "gateway/interpreter/core/retained_memory.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "gateway/interpreter/dialects/centurion/interpreter.hpp"

/// What the control keeps when a program has ended and when it is switched off: P0 to P99, what
/// only data mode writes (work offsets, tools, axes), and PB0 to PB639 (manual: work offsets; SAVE
/// and LOAD of parameters). The data of cycles and transformations between them begin as at
/// power-on.
namespace dripline::interpreter::centurion {
namespace {

static_assert(std::is_trivially_copyable_v<Parameters>);
static_assert(sizeof(Parameters) == kParameterCount * sizeof(double) + kByteCount);

template <class Visit>
void for_each_cell(const Parameters& parameters, Visit visit) {
  for (int number = 0; number < kParameterCount; ++number) {
    const bool is_kept = number < kUserParameters || number >= kFirstDataParameter;
    if (is_kept) visit(CellName{"P", number}, parameters[number]);
  }
  for (int number = 0; number < kByteCount; ++number) {
    visit(CellName{"PB", number}, parameters.byte(number));
  }
}

/// A number that was converted there and back has lost its last digits.
double without_noise(double value) {
  constexpr int kDigits = 14;
  if (value == 0 || !std::isfinite(value)) return value;
  const double scale =
      std::pow(10.0, kDigits - 1 - static_cast<int>(std::floor(std::log10(std::fabs(value)))));
  return std::isfinite(scale) ? std::round(value * scale) / scale : value;
}

}  // namespace

std::vector<MemoryCell> CenturionInterpreter::memory_cells() const {
  return cells_of([this](auto visit) { for_each_cell(run_.parameters, visit); });
}

/// Tables that G20 or G21 has converted are shown in the unit they began with.
bool CenturionInterpreter::read_memory(std::vector<double>& values) {
  const bool is_known =
      !values.empty() &&
      // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): it has no padding (parameters.hpp)
      std::memcmp(&known_memory_, &run_.parameters, sizeof known_memory_) == 0;
  if (is_known) return false;
  known_memory_ = run_.parameters;
  Parameters shown = known_memory_;
  if (run_.state.units != memory_units_) {
    const bool is_inch = memory_units_ == Units::Inch;
    shown.convert_tables(is_inch ? 1 / Length::kMillimetersPerInch : Length::kMillimetersPerInch);
    for (int number = kFirstDataParameter; number < kParameterCount; ++number)
      shown[number] = without_noise(shown[number]);
  }
  read_cells(values, [&](auto visit) { for_each_cell(shown, visit); });
  return true;
}

}  // namespace dripline::interpreter::centurion
