#include "gateway/interpreter/dialects/centurion/codes/execution.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/codes/modes.hpp"
#include "gateway/interpreter/dialects/centurion/compensation/nose_compensation.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"
#include "gateway/interpreter/dialects/centurion/motion/probe_moves.hpp"

namespace dripline::interpreter::centurion {

namespace {

/// Uses the axis words of the block.
bool act(Run& run) {
  const Block::Parts& parts = run.block.parts;
  if (parts.has_corner_words && !check_corner_words(run)) [[unlikely]]
    return false;
  if (parts.axis_row == kNoRow) [[likely]]
    return move(run);
  run.ledger.take_all();  // each of these refuses the words it does not use
  return g_row(parts.axis_row).act(run);
}

/// The dwell, the move or what takes its place; a probe move ends with its answer.
bool execute_move(Run& run) {
  if (const Answer* answer = run.next_answer()) {
    finish_probe(run, std::get<ProbeResult>(*answer));
    run.item_done();
    return true;
  }
  if (!act_before_move(run) || !act(run)) return false;
  return run.ledger.left() == 0 || check_words_used(run);
}

/// After a question the block resumes in its stage.
void enter(Block::Parts& parts, Stage stage) {
  parts.stage = stage;
  parts.m_next = 0;
}

bool execute_after_move(Run& run) {
  Block::Parts& parts = run.block.parts;
  if (parts.stage == Stage::AfterMove) {
    if (!apply_machine_functions(run, MTiming::AfterMove)) return false;
    enter(parts, Stage::PostMove);
  }
  if (parts.stage == Stage::PostMove) {
    if (!apply_machine_functions(run, MTiming::PostMove)) return false;
    enter(parts, Stage::Flow);
  }
  return plan_flow(run) && apply_machine_functions(run, MTiming::Flow);
}

}  // namespace

bool execute_block(Run& run) {
  Block::Parts& parts = run.block.parts;
  if (parts.stage == Stage::Execution) {
    if (!check_words(run) || !apply_modes(run)) return false;
    if (parts.probe && !check_probe(run)) [[unlikely]]
      return false;
    enter(parts, Stage::BeforeMove);
  }
  if (parts.stage == Stage::BeforeMove) {
    if (parts.m_count != 0 && !apply_machine_functions(run, MTiming::BeforeMove)) return false;
    parts.stage = Stage::Move;
  }
  if (parts.stage == Stage::Move) {
    if (!execute_move(run)) return false;
    enter(parts, Stage::AfterMove);
  }
  if (parts.m_count == 0 && parts.macro == 0) [[likely]]
    return true;
  return execute_after_move(run);
}

namespace {

constexpr AddressSet kWordsOfAnyBlock = set_of(Address::F, Address::S);

/// DNC FAST has neither compensation nor transformations, and takes no change of units (manual:
/// DNC).
bool check_fast(Run& run, const GRow& row) {
  switch (row.code) {
    case 20:
    case 21:
      return run.fail(ErrorCode::UnitsInFast, 0, fmt::format("G{}", row.code));
    case 41:
    case 42:
    case 511:
    case 551:
    case 568:
      return run.fail(ErrorCode::NotInDnc, 0, fmt::format("G{} in FAST", row.code));
    default:
      return true;
  }
}

bool apply_g(Run& run, const GRow& row) {
  if (run.options.is_dnc_fast && !check_fast(run, row)) [[unlikely]]
    return false;
  return row.set == nullptr || row.set(run, row);
}

/// F is in the feed unit that is in force at the end of the block (manual: G98 and G99).
bool apply_feed(Run& run) {
  const double feed = run.block.words[Address::F];
  const bool is_inch = run.state.units == Units::Inch;
  const double lowest_per_minute = is_inch ? 0.0001 : 0.01;
  const double most = is_inch ? 999.9999 : 99999.99;
  // The metric range is one of mm/min; per revolution the minimum is the least increment.
  const double lowest = run.state.modes.is_feed_per_revolution ? 0.0001 : lowest_per_minute;
  if (!(feed >= lowest && feed <= most)) {
    return run.fail(ErrorCode::FeedOutOfRange, run.block.words.column(Address::F),
                    fmt::format("F{} is not in {} to {}", feed, lowest, most));
  }
  run.state.feed[run.state.modes.is_feed_per_revolution] = feed;
  return true;
}

/// S is the limit on a G50 block, else the speed of the spindle unit in force.
bool apply_speed(Run& run) {
  const double speed = run.block.words[Address::S];
  if (!(speed >= 1 && speed <= 9999)) {
    return run.fail(ErrorCode::SpindleOutOfRange, run.block.words.column(Address::S),
                    fmt::format("S{} is not in 1 to 9999", speed));
  }
  const bool is_limit = run.axis_code() == 50;
  const bool is_fixed = !is_limit && !run.state.modes.is_surface_speed;
  if (const double most = max_revolutions(run); is_fixed && speed > most) {
    return run.fail(ErrorCode::SpindleOutOfRange, run.block.words.column(Address::S),
                    fmt::format("S{} is above {} of this spindle range", speed, most));
  }
  SpindleModes& spindle = run.state.spindle;
  if (is_limit) {
    spindle.limit = speed;
  } else if (run.state.modes.is_surface_speed) {
    spindle.surface = speed;
  } else {
    spindle.revolutions = speed;
  }
  return true;
}

[[gnu::cold, gnu::noinline]] bool refuse_words(Run& run, AddressSet left) {
  const Block& block = run.block;
  for (std::size_t i = 0; i < kAddressCount; ++i) {
    const auto address = static_cast<Address>(i);
    if ((left & set_of(address)) == 0) continue;
    return run.fail(
        ErrorCode::IllegalAddress, block.words.column(address),
        fmt::format("no code in this block uses {}{}", to_string(address), block.words[address]));
  }
  return true;
}

bool is_data_block(const Run& run) {
  const Block& block = run.block;
  if (block.parts.is_assignment_only && block.words.present() == 0) return true;
  return block.parts.g_count == 1 && block.parts.m_count == 0 && block.words.present() == 0 &&
         g_row(block.g[0]).group == ModalGroup::Data;
}

}  // namespace

bool check_words(Run& run) {
  const Block& block = run.block;
  run.ledger.open(block.words.present() & kLineWords);
  AddressSet taken = kWordsOfAnyBlock | block.parts.taken;
  if (block.parts.macro != 0 || passes_arguments(run)) return true;
  if (run.axis_code() == 65) taken = kWordsOfAnyBlock | kLineWords;
  if (block.parts.axis_row == kNoRow) taken |= kLineWords;
  if (block.parts.jump == JumpKind::Call || block.parts.jump == JumpKind::Gosub) {
    taken |= set_of(Address::L);
  }
  for (std::uint8_t i = 0; i < block.parts.m_count; ++i) {
    if (block.m[i] == 98) taken |= set_of(Address::P, Address::L);
  }
  const AddressSet left = block.words.present() & ~taken;
  return left == 0 || refuse_words(run, left);
}

bool check_words_used(Run& run) {
  return refuse_words(run, static_cast<AddressSet>(run.ledger.left()));
}

bool apply_modes(Run& run) {
  const Block& block = run.block;
  if (run.state.modes.takes_data && !is_data_block(run)) [[unlikely]] {
    return run.fail(ErrorCode::IllegalG10, 0, "between G10 and G11 only P n = value");
  }
  const SpindleModes before = run.state.spindle;
  const bool was_surface_speed = run.state.modes.is_surface_speed;
  for (std::uint8_t i = 0; i < block.parts.g_count; ++i) {
    if (!apply_g(run, g_row(block.g[i]))) return false;
  }
  if (block.parts.m_count != 0) apply_spindle_range(run);
  const bool has_arguments = passes_arguments(run);
  if (block.words.has(Address::F) && !has_arguments && !takes_lead(run) && !apply_feed(run))
    return false;
  if (block.words.has(Address::S) && !has_arguments && !apply_speed(run)) return false;
  if (block.parts.tool) apply_tool(run);
  if (run.state.nose_is_stale) [[unlikely]] {
    if (!update_compensation(run)) return false;
  }
  show_speed_change(run, before, was_surface_speed);
  return true;
}

bool act_before_move(Run& run) {
  const Block::Parts& parts = run.block.parts;
  if (parts.dwell) {
    run.state.dwell_seconds = *parts.dwell;
    run.events().on_dwell({run.origin, *parts.dwell, {}});
    if (*parts.dwell > 0) run.loops.note_progress();
  }
  for (std::uint8_t i = 0; i < parts.g_count; ++i) {
    const GRow& row = g_row(run.block.g[i]);
    if (row.before_move != nullptr && !row.before_move(run, row)) return false;
  }
  return true;
}

}  // namespace dripline::interpreter::centurion
