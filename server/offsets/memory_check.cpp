#include "server/offsets/memory_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/registry.hpp"
#include "server/library/history/kept_memory.hpp"
#include "server/offsets/setup_value.hpp"

namespace dripline::offsets {
namespace {

using interpreter::Dialect;

struct CellNumber {
  interpreter::Keeps keeps = interpreter::Keeps::Always;
  double value = 0;
};
using Cells = std::map<std::string, CellNumber>;

/// What has left the numbers of a report.
std::string origin_of(const storage::MemoryReport& report) {
  const auto change = library::read_memory_change(report.texts);
  return change ? fmt::format("set by {}: {}", change->by, change->what)
                : fmt::format("as run {} left it", report.run);
}

bool is_same(double a, double b) {
  constexpr double kLastDigits = 1e-9;
  return (std::isnan(a) && std::isnan(b)) ||
         std::abs(a - b) <= kLastDigits * std::max({1.0, std::abs(a), std::abs(b)});
}

std::string number_text(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? fmt::format("{}", *number) : "vacant";
}

/// What the setup alone gives the cells of the control's memory; none: it keeps nothing.
Result<Cells> cells_under(const Dialect& dialect, const interpreter::Setup& setup) {
  interpreter::MemorySource no_text("");
  interpreter::EventSink no_sink;
  const auto made = dialect.make(setup, no_text, no_sink);
  if (!made) return fail(made.error());
  auto* memory = dynamic_cast<interpreter::RetainedMemory*>(made->get());
  if (memory == nullptr) return Cells{};
  std::vector<double> numbers;
  (void)memory->read_memory(numbers);
  const auto known = memory->memory_cells();
  Cells cells;
  for (std::size_t i = 0; i < std::min(known.size(), numbers.size()); ++i)
    cells[known[i].name] = {known[i].keeps, numbers[i]};
  return cells;
}

Result<Cells> cells_under(const Dialect& dialect, const std::string& text) {
  const auto setup = interpreter::parse_control_data(text, dialect.units);
  if (!setup) return fail(setup.error());
  return cells_under(dialect, *setup);
}

/// Cells that the correction changes, as they are before it.
Result<Cells> corrected_cells(const Dialect& dialect, const Correction& correction,
                              bool with_variables) {
  auto before = interpreter::parse_control_data(correction.before, dialect.units);
  if (!before) return fail(before.error());
  auto after = interpreter::parse_control_data(correction.changed, dialect.units);
  if (!after) return fail(after.error());
  if (!with_variables) {
    before->variables.clear();
    after->variables.clear();
  }
  auto cells = cells_under(dialect, *before);
  if (!cells) return cells;
  const auto then = cells_under(dialect, *after);
  if (!then) return then;
  std::erase_if(*cells, [&](const auto& cell) {
    const auto found = then->find(cell.first);
    return found != then->end() && is_same(found->second.value, cell.second.value);
  });
  return cells;
}

class MemoryCheck {
 public:
  MemoryCheck(const storage::Store& store, const Dialect& dialect, const Correction& correction)
      : store_(store), dialect_(dialect), correction_(correction) {}

  /// The cells that are corrected, unless there is a doubt already.
  Result<std::string> find_cells() {
    auto cells = corrected_cells(dialect_, correction_, true);
    if (!cells) return fail(cells.error());
    cells_ = *std::move(cells);
    const auto all = corrected_cells(dialect_, correction_, false);
    if (!all) return fail(all.error());
    for (const auto& [name, cell] : *all) {
      if (cells_.contains(name)) continue;
      return fmt::format(
          "the variable {} of the setup decides, whatever the setup says of {}: write its number "
          "into {} and take the variable out of the setup of {}",
          name, correction_.target, correction_.target, correction_.machine);
    }
    return std::string();
  }

  Result<std::string> doubt() {
    for (const auto& [name, cell] : cells_) {
      if (cell.keeps == interpreter::Keeps::Always) continue;
      return fmt::format(
          "{} is kept by the control until it is switched off, and not reported: "
          "what it is at the machine is not known",
          name);
    }
    if (cells_.empty()) return std::string();
    const auto reports = store_.records.memory_reports(correction_.machine, {}, {.limit = 1});
    if (!reports) return fail(reports.error());
    if (reports->empty()) return std::string();  // no program has changed anything
    const storage::MemoryReport& newest = reports->front();
    const auto kept = library::read_memory_texts(newest.texts);
    if (!kept) {
      return fmt::format("what the control keeps is not known: its report after run {}: {}",
                         newest.run, kept.error().what);
    }
    for (const auto& [name, cell] : cells_) {
      const auto found = kept->find(name);
      if (found == kept->end()) continue;
      auto why = doubt_of_cell(newest, name, found->second);
      if (!why || !why->empty()) return why;
    }
    return std::string();
  }

  Result<std::string> doubt_of_runs() {
    if (cells_.empty()) return std::string();
    for (const auto state : {storage::RunState::Active, storage::RunState::Ordered}) {
      storage::RunFilter filter;
      filter.machine = correction_.machine;
      filter.state = state;
      const auto runs = store_.runs.list(filter, {.limit = 1});
      if (!runs) return fail(runs.error());
      if (runs->empty()) continue;
      return fmt::format(
          "run {} is {}: what it changes of {} in the memory of {} is known at its "
          "end; approve it then",
          runs->front().id, to_string(state), correction_.target, correction_.machine);
    }
    return std::string();
  }

 private:
  Result<std::string> doubt_of_cell(const storage::MemoryReport& report, const std::string& name,
                                    const library::KeptCell& kept) {
    const double in_setup = cells_.at(name).value;
    const double value = kept.value.value_or(interpreter::kVacant);
    const double base = kept.base.value_or(interpreter::kVacant);
    if (is_same(value, in_setup) || is_same(value, base)) return std::string();
    if (!is_same(base, in_setup)) {  // a setup that gives it something else drops what was kept
      const auto then = setup_number(report, name);
      if (!then) return fail(then.error());
      if (*then && is_same(**then, base)) return std::string();
    }
    return fmt::format(
        "{} is {} in the memory of {} ({}, {}), {} in the setup: a step from the "
        "setup's value would be another one at the machine. Write what the memory has into the "
        "setup's {}, or give the memory the setup's value (`dnc memory clear {} --filter {}`, or "
        "`dnc memory restore`), and measure again",
        correction_.target, number_text(kept.value), correction_.machine, name, origin_of(report),
        number_text(in_setup), correction_.target, correction_.machine, name);
  }

  /// What the setup of the run that reported gave the cell; nothing: that is not known.
  Result<std::optional<double>> setup_number(const storage::MemoryReport& report,
                                             const std::string& name) {
    const auto run = store_.runs.find(report.run);
    if (!run && run.error().code != Errc::NotFound) return fail(run.error());
    if (!run || !run->setup || run->machine != correction_.machine) return std::optional<double>();
    const auto setup = store_.setups.find(run->machine, run->setup);
    if (!setup) return fail(setup.error());
    const auto cells = cells_under(dialect_, setup->text);
    if (!cells) return fail(cells.error());
    const auto found = cells->find(name);
    return found == cells->end() ? std::optional<double>() : found->second.value;
  }

  const storage::Store& store_;
  const Dialect& dialect_;
  const Correction& correction_;
  Cells cells_;
};

Result<std::string> check(const storage::Store& store, const Correction& correction,
                          bool is_approval) {
  const auto dialect = interpreter::find_dialect(correction.control);
  if (!dialect) return fail(dialect.error());
  MemoryCheck memory(store, **dialect, correction);
  auto why = memory.find_cells();
  if (why && why->empty()) why = memory.doubt();
  if (why && why->empty() && is_approval) why = memory.doubt_of_runs();
  return why;
}

/// The cells that the target has in the control's memory, whatever its value becomes.
Result<Cells> cells_of_target(const Dialect& dialect, const Correction& correction) {
  const auto target = parse_setup_target(correction.target);
  if (!target) return fail(target.error());
  const auto value = value_in_setup(correction.before, *target);
  if (!value) return fail(value.error());
  Result<Cells> cells;
  for (const double other : {*value + 0.5, *value - 0.5}) {  // one may be beyond a limit
    Correction step = correction;
    auto changed = with_value(correction.before, *target, other, 9);
    if (!changed) return Cells{};  // nothing can be proposed either
    step.changed = *std::move(changed);
    cells = corrected_cells(dialect, step, true);
    if (cells) break;
  }
  return cells;
}

/// A number of an earlier value of the setup was dropped with that.
bool has_another_number(const storage::MemoryReport& report, const Cells& cells) {
  const auto kept = library::read_memory_texts(report.texts);
  if (!kept) return true;
  return std::ranges::any_of(cells, [&](const auto& cell) {
    const auto found = kept->find(cell.first);
    if (found == kept->end()) return false;
    const double in_setup = cell.second.value;
    return !is_same(found->second.value.value_or(interpreter::kVacant), in_setup) &&
           is_same(found->second.base.value_or(interpreter::kVacant), in_setup);
  });
}

}  // namespace

Result<std::optional<UtcTime>> differed_until(const storage::Store& store,
                                              const Correction& correction) {
  const auto dialect = interpreter::find_dialect(correction.control);
  if (!dialect) return fail(dialect.error());
  const auto reports =
      store.records.memory_reports(correction.machine, {}, {.limit = kMemoryReportsBack});
  if (!reports) return fail(reports.error());
  if (reports->empty()) return std::optional<UtcTime>();
  const auto cells = cells_of_target(**dialect, correction);
  if (!cells) return fail(cells.error());
  if (cells->empty()) return std::optional<UtcTime>();
  std::optional<UtcTime> newer;
  for (const storage::MemoryReport& report : *reports) {
    // The run of the next report began with this one's numbers. The newest one is a doubt.
    if (has_another_number(report, *cells)) return newer;
    newer = report.time;
  }
  return reports->size() < kMemoryReportsBack ? std::optional<UtcTime>() : newer;
}

Result<std::string> doubt_of_step(const storage::Store& store, const Correction& correction) {
  return check(store, correction, false);
}

Result<std::string> doubt_at_approval(const storage::Store& store, const Correction& correction) {
  return check(store, correction, true);
}

}  // namespace dripline::offsets
