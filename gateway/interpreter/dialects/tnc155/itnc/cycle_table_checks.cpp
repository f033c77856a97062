#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/cycle_table_run.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/milling.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

bool is_allowed(CycleUse use, double value) {
  switch (use) {
    case CycleUse::Distance:
    case CycleUse::Feed:
    case CycleUse::Seconds:
      return value >= 0;
    case CycleUse::Zero:
      return value == 0;
    default:
      return true;
  }
}

constexpr double kMaxCyclePasses = 2000;

bool check_spindle(Run& run, int cycle) {
  const State& state = run.state;
  if (!state.tool.is_called || !state.spindle.has_speed) {
    return run.fail(ErrorCode::ToolCallMissing, "a cycle needs TOOL CALL with axis and S");
  }
  if (is_rigid(cycle) || state.spindle.state != SpindleState::Off) return true;
  return run.fail(ErrorCode::SpindleRotatesMissing, "M3 or M4 before a cycle");
}

/// The spindle is oriented to an angle of the machine, so the wall is left along its axes.
bool check_disengagement(Run& run, const Table& table) {
  const double direction = table.of(214);
  const Transformation& now = run.state.transformation;
  if (direction > 4 || direction != std::trunc(direction)) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q214 {} is not 0 to 4", direction));
  }
  const bool is_turned = now.rotation != 0 || now.basic_rotation != 0 || now.scale != 1 ||
                         std::ranges::any_of(now.mirrored, [](bool is) { return is; });
  if (direction == 0 || !is_turned) return true;
  return run.fail(
      ErrorCode::NotSupported,
      fmt::format("Q214 {} under a rotation, a mirror image or a scaling: which way the "
                  "tool leaves the wall is not known",
                  direction));
}

bool check_bore(Run& run, const Table& table) {
  const State& state = run.state;
  const double diameter = 2 * state.tool.data.radius / state.transformation.factor(state.plane);
  if (!check_circle_plane(run)) return false;
  constexpr double kSame = 1e-6;
  if (!(diameter > 0) || table.mm(335) < diameter - kSame) {
    return run.fail(ErrorCode::ToolRadiusTooLarge,
                    fmt::format("bore {:.4f} mm, tool {:.4f} mm", table.mm(335), diameter));
  }
  if (table.mm(342) == 0 && table.mm(335) > 2 * diameter + kSame) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("bore {:.4f} mm is more than two tools of {:.4f} mm, and Q342 is 0",
                                table.mm(335), diameter));
  }
  if (table.of(351) != 0 && std::fabs(table.of(351)) != 1) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q351 {}", table.of(351)));
  }
  return true;
}

/// The counterbore is made toward the spindle, from below, by a tool that gets through the hole
/// beside its center.
bool check_back_bore(Run& run, const Table& table) {
  const auto wrong = [&](int q, std::string_view what) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q{} {} {}", q, table.of(q), what));
  };
  if (table.of(249) < 0) return wrong(249, "is below the underside");
  if (table.of(249) > table.of(250)) return wrong(249, "is more than the thickness, Q250");
  if (!(table.of(251) > 0)) return wrong(251, "is no off-center distance");
  if (table.of(214) == 0) return wrong(214, "is no direction, and the tool goes through the hole");
  for (const int feed : {253, 254})
    if (!(table.of(feed) > 0)) return wrong(feed, "is no feed");
  return check_disengagement(run, table);
}

}  // namespace

bool check_unchanged(Run& run, std::span<const int> but) {
  const auto rows = cycle_table(run.state.cycle.machining.number);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::ranges::find(but, rows[i].q) != but.end()) continue;
    const double now = run.state.q[static_cast<std::size_t>(rows[i].q)];
    if (now == run.state.cycle_words[i]) continue;
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("Q{} was changed from {} to {} after CYCL DEF {}", rows[i].q,
                                run.state.cycle_words[i], now, run.state.cycle.machining.number));
  }
  return true;
}

bool check_ready(Run& run, int cycle) {
  return check_unchanged(run, {}) && check_spindle(run, cycle);
}

double passes_of(const Table& table) {
  const double depth = -table.of(201);
  switch (table.run().state.cycle.machining.number) {
    case kDrill:
    case kUniversal:
    case kPeck: {
      double least = table.of(202);
      if (table.of(212) > 0) least = std::min(least, table.of(205));
      if (table.of(257) > 0) least = std::min(least, table.of(257));
      return depth / least;
    }
    case kChipTap:
      return table.of(257) > 0 ? depth / table.of(257) : 1;
    case kRectangularPocket:
    case kCircularPocket:
    case kSlot:
    case kRoundSlot:
      return passes_of_pocket(table, table.run().state.cycle.machining.number);
    case kBoreMill:
      return depth / table.of(334);
    default:
      return 1;
  }
}

bool check_values(Run& run, const Table& table, int cycle) {
  const auto wrong = [&](int q, std::string_view what) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q{} {} {}", q, table.of(q), what));
  };
  if (cycle == kBackBore) return check_back_bore(run, table);
  if (table.of(201) > 0) return wrong(201, "is above the surface");
  if (is_pocket(cycle)) return check_pocket(run, table, cycle);
  if (cycle == kThread) return check_thread(run, table);
  if (!is_rigid(cycle) && !(table.of(206) > 0)) return wrong(206, "is no feed");
  if (is_rigid(cycle) && table.of(239) == 0) return wrong(239, "is no pitch");
  if (cycle == kBore && !check_disengagement(run, table)) return false;
  if (cycle == kChipTap && table.of(403) != 0 && table.of(403) != 1) {
    run.warn("TNC-ACCEPTED", fmt::format("Q403 {} is not followed: the way out has the speed of "
                                         "the way in",
                                         table.of(403)));
  }
  if (cycle == kDrill || cycle == kUniversal || cycle == kPeck) {
    if (!(table.of(202) > 0)) return wrong(202, "is no infeed");
    if (table.of(212) > 0 && !(table.of(205) > 0)) {
      return wrong(205, "is no least infeed, and Q212 makes it smaller");
    }
  }
  if (cycle == kUniversal && table.of(213) > 0 && !(table.of(256) > 0)) {
    return wrong(256, "is no way back to break chips");
  }
  if (cycle == kBoreMill) {
    if (!(table.of(334) > 0)) return wrong(334, "is no infeed");
    if (!check_bore(run, table)) return false;
  }
  const double passes = passes_of(table);
  if (passes <= kMaxCyclePasses) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("CYCL DEF {} would be {:.0f} infeeds, at most {:.0f}", cycle, passes,
                              kMaxCyclePasses));
}

bool define_table(Run& run, const Block& block) {
  State& state = run.state;
  const auto rows = cycle_table(block.cycle);
  std::vector<double> values(rows.size());
  for (const CycleWord& word : run.parts.itnc.words) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].q != word.parameter) continue;
      double value = run.number(word.value);
      if (word.is_rapid) value = kRapidFeed;
      if (word.is_auto) {
        if (!(state.tool_feed > 0)) {
          return run.fail(ErrorCode::FeedRateMissing, "FAUTO, and TOOL CALL had no F");
        }
        value =
            state.tool_feed * (state.units == Units::Inch ? 10 / Length::kMillimetersPerInch : 1);
      }
      if (!is_allowed(rows[i].use, value)) {
        return run.fail(
            rows[i].use == CycleUse::Zero ? ErrorCode::NotSupported : ErrorCode::EntryOutOfRange,
            fmt::format("Q{} = {} in CYCL DEF {}", rows[i].q, value, block.cycle));
      }
      values[i] = value;
    }
  }
  constexpr int kPreset = 247;
  if (block.cycle == kPreset) {
    const double preset = values[0];
    if (preset != static_cast<int>(preset)) {
      return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q339 = {}", preset));
    }
    if (!note_definition(run, block, 339)) return false;
    run.set_q(339, preset);
    return use_preset(run, static_cast<int>(preset));
  }
  if (block.cycle == kTuning) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!note_definition(run, block, rows[i].q)) return false;
      run.set_q(rows[i].q, values[i]);
    }
    run.warn("TNC-ACCEPTED", "CYCL DEF 392 (tuning of the axes) is not followed");
    return true;
  }
  if (is_pattern(block.cycle)) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!note_definition(run, block, rows[i].q)) return false;
    }
    return run_pattern(run, block.cycle, values);
  }
  // The words of a definition are what the parameters hold from then on.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!note_definition(run, block, rows[i].q)) return false;
    run.set_q(rows[i].q, values[i]);
  }
  state.cycle_words = std::move(values);
  state.cycle.machining = MachiningCycle{};
  state.cycle.machining.number = block.cycle;
  state.cycle.is_modal_call = false;
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
