#include <algorithm>
#include <utility>

#include "gateway/app/run/run_loop.hpp"
#include "gateway/app/run/start_checks.hpp"
#include "gateway/interpreter/core/option_rows.hpp"
#include "protocol/process/log.hpp"

/// How a run begins.
namespace dripline::gateway {

using machine::MachineState;

namespace {

bool begins_in_middle(const interpreter::Dialect& dialect) {
  if (dialect.options == nullptr) return true;  // its own make() decides
  const auto options = dialect.options();
  return std::ranges::any_of(options, [](const auto& one) { return one.key.key == "start_at"; });
}

}  // namespace

/// The setup of this gateway with the server's tools, offsets and variables in their place. That of
/// a restart is the one under which its run began.
Result<interpreter::Setup> RunLoop::setup_of(const StartOrigin& origin,
                                             const std::optional<RestartPlan>& restart) const {
  interpreter::Setup setup = parts_.setup;
  if (!origin.setup.empty()) {
    auto data = interpreter::parse_control_data(origin.setup, parts_.dialect.units);
    if (!data) return fail(data.error().code, "the server's setup: {}", data.error().what);
    interpreter::use_control_data(*std::move(data), setup);
  }
  const machine::OperatorPanel& panel = parts_.machine.panel();
  setup.switches.block_skip = panel.block_skip;
  if (panel.skip_levels) {
    interpreter::OptionList levels;
    for (std::int64_t level = 1; level <= parts_.dialect.switches.skip_levels; ++level)
      if ((*panel.skip_levels >> level & 1) != 0) levels.emplace_back().value = level;
    setup.control.set("skip_levels", {std::move(levels), 0});
  }
  // The machine decides, when it comes to the stop or the move.
  setup.switches.optional_stop = true;
  setup.switches.dry_run = false;
  // Axes that nothing places begin where they are, unless the setup names a start to compare with.
  if (!parts_.machine.capabilities().places_axes && setup.start == interpreter::Position{}) {
    setup.start = restart ? restart->conditions.begun_at : parts_.machine.status().axes();
    setup.start.unmark_all();
  }
  if (origin.from.is_mdi) {
    setup.is_mdi = true;
    return setup;
  }
  const auto begun = restart ? parse_start_argument(restart->conditions.start)
                             : Result<StartArgument>(origin.from);
  if (!begun) return fail(begun.error());
  const StartArgument& from = *begun;
  if (from.part) setup.control.set("part", {std::int64_t{*from.part}, 0});
  if (from.place.empty()) return setup;
  if (!begins_in_middle(parts_.dialect)) {
    return fail(Errc::Unsupported,
                "control {} begins no program in its middle (at {}): its state is known at the "
                "first block only. A run that was cut off is continued by a restart",
                parts_.dialect.name, from.place);
  }
  setup.control.set("start_at", {from.place, 0});
  if (from.pass) setup.control.set("start_pass", {std::int64_t{*from.pass}, 0});
  if (from.memory != StartMemory::Ask) {
    const bool is_former = from.memory == StartMemory::Begin;
    setup.control.set("start_memory", {std::string(is_former ? "begin" : "now"), 0});
  }
  setup.position = restart ? restart->conditions.begun_at : parts_.machine.status().axes();
  return setup;
}

/// The tape is still in the reader: the start reads the program that comes next on it.
StartOrigin RunLoop::read_on(const report::ActiveRun& run, StartOrigin origin) const {
  const std::uint32_t part = parts_.memory.tape_part(run.revision);
  StartArgument plain;
  plain.is_test = origin.from.is_test;  // which reads what a start would
  if (origin.from != plain || run.revision.empty() || part == 1) return origin;
  origin.from.part = part;
  origin.argument = fmt::format("part={}", part);
  return origin;
}

Result<void> RunLoop::begin(const report::ActiveRun& run, std::unique_ptr<feed::ProgramFeed> feed,
                            const StartOrigin& given) {
  const StartOrigin origin = read_on(run, given);
  if (parts_.machine.panel().emergency_stop) return fail(Errc::Busy, "{}", kEmergencyStop);
  resolve_at_rest();
  auto restart = plan_of(run, origin);
  if (!restart) return fail(restart.error());
  const bool is_restart = restart->has_value(), tests = is_test(origin);
  if (tests && is_restart) return fail(Errc::Busy, "{}", kTestOfRestart);
  auto setup = setup_of(origin, *restart);
  if (!setup) return fail(setup.error());
  const interpreter::Snapshot* const modes = modes_for(origin);
  const bool is_read_on = origin.from.part && !given.from.part;
  if (is_read_on && modes == nullptr)
    return fail(
        Errc::Busy,
        "program {} of the tape continues with the zero (G94), the feed and the registers that "
        "the one before it left, and these are lost: {}. Rewind the tape at the panel, or "
        "set them by MDI first",
        *origin.from.part, why_no_modes_);
  const bool is_mdi = origin.from.is_mdi, goes_on = is_mdi || modes != nullptr;
  // A program that begins with its tool, or in its middle, moves from where the last one has left.
  const bool stays = is_restart || goes_on || !origin.from.place.empty();
  ToolInPosition tool = parts_.run.tool;
  interpreter::Position at = is_restart || goes_on ? parts_.machine.status().position
                                                   : setup->position.value_or(setup->start);
  const bool drops_tool = is_mdi && modes == nullptr && parts_.machine.capabilities().tool_lengths;
  if (drops_tool) tool.drop_tool(at);
  // A program that does not continue with the modes begins without a tool.
  const bool keeps_tool = is_restart || (goes_on && !drops_tool);
  const ToolLengths lengths = keeps_tool ? parts_.machine.status().lengths : ToolLengths{};
  const interpreter::Position axes = machine::plus(at, lengths);
  if (is_mdi) {
    setup->start = at;
    setup->start.unmark_all();
  }
  Conditions conditions = is_restart ? (*restart)->conditions : conditions_of(origin);
  if (is_restart) {
    conditions.restart_of = origin.from.restart->run;
  } else {
    conditions.begun_at = axes;  // also where the machine is only now placed there
  }
  if (auto done = check_reader(parts_.machine.capabilities().reader, parts_.dialect, *setup); !done)
    return done;
  auto check = check_of(axes, tests, is_restart);
  if (!check) return fail(check.error());
  const auto kept = parts_.memory.save();
  auto session = RunSession::make(
      {.run = run,
       .feed = std::move(feed),
       .machine = parts_.machine,
       .recorder = parts_.recorder,
       .clock = parts_.clock,
       .memory = tests ? tested_memory_.emplace(parts_.memory) : parts_.memory,
       .begins_with_former_memory = origin.from.memory == StartMemory::Begin,
       .checkpoints = parts_.keeps_checkpoints && !is_mdi && !tests ? &parts_.outbox : nullptr,
       .restart = *std::move(restart),
       .check = *std::move(check),
       .is_lathe = parts_.dialect.machine == interpreter::MachineKind::Lathe,
       .is_mdi = is_mdi,
       .is_test = tests,
       .modes = modes,
       .tool = stays ? std::optional(tool) : std::nullopt,
       .at = at,
       .lengths = lengths,
       .dry_run = dry_run()},
      parts_.dialect, *setup);
  if (!session) {
    parts_.memory.restore(*kept);
    const bool is_memory =
        session.error().code == Errc::Corrupt || session.error().code == Errc::NotFound;
    return fail(session.error().code, "{}{}", is_memory ? "" : "setup: ", session.error().what);
  }
  notice_ =
      is_mdi && modes == nullptr ? notice_of_mdi() : notice_of_modes(origin, modes != nullptr);
  if (tests) notice_ = kTestRun;
  if (auto done = stage_start(run, origin, std::move(conditions), **session); !done) {
    parts_.memory.restore(*kept);
    return done;
  }

  if (!tests) {
    last_run_ = run.run;
    resting_.reset();  // what moves the axes from here on is this run
  }
  parts_.journal.begin(run.run);
  parts_.on_begin(*setup);
  if (tests) {
    note_tape(origin, modes != nullptr);
    begin_test(*std::move(session));
    return {};
  }
  locked_at_.reset();
  if (parts_.machine.panel().machine_lock)
    locked_at_ = Locked{is_mdi ? at : parts_.machine.status().position, tool};
  note_beginning(origin, modes != nullptr);
  setup_given_ = sha256(origin.setup).hex();
  begin_modes(origin, modes != nullptr);
  goes_on ? parts_.machine.begin_next(axes) : parts_.machine.begin(axes);
  parts_.machine.begin_lengths(lengths);
  parts_.run.session = std::move(*session);
  parts_.run.session->size_feed(parts_.options.speed.factor);
  parts_.run.last_message.clear();
  parts_.run.was_emergency_stopped = false;
  is_aborted_by_command_ = false;
  last_step_ = parts_.clock.steady_now();
  last_state_ = MachineState::Idle;
  has_dropped_checkpoint_ = false;
  next_sync_ = last_step_;
  next_checkpoint_ = last_step_ + parts_.options.checkpoint_interval;
  const SteadyTime deadline = last_step_ + parts_.options.cycle_start_wait;
  if (is_restart) {
    parts_.consent.await_confirmation(deadline);
  } else {
    parts_.consent.await(deadline);
  }
  return {};
}

/// The look-through of the program, if there is one. Errors: those of MotionBackend::check_begin;
/// Unsupported.
Result<std::unique_ptr<machine::MotionCheck>> RunLoop::check_of(const interpreter::Position& axes,
                                                                bool tests, bool is_restart) const {
  if (tests) {
    auto check = parts_.machine.make_test(axes);
    if (!check) return fail(Errc::Unsupported, "this machine has no test run");
    return check;
  }
  if (auto done = parts_.machine.check_begin(axes); !done) return fail(done.error());
  // A line cannot be read again, and the run of a restart was looked through before.
  if (is_restart || !parts_.keeps_checkpoints) return nullptr;
  return parts_.machine.make_check(axes);
}

/// Of a machine that does not obey the panel's switch by itself.
std::optional<interpreter::PanelTables::DryRun> RunLoop::dry_run() const {
  const machine::OperatorPanel& panel = parts_.machine.panel();
  if (!panel.dry_run || parts_.machine.capabilities().dry_run) return std::nullopt;
  return interpreter::PanelTables::DryRun{Length::mm(panel.dry_run_speed * 60),
                                          panel.dry_run_spindle};
}

/// What was done at the panel or over the network before, and could not be written then.
Result<void> RunLoop::keep_staged() {
  const auto kept = parts_.outbox.commit();
  if (kept) return {};
  return fail(kept.error().code, "what was done before cannot be kept yet: {}", kept.error().what);
}

/// Puts the start on disk: from here on the run exists, and ends exactly once.
Result<void> RunLoop::stage_start(const report::ActiveRun& run, const StartOrigin& origin,
                                  Conditions conditions, RunSession& session) {
  if (auto kept = keep_staged(); !kept) return kept;
  const bool is_whole = origin.from.place.empty() && !origin.from.restart && !origin.from.is_mdi;
  if (is_whole && !session.is_test()) {
    parts_.memory.stage_beginning(run.revision);
    parts_.memory.set_tape(run.revision, origin.from.part.value_or(1));
  }
  if (!session.is_test()) parts_.memory.stage();
  parts_.recorder.begin(run, parts_.setup_digest, [&session](std::uint64_t block) {
    return ExecutionRecorder::FeedProgress{session.feed().sent(), session.accepted(),
                                           session.path_at(block), session.length_at(block)};
  });
  if (session.keeps_checkpoints()) {
    session.keep_conditions(conditions);
    parts_.outbox.checkpoints().stage_run({run,
                                           encode(run.run, std::move(conditions)),
                                           {},
                                           origin.from.restart ? origin.from.restart->run : ""});
    session.want_checkpoint();
  }
  parts_.commands.stage_start(run.run, origin.command, notice_);
  const auto done = parts_.outbox.commit();
  if (done) return {};
  parts_.outbox.discard();
  parts_.recorder.cancel();
  return fail(done.error().code, "the start cannot be kept: {}", done.error().what);
}

/// A program that has ended leaves the reader where the next start reads on.
void RunLoop::keep_tape() {
  RunSession& session = *parts_.run.session;
  if (session.is_mdi() || session.run().revision.empty()) return;
  const std::uint32_t part = session.next_part();
  parts_.memory.set_tape(session.run().revision, part);
  if (part == 1) return;
  state_tape();
  parts_.recorder.note({}, parts_.run.last_message);
}

void RunLoop::state_tape() {
  const std::uint32_t part = parts_.memory.next_part();
  if (part == 1) return;
  std::string& message = parts_.run.last_message;
  message += fmt::format("{}the next start reads program {} of the tape",
                         message.empty() ? "" : "; ", part);
}

/// Before the session is gone. What the program has ended itself was executed up to there.
void RunLoop::note_left() {
  const RunSession& session = *parts_.run.session;
  const auto& alarm = parts_.recorder.alarm();
  const bool is_completed = parts_.run.last_execution == dds::Execution::ProgramCompleted;
  const bool has_ended_itself = is_completed || (alarm && !alarm->id.starts_with("MCH"));
  const std::uint64_t block = parts_.machine.status().origin.block;
  parts_.run.frame_left = session.frame_at(block);
  parts_.run.frame_at_rest = parts_.run.frame_left;
  parts_.run.was_shifted = session.modes_at(block).is_shifted;
  parts_.run.tool = session.tool_at_end(has_ended_itself ? std::nullopt : std::optional(block));
  if (!parts_.machine.capabilities().adds_lengths) return;
  // Such a machine knows where its axes are, wherever it was cut off.
  parts_.run.tool.left_out = parts_.machine.status().lengths;
  parts_.run.tool.unknown.reset();
}

void RunLoop::note_beginning(const StartOrigin& origin, bool has_modes) {
  const machine::OperatorPanel& panel = parts_.machine.panel();
  if (panel.machine_lock) parts_.recorder.note({}, "machine lock: the axes do not move");
  if (panel.dry_run && !panel.machine_lock) parts_.recorder.note({}, "dry run");
  note_tape(origin, has_modes);
  if (!notice_.empty()) parts_.recorder.note({}, notice_);
}

void RunLoop::note_tape(const StartOrigin& origin, bool has_modes) {
  if (!origin.from.part) return;
  parts_.recorder.note({}, fmt::format("the tape is before its program {}{}{}", *origin.from.part,
                                       has_modes ? "" : ", read with the modes of power on: ",
                                       has_modes ? "" : why_no_modes_));
}

/// And what the position becomes, which is without the length of a dropped tool.
std::string RunLoop::notice_of_mdi() const {
  const bool is_lathe = parts_.dialect.machine == interpreter::MachineKind::Lathe;
  std::string lost = to_text(parts_.run.tool.left_out, is_lathe);
  if (!parts_.machine.capabilities().tool_lengths) lost.clear();
  return fmt::format(
      "MDI begins with the modes of power on, and without a tool: {}{}{}", why_no_modes_,
      lost.empty() ? "" : ". The axes stay; the position is that of no tool from here on: ", lost);
}

}  // namespace dripline::gateway
