#include "gateway/interpreter/dialects/fanuc/cycles/cycle_data.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Feeds of one block, so that a step never delivers without bound.
constexpr double kMaxPecks = 100'000;

bool calls_or_returns(const Block& block) {
  return std::any_of(block.m.begin(), block.m.begin() + block.parts.m_count,
                     [](int code) { return code == 98 || code == 99 || code == 198; });
}

/// Its P is that of G54.1, or of M98 and its like.
bool has_other_p(const Block& block) {
  return block.parts.p_is_work_system || calls_or_returns(block);
}

/// K or L that is not the model's address of repeats, or comes beside it: a row of holes that
/// becomes a single one, or of another length.
bool check_other_repeats(Run& run, AddressSet taken) {
  const Words& words = run.block.words;
  AddressSet others =
      words.present() & static_cast<AddressSet>(run.ledger.left()) & set_of(K, L) & ~taken;
  if (calls_or_returns(run.block)) others &= ~set_of(L);
  if (others == 0) return true;
  const Address other = (others & set_of(L)) != 0 ? L : K;
  const std::string by = taken != 0 ? fmt::format("beside {}", other == L ? 'K' : 'L')
                                    : fmt::format("a cycle is repeated by {} here (repeat_address)",
                                                  other == L ? 'K' : 'L');
  return run.fail(ErrorCode::IllegalAddress, words.column(other),
                  fmt::format("{}{:g}: {}", letter(other), run.whole(words[other]), by));
}

}  // namespace

bool is_tapping(std::uint8_t code) {
  return code == 74 || code == 84 || is_rigid_tap(code);
}

bool pecks_in_tap(const Run& run) {
  const ModalState& state = run.state;
  return state.taps_rigidly() && is_tapping(state.g[kCycleGroup]) && state.cycle.has_depth &&
         state.cycle.depth > 0;
}

double scale_along(const ModalState& state, Axis axis) {
  return state.g[kScalingGroup] == 51 ? std::fabs(state.scaling.factor[place(axis)]) : 1;
}

bool read_repeats(Run& run, double& repeats) {
  const Words& words = run.block.words;
  const RepeatAddress by = run.options.repeat_address;
  const bool by_k = by != RepeatAddress::L && words.has(K);
  const bool by_l = by != RepeatAddress::K && words.has(L);
  repeats = 1;
  if (!check_other_repeats(run, by_k ? set_of(K) : by_l ? set_of(L) : 0)) return false;
  if (!by_k && !by_l) return true;
  const Word& word = words[by_k ? K : L];
  run.ledger.take(set_of(by_k ? K : L));
  repeats = run.whole(word);
  if (repeats >= 0 && repeats <= 9999 && repeats == std::trunc(repeats)) return true;
  return run.fail(ErrorCode::TooManyDigits, word.column,
                  fmt::format("{} repeats are not 0 to 9999", repeats));
}

Address level_word(const Run& run) {
  constexpr std::array<Address, 3> kLevels{X, Y, Z};
  return kLevels[place(axes_of(run.state.plane()).normal)];
}

bool keep_data(Run& run, double present) {
  ModalState& state = run.state;
  CycleData& data = state.cycle;
  const Words& words = run.block.words;
  const Address level = level_word(run);
  const bool is_incremental = state.is_incremental();
  if (words.has(R)) {
    if (is_incremental && data.has_bottom && !words.has(level)) {
      return run.fail(ErrorCode::ImproperCommand, words.column(R),
                      fmt::format("R in G91, from which {} counts, without it", letter(level)));
    }
    const double value = run.length(words[R]);
    data.retract = is_incremental ? data.initial + value : value;
    data.has_retract = true;
  } else if (!data.has_retract) {
    data.retract = present;
  }
  if (words.has(level)) {
    const double value = run.length(words[level]);
    data.bottom = is_incremental ? data.retract + value : value;
    data.has_bottom = true;
  } else if (!data.has_bottom) {
    data.bottom = data.retract;
  }
  if (words.has(Q)) {
    data.depth = std::fabs(run.length(words[Q]));
    data.has_depth = true;
  }
  if (words.has(P) && !has_other_p(run.block)) data.dwell = run.whole(words[P]) / 1000;
  const std::uint8_t code = state.g[kCycleGroup];
  const bool pecks = code == 73 || code == 83;
  if (pecks && !(data.has_depth && data.depth > 0)) {
    return run.fail(ErrorCode::NoQ, run.block.parts.g_column);
  }
  const bool shifts = data.has_depth && data.depth > 0;
  if (code == 87 && !shifts) {
    return run.fail(ErrorCode::NoQ, run.block.parts.g_column,
                    "G87 would go down to R without its shift");
  }
  if (code == 76 && !shifts) run.warn(WarningCode::CycleWithoutShift, run.block.parts.g_column);
  if (!is_tapping(code)) return true;
  if (!state.taps_rigidly() && state.spindle.revolutions == 0) {
    run.warn(WarningCode::TapWithoutSpeed, run.block.parts.g_column);
  }
  if (!state.taps_rigidly() && words.has(Q) && data.depth > 0) {
    return run.fail(ErrorCode::ImproperCommand, words.column(Q),
                    "a tap pecks only in rigid tapping (M29)");
  }
  if (pecks_in_tap(run) && run.block.names(kCycleGroup) && !words.has(Q)) {
    run.warn(WarningCode::KeptPeck, run.block.parts.g_column);
  }
  return true;
}

void check_levels(Run& run) {
  const CycleData& data = run.state.cycle;
  const double down = data.bottom - data.retract;
  const double approach = data.retract - data.initial;
  if (!data.has_bottom || !data.has_retract) {
    run.warn(WarningCode::CycleLevels, run.block.parts.g_column,
             data.has_retract ? "no bottom is written, R is taken"
                              : "no R is written, the level reached is taken");
  } else if (run.state.g[kCycleGroup] != 87 && down * approach < 0) {
    run.warn(
        WarningCode::CycleLevels, run.block.parts.g_column,
        fmt::format("initial {:.6g}, R {:.6g}, bottom {:.6g}", run.in_units(Axis::Z, data.initial),
                    run.in_units(Axis::Z, data.retract), run.in_units(Axis::Z, data.bottom)));
  }
}

bool check_pecks(Run& run, double repeats) {
  const CycleData& data = run.state.cycle;
  const std::uint8_t code = run.state.g[kCycleGroup];
  if (code != 73 && code != 83 && !pecks_in_tap(run)) return true;
  const double scale = scale_along(run.state, axes_of(run.state.plane()).normal);
  const double pecks = std::fabs(data.bottom - data.retract) * scale / data.depth * repeats;
  if (pecks <= kMaxPecks) return true;
  return run.fail(ErrorCode::LoopLimit, run.block.words.column(Q),
                  fmt::format("{:.0f} pecks in one block", pecks));
}

bool check_initial_level(Run& run) {
  constexpr double kSame = 1e-6;
  const Axis axis = axes_of(run.state.plane()).normal;
  Point3 point = program_position(run);
  point[place(axis)] = run.state.cycle.initial;
  const double raw = machine_point(run, point).raw(axis);
  if (std::fabs(raw - run.state.cycle.initial_raw) <= kSame) return true;
  return run.fail(ErrorCode::ImproperCommand, run.block.words.first_column(kAxisWords | set_of(R)),
                  fmt::format("the zero of {} changes in the mode of hole cycles: G80 comes before",
                              letter(axis)));
}

}  // namespace dripline::interpreter::fanuc
