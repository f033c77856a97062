#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"

#include <fmt/core.h>

namespace dripline::interpreter::fanuc {
namespace {

constexpr int kFirstCommon = 100;
constexpr int kFirstKept = 500;
constexpr int kFirstSystem = 1000;

}  // namespace

bool refuse_variable(Run& run, int number, std::uint32_t column) {
  return run.fail(ErrorCode::IllegalVariable, column, fmt::format("#{}", number));
}

Locals null_locals() {
  Locals locals;
  locals.fill(kNull);
  return locals;
}

double* common_variable(ModalState& state, const ControlOptions& options, int number) {
  if (number >= 1 && number <= kLocalCount) {
    return &state.locals.back()[static_cast<std::size_t>(number - 1)];
  }
  if (number >= kFirstCommon && number <= options.last_common) {
    return &state.commons[static_cast<std::size_t>(number - kFirstCommon)];
  }
  if (number >= kFirstKept && number <= options.last_kept) {
    return &state.kept[static_cast<std::size_t>(number - kFirstKept)];
  }
  if (options.has_extra_commons && number >= kFirstExtra && number < kFirstExtra + kExtraCount) {
    return &state.extra[static_cast<std::size_t>(number - kFirstExtra)];
  }
  return nullptr;
}

bool read_variable(Run& run, int number, std::uint32_t column, double& value) {
  if (const double* cell = common_variable(run.state, run.options, number)) {
    value = *cell;
    return true;
  }
  if (number == 0) {
    value = kNull;
    return true;
  }
  if (number < kFirstSystem) return refuse_variable(run, number, column);
  return read_system_variable(run, number, column, value);
}

bool write_variable(Run& run, int number, std::uint32_t column, double value) {
  if (double* cell = common_variable(run.state, run.options, number)) {
    *cell = value;
    return true;
  }
  if (number == 0) {
    return run.fail(ErrorCode::WriteProtected, column, "#0");
  }
  if (number < kFirstSystem) return refuse_variable(run, number, column);
  return write_system_variable(run, number, column, value);
}

}  // namespace dripline::interpreter::fanuc
