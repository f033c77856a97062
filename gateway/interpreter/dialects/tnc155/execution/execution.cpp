#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"

#include <fmt/core.h>
#include <array>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/flow.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/tools.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/word_check.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool begin_program(Run& run, const Block& block) {
  State& state = run.state;
  if (!state.has_header && state.programs.empty()) {
    if (run.options.is_itnc) {
      state.program_name = run.parts.itnc.name;
    } else {
      state.program_number = block.target;
    }
    state.units = block.units;
    return true;
  }
  if (state.units == block.units) return true;
  state.units = block.units;
  run.events().on_units({run.origin, state.units});
  return true;
}

bool move(Run& run, const Block& block) {
  switch (block.kind) {
    case BlockKind::Line:
      return run_line(run, block);
    case BlockKind::PolarLine:
      return run_polar_line(run, block);
    case BlockKind::Arc:
      return run_arc(run, block);
    case BlockKind::PolarArc:
      return run_polar_arc(run, block);
    case BlockKind::TangentArc:
      return run_tangent_arc(run, block);
    case BlockKind::RadiusArc:
      return run_radius_arc(run, block);
    case BlockKind::Approach:
      return itnc::approach(run, block);
    case BlockKind::Departure:
      return itnc::depart(run, block);
    default:
      return run_single_axis(run, block);
  }
}

bool move_across(Run& run, const Block& block) {
  return itnc::move_in_pole_plane(run, block, move);
}

/// M99 and M89: the machining cycle, after the motion.
bool call_cycle_by_m(Run& run, int m, bool has_moved) {
  CycleState& cycle = run.state.cycle;
  if (m == 99) {
    cycle.is_modal_call = false;
    return call_cycle(run);
  }
  if (m == 89 && run.options.m89_modal) {
    cycle.is_modal_call = true;
    return true;
  }
  return !has_moved || !cycle.is_modal_call || call_cycle(run);
}

/// M functions after the motion, those that end the program last.
bool finish_m(Run& run, int m, bool has_moved) {
  if (m == 2 || m == 30) {
    end_program(run, true);
    return true;
  }
  if (m != Block::kNone && !end_m(run, m)) return false;
  return call_cycle_by_m(run, m, has_moved);
}

bool positioning(Run& run, const Block& block) {
  if (run.options.is_itnc) [[unlikely]]
    return itnc::position(run, block, run.state.pole_plane ? move_across : move);
  if (block.m == Block::kNone && !run.state.cycle.is_modal_call) [[likely]]
    return move(run, block);
  if (block.m != Block::kNone && !begin_m(run, block.m)) return false;
  const bool moves = block.coordinate_count != 0 || block.kind == BlockKind::PolarLine ||
                     block.kind == BlockKind::PolarArc;
  return move(run, block) && finish_m(run, block.m, moves);
}

/// M91 and M92 say what coordinates refer to.
bool check_no_coordinates(Run& run, int m) {
  if (m != 91 && m != 92) return true;
  return run.fail(ErrorCode::BlockFormatIncorrect,
                  fmt::format("M{} refers to coordinates, and there are none", m));
}

bool stop_block(Run& run, const Block& block) {
  if (run.options.is_itnc) return itnc::stop_block(run, block);
  const int m = block.m;
  if (!check_no_coordinates(run, m)) return false;
  if (m != Block::kNone && !begin_m(run, m)) return false;
  if (m == 0) return end_m(run, m);  // M00 stops by itself
  if (m == 2 || m == 30) {
    end_program(run, true);
    return true;
  }
  if (m != Block::kNone && !end_m(run, m)) return false;
  if ((m == 99 || m == 89) && !call_cycle_by_m(run, m, false)) return false;
  stop(run, StopKind::Program);
  return true;
}

bool cycle_call(Run& run, const Block& block) {
  if (run.options.is_itnc) return itnc::cycle_call(run, block);
  if (!check_no_coordinates(run, block.m)) return false;
  if (block.m != Block::kNone && !begin_m(run, block.m)) return false;
  run.state.cycle.is_modal_call = false;
  if (!call_cycle(run)) return false;
  if (block.m == 99) return true;  // the call itself
  return finish_m(run, block.m, false);
}

bool function(Run& run, const Block& block) {
  const bool computes = block.function < 9;
  if (computes && run.state.start.is_searching && !note_computation(run, block)) return false;
  if (computes) return compute(run, block);
  return !is_true(run, block) || jump_to_label(run, block.target);
}

bool pole(Run& run, const Block& block) {
  return run.options.is_itnc ? itnc::set_pole(run, block) : set_pole(run, block);
}

bool end_by_block(Run& run, const Block&) {
  end_program(run, false);
  return true;
}

bool chamfer(Run& run, const Block& block) {
  return run.options.is_itnc ? itnc::corner(run, block) : make_blend(run, block);
}

bool round(Run& run, const Block& block) {
  return check_circle_plane(run) && chamfer(run, block);
}

bool tool(Run& run, const Block& block) {
  return run.options.is_itnc ? itnc::call_tool(run, block) : call_tool(run, block);
}

bool call(Run& run, const Block& block) {
  return call_program(run, block.target);
}

/// In the order of BlockKind.
constexpr std::array<bool (*)(Run&, const Block&),
                     static_cast<std::size_t>(BlockKind::TipControl) + 1>
    kExecute{begin_program,
             end_by_block,
             define_tool,
             tool,
             stop_block,
             positioning /* Line */,
             positioning /* PolarLine */,
             chamfer,
             pole,
             positioning /* Arc */,
             positioning /* PolarArc */,
             positioning /* TangentArc */,
             round,
             positioning /* SingleAxis */,
             meet_label,
             call_label,
             call,
             function,
             define_cycle,
             cycle_call,
             define_blank,
             probe,
             positioning /* RadiusArc */,
             itnc::assign,
             itnc::compare,
             itnc::raise_error,
             itnc::read_system,
             itnc::define_table,
             itnc::cycle_call_at,
             itnc::print,
             positioning /* Approach */,
             positioning /* Departure */,
             itnc::accept,
             itnc::set_plane,
             itnc::change_tip_control};

[[gnu::cold, gnu::noinline]] bool refuse_left_words(Run& run, const Block& block) {
  const std::string words = language::listed(run.ledger.left(), [&](std::size_t i) {
    const Coordinate& word = block.coordinates[i];
    return fmt::format("{}{}", letter(word.axis), run.number(word.value));
  });
  return run.fail(ErrorCode::BlockFormatIncorrect,
                  fmt::format("nothing in the block takes {}", words));
}

/// Positioning with MDI: a TNC 155 takes two kinds of blocks. A later control has no labels, calls
/// and contours there (User's Manual iTNC 530: positioning with manual data input).
bool check_keyed_in(Run& run, const Block& block) {
  if (!run.options.is_itnc) {
    if (block.kind == BlockKind::SingleAxis || block.kind == BlockKind::ToolCall) return true;
    return run.fail(ErrorCode::BlockFormatIncorrect,
                    "positioning with MDI takes a single-axis block or TOOL CALL");
  }
  const auto refuse = [&run](std::string_view what) {
    return run.fail(ErrorCode::NotSupported, fmt::format("{} in positioning with MDI", what));
  };
  switch (block.kind) {
    case BlockKind::Label:
    case BlockKind::LabelCall:
    case BlockKind::Comparison:
      return refuse("a label");
    case BlockKind::ProgramCall:
      return refuse("CALL PGM");
    case BlockKind::Approach:
    case BlockKind::Departure:
      return refuse("APPR or DEP");
    default:
      break;
  }
  const bool is_contour =
      block.compensation == Compensation::Left || block.compensation == Compensation::Right;
  return !is_contour || refuse("RL or RR");
}

}  // namespace

bool execute(Run& run, const Block& block) {
  if (run.options.is_mdi && !check_keyed_in(run, block)) [[unlikely]]
    return false;
  if (is_defining(run) && block.kind != BlockKind::CycleDefinition) [[unlikely]] {
    return run.fail(
        ErrorCode::CycleIncomplete,
        fmt::format("CYCL DEF {} ends before its last sub-block", run.state.cycle.defining));
  }
  if (needs_check(block) && !(run.options.is_itnc ? itnc::check_plane_angles(run, block)
                                                  : check_words(run, block))) [[unlikely]]
    return false;
  for (const std::int32_t parameter : run.parts.itnc.retained) {
    if (!itnc::check_retained(run, parameter)) return false;
  }
  run.ledger.open((1u << block.coordinate_count) - 1);
  if (!kExecute[static_cast<std::size_t>(block.kind)](run, block)) return false;
  return run.ledger.left() == 0 || refuse_left_words(run, block);
}

void warn_of_distance(Run& run) {
  run.warn(
      "TNC-DISTANCE-ORDER",
      fmt::format("G{} is in force after the block, that of its last coordinate as the control "
                  "sorts them",
                  run.state.reading.iso.is_incremental ? 91 : 90));
}

}  // namespace dripline::interpreter::tnc155
