#include "gateway/app/run/run_session.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/moved_axes.hpp"

namespace dripline::gateway {

using interpreter::StepState;

namespace {

std::int64_t unix_milliseconds(UtcTime time) {
  return std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

}  // namespace

Result<std::unique_ptr<RunSession>> RunSession::make(Parts parts,
                                                     const interpreter::Dialect& dialect,
                                                     const interpreter::Setup& setup) {
  std::unique_ptr<RunSession> session(new RunSession(std::move(parts), dialect, setup));
  interpreter::Setup given = setup;
  given.answers.clear();
  const auto make = [&](const interpreter::Setup& its_setup, interpreter::EventSink& events) {
    return dialect.make(its_setup, session->feed(), events);
  };
  auto made = make(given, session->tracker_);
  if (!made) return fail(made.error());
  session->interpreter_ = std::move(*made);
  if (auto done = session->give_memory(make, given); !done) return fail(done.error());
  if (const auto* modes = session->parts_.modes) {
    if (auto restored = session->interpreter_->restore(*modes); !restored)
      return fail(restored.error());
    auto* const moved = dynamic_cast<interpreter::MovedAxes*>(session->interpreter_.get());
    if (moved != nullptr) moved->find_axes(session->parts_.at);
  }
  session->begin_live();
  session->tool_history_.begin(session->parts_.tool, session->interpreter_->modes());
  session->note_modes();
  if (auto begun = session->begin_check(make, given); !begun) return fail(begun.error());
  if (!session->parts_.restart) return session;
  if (auto begun = session->begin_rebuild(); !begun) return fail(begun.error());
  return session;
}

/// The values of the setup alone decide which kept values are given in addition.
Result<void> RunSession::give_memory(const Make& make, const interpreter::Setup& setup) {
  retained_ = dynamic_cast<interpreter::RetainedMemory*>(interpreter_.get());
  if (retained_ == nullptr) return {};
  const auto make_with = [&](const std::vector<interpreter::VariableRecord>& kept) -> Result<void> {
    interpreter::Setup given = setup;
    given.variables.insert(given.variables.end(), kept.begin(), kept.end());
    auto made = make(given, tracker_);
    if (!made) return fail(made.error());
    interpreter_ = std::move(*made);
    retained_ = dynamic_cast<interpreter::RetainedMemory*>(interpreter_.get());
    cells_.clear();
    (void)retained_->read_memory(cells_);
    return {};
  };
  ControlMemory& memory = parts_.memory;
  (void)retained_->read_memory(cells_);
  const auto kept = memory.begin(retained_->memory_cells(), cells_, setup);
  if (!kept) return fail(kept.error());
  if (!kept->empty()) {
    if (auto done = make_with(*kept); !done) return done;
  }
  known_ = cells_;
  if (!parts_.begins_with_former_memory) return {};
  const auto former = memory.at_beginning(parts_.run.revision);
  if (!former) return fail(former.error());
  if (auto done = make_with(*former); !done) return done;
  note_changes(1);
  return {};
}

/// With an interpreter of its own, in the state in which the run's begins: what the control has
/// kept is not in the setup.
Result<void> RunSession::begin_check(const Make& make, const interpreter::Setup& setup) {
  if (!parts_.check) return {};
  auto check = std::make_unique<ProgramCheck>(ProgramCheck::Parts{
      .machine = std::move(parts_.check),
      .capabilities = parts_.machine.capabilities(),
      .dialect = dialect_,
      .at = parts_.at,
      .lengths = parts_.lengths,
      .answers = setup_.answers,
      .is_test = parts_.is_test,
      .time = parts_.is_test ? [this] { return interpreter::local_time_at(clock_ms()); }
                             : std::function<interpreter::LocalTime()>(),
      .name_of = [this](interpreter::ProgramIndex program) {
        const auto called = feed().called_programs();
        return program <= called.size() ? called[program - 1].name : std::string();
      }});
  auto made = make(setup, check->events());
  if (!made) return fail(made.error());
  if (retained_ != nullptr || parts_.modes != nullptr)
    if (auto same = (*made)->restore(interpreter_->snapshot()); !same) return same;
  check->begin(*std::move(made));
  check_ = std::move(check);
  return {};
}

namespace {

interpreter::EventSink& front_of(std::optional<interpreter::DryRun>& stage,
                                 const std::optional<interpreter::PanelTables::DryRun>& dry_run,
                                 const interpreter::Position& at, interpreter::EventSink& out) {
  if (!dry_run) return out;
  return stage.emplace(out, Feed::per_minute(dry_run->feed), dry_run->turns_spindle, at);
}

}  // namespace

RunSession::RunSession(Parts parts, const interpreter::Dialect& dialect,
                       const interpreter::Setup& setup)
    : parts_(std::move(parts)),
      setup_(setup),
      begun_ms_(unix_milliseconds(parts_.clock.now())),
      dialect_(dialect),
      events_(parts_.machine.capabilities(), parts_.machine.events(),
              [this] {
                return machine::CapabilityFilter::Now{interpreter_->modes(),
                                                      interpreter_->origin().block};
              },
              {dialect.length_shifts_position, dialect.moves_with_length,
               [this](const ToolLengths& lengths) { parts_.machine.set_lengths(lengths); }}),
      tracker_(front_of(dry_run_, parts_.dry_run, parts_.at, events_)),
      tool_history_(dialect.length_shifts_position) {
  events_.begin(parts_.at, parts_.lengths);
  tracker_.begin(parts_.at, parts_.lengths);
  tracker_.use_rapid_feed(dialect.rapid_feed);
  if (parts_.machine.capabilities().adds_lengths) {
    tracker_.use_lengths([this] {
      const interpreter::ActiveModes modes = interpreter_->modes();
      return ReachedHeights::Lengths{machine::axis_lengths_of(modes), modes.lengths(),
                                     dialect_.length_shifts_position};
    });
  }
  if (parts_.checkpoints != nullptr)
    checkpoints_.emplace(parts_.run.run, *parts_.checkpoints, parts_.clock);
}

std::size_t RunSession::fill(std::size_t max_blocks) {
  waits_ = Waits::ForMachine;
  if (is_over_ || is_rebuilding() || check_) return 0;
  if (has_question_ && !resolve_question()) return 0;
  drop_modes();
  std::size_t blocks = 0;
  while (blocks < max_blocks && parts_.machine.has_room()) {
    const std::uint64_t before = interpreter_->blocks();
    const StepState step = interpreter_->step(1);
    // A step that ends no block ends somewhere inside of one.
    const std::uint64_t now = interpreter_->blocks();
    is_at_boundary_ = step == StepState::Ran && now != before;
    switch (step) {
      case StepState::Ran:
        ++blocks;
        note_modes();
        note_memory();
        // Also of a motion that waits for the next blocks, which may end the length.
        if (!events_.note_block(interpreter_->origin())) {
          is_over_ = true;
          return blocks;
        }
        if (is_at_boundary_ && is_checkpoint_due()) take_checkpoint();
        break;
      case StepState::NeedsText:
        waits_ = Waits::ForText;
        return blocks;
      case StepState::NeedsAnswer:
        has_question_ = true;
        if (!resolve_question()) return blocks;
        break;
      case StepState::Ended:
      case StepState::Alarmed:
        note_modes();
        note_memory();
        is_over_ = true;
        return blocks + 1;
    }
  }
  if (blocks == max_blocks) waits_ = Waits::ForNothing;
  return blocks;
}

void RunSession::note_modes() {
  const interpreter::ActiveModes modes = interpreter_->modes();
  // Coordinates are not compared for every block: that would cost as much as half a block does.
  if (modes_.empty() || modes_.back().modes.frame_changes != modes.frame_changes) {
    Frame& noted = frames_.emplace_back();
    noted.block = interpreter_->blocks();
    noted.frame = interpreter_->frame();
    if (!modes_.empty()) modes_.back().modes.frame_changes = modes.frame_changes;
  }
  if (modes_.empty() || modes_.back().modes != modes)
    modes_.push_back({interpreter_->blocks(), modes});
  tool_history_.note(interpreter_->blocks(), modes, tracker_.take_moves());
}

namespace {

/// Tables that were converted to another unit and back differ in the last digits.
bool is_unchanged(double before, double now) {
  constexpr double kNoise = 1e-14;
  return report::is_same_number(before, now) ||
         std::fabs(now - before) <= kNoise * std::fabs(before);
}

}  // namespace

void RunSession::begin_live() {
  live_ = dynamic_cast<interpreter::LiveValues*>(interpreter_.get());
  if (live_ != nullptr) (void)live_->read_live(live_known_);
  parts_.memory.begin_live(live_ != nullptr ? live_->live_names() : std::vector<std::string>(),
                           live_known_);
}

void RunSession::note_live() {
  if (live_ == nullptr || !live_->read_live(live_now_)) return;
  if (live_now_.size() > live_known_.size()) {
    const auto names = live_->live_names();
    for (std::size_t i = live_known_.size(); i < names.size(); ++i)
      parts_.memory.add_live(names[i]);
    live_known_.resize(live_now_.size(), interpreter::kVacant);
  }
  for (std::size_t i = 0; i < live_now_.size(); ++i) {
    if (report::is_same_number(live_known_[i], live_now_[i])) continue;
    live_known_[i] = live_now_[i];
    live_changes_.push_back({interpreter_->origin().block, i, live_now_[i]});
  }
}

void RunSession::note_memory() {
  note_live();
  if (retained_ != nullptr && retained_->read_memory(cells_))
    note_changes(interpreter_->origin().block);
}

/// The changes take effect when `block` has been executed.
void RunSession::note_changes(std::uint64_t block) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (is_unchanged(known_[i], cells_[i])) continue;
    known_[i] = cells_[i];
    changes_.push_back({block, i, cells_[i]});
  }
}

void RunSession::keep_memory(std::uint64_t executed) {
  for (; !changes_.empty() && changes_.front().block <= executed; changes_.pop_front())
    parts_.memory.note(changes_.front().cell, changes_.front().value);
  for (; !live_changes_.empty() && live_changes_.front().block <= executed;
       live_changes_.pop_front())
    parts_.memory.note_live(live_changes_.front().cell, live_changes_.front().value);
}

void RunSession::drop_modes() {
  const machine::MachineStatus status = parts_.machine.status();
  keep_memory(status.executed);  // so that no more changes wait than blocks
  const std::uint64_t executing = status.origin.block;
  while (modes_.size() > 1 && modes_[1].block <= executing) modes_.pop_front();
  while (frames_.size() > 1 && frames_[1].block <= executing) frames_.pop_front();
  tool_history_.drop(executing);
}

const interpreter::ActiveModes& RunSession::modes_at(std::uint64_t block) const {
  std::size_t last = modes_.size() - 1;
  while (last > 0 && modes_[last].block > block) --last;
  return modes_[last].modes;
}

const std::optional<interpreter::CoordinateFrame>& RunSession::frame_at(std::uint64_t block) const {
  std::size_t last = frames_.size() - 1;
  while (last > 0 && frames_[last].block > block) --last;
  return frames_[last].frame;
}

bool RunSession::keeps_zero_when_moved() const {
  return dynamic_cast<const interpreter::MovedAxes*>(interpreter_.get()) != nullptr;
}

Result<interpreter::Snapshot> RunSession::take_modes() {
  if (auto done = interpreter_->begin_next_text(); !done) return fail(done.error());
  return interpreter_->snapshot();
}

std::optional<std::uint64_t> RunSession::set_block_skip(std::uint16_t levels) {
  if (is_over_ || !interpreter_->set_block_skip(levels)) return std::nullopt;
  want_checkpoint();
  return interpreter_->blocks();
}

/// A restart looks through the whole program with one setting.
void RunSession::note_skip_change(const std::string& change, std::uint64_t last, bool block_skip) {
  constexpr std::size_t kMaxChanges = 160;  // bytes, of a reason for people
  if (!checkpoints_) return;
  std::string& changes = conditions_.skip_changes;
  if (last == 0) {
    conditions_.block_skip = block_skip;
  } else if (changes.size() + change.size() <= kMaxChanges) {
    changes += fmt::format("{}{} after block {}", changes.empty() ? "" : ", ", change, last);
  } else if (!changes.ends_with(" ...")) {
    changes += " ...";
  }
  parts_.checkpoints->checkpoints().stage_conditions(parts_.run.run,
                                                     encode(parts_.run.run, conditions_));
}

std::int64_t RunSession::clock_ms() const {
  std::int64_t shown = unix_milliseconds(parts_.clock.now());
  if (setup_.date_time) shown = interpreter::milliseconds_of(*setup_.date_time) + shown - begun_ms_;
  return shown + static_cast<std::int64_t>(std::round(clock_ahead_ * 1000));
}

void RunSession::pass_machine_time(double seconds, std::optional<double> factor) {
  if (std::isfinite(seconds)) motion_seconds_ += seconds;
  if (const auto executed = parts_.recorder.reached().executed; executed != timed_) {
    timed_ = executed;
    executed_seconds_ = motion_seconds_;
  }
  if (std::isfinite(seconds)) clock_ahead_ += factor ? seconds - seconds / *factor : seconds;
}

void RunSession::note_real_time(SteadyTime::duration elapsed) {
  const bool moves = parts_.machine.state() == machine::MachineState::Running;
  if (moves && !parts_.machine.capabilities().simulated_time)
    motion_seconds_ += std::chrono::duration<double>(elapsed).count();
}

void RunSession::size_feed(std::optional<double> speed_factor) {
  if (!speed_factor || is_rebuilding() || check_) return feed().set_consumption(std::nullopt);
  const double seconds = parts_.machine.buffered().count() / *speed_factor;
  const interpreter::Origin& ahead = interpreter_->origin();
  const interpreter::Origin at = parts_.machine.status().origin;
  if (ahead.block == 0) return feed().set_consumption(0);
  // Across a call or a jump back the distance in bytes is no measure; the last size stays.
  if (ahead.program != at.program || ahead.offset <= at.offset || seconds <= 0) return;
  feed().set_consumption(static_cast<double>(ahead.offset - at.offset) / seconds);
}

}  // namespace dripline::gateway
