#include "server/offsets/offset_history.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "gateway/interpreter/core/position_setting.hpp"
#include "server/offsets/value_in_force.hpp"

namespace dripline::offsets {
namespace {

using storage::OffsetProposal;

bool begins_with(const std::string& target, const std::string& prefix) {
  return target == prefix || (target.starts_with(prefix) && target[prefix.size()] == '.');
}

/// By the times alone.
bool may_have_parts(const storage::Archive& archive, const storage::Run& run) {
  return archive.last_time >= run.started.value_or(run.created) &&
         (!run.ended || archive.first_time <= *run.ended);
}

}  // namespace

Result<void> OffsetHistory::add_runs(HistoryEntry& entry, std::uint64_t until) {
  for (std::uint64_t setup = entry.setup.number; setup < until && entry.runs.size() < kMaxRuns;
       ++setup) {
    storage::RunFilter filter;
    filter.machine = entry.setup.machine;
    filter.setup = setup;
    auto runs = store_.runs.list(filter, {.limit = kMaxRuns - entry.runs.size()});
    if (!runs) return fail(runs.error());
    entry.runs.insert(entry.runs.end(), runs->rbegin(), runs->rend());
  }
  return add_parts(entry);
}

Result<void> OffsetHistory::add_parts(HistoryEntry& entry) {
  for (const storage::Run& run : entry.runs) {
    const auto parts = store_.measurements.parts_of_run(run.id);
    if (!parts) return fail(parts.error());
    entry.parts += parts->all();
    entry.good += parts->verdicts[static_cast<std::size_t>(measurement::Verdict::Good)];
    entry.archived += parts->archived;
    for (const std::string& file : parts->archives) {
      if (std::ranges::find(entry.archives, file) == entry.archives.end())
        entry.archives.push_back(file);
    }
  }
  const auto uncounted = store_.archives.uncounted();
  if (!uncounted) return fail(uncounted.error());
  for (const storage::Archive& archive : *uncounted) {
    const auto may_have = [&](const storage::Run& run) { return may_have_parts(archive, run); };
    if (std::ranges::any_of(entry.runs, may_have)) entry.uncounted.push_back(archive.file);
  }
  return {};
}

Result<std::vector<HistoryEntry>> OffsetHistory::list(const std::string& machine,
                                                      const std::string& target,
                                                      storage::Page page) {
  const auto known = store_.machines.find(machine);
  if (!known) return fail(known.error());
  const auto setups = store_.setups.list(machine, page);
  if (!setups) return fail(setups.error());
  std::map<std::uint64_t, OffsetProposal> proposals;
  storage::OffsetFilter filter{
      .machine = machine, .target = {}, .state = storage::OffsetState::Applied};
  const auto applied = store_.offsets.list(filter, {.limit = page.limit + page.offset});
  if (!applied) return fail(applied.error());
  for (const auto& proposal : *applied) proposals.emplace(proposal.setup.value_or(0), proposal);

  std::vector<HistoryEntry> entries;
  std::map<std::string, double> values;           // as they are now, lengths in mm
  std::map<std::string, std::size_t> last_entry;  // of each value, the one that is in force
  const auto close = [&](const std::string& name, std::uint64_t until) -> Result<void> {
    const auto found = last_entry.find(name);
    return found == last_entry.end() ? Result<void>{} : add_runs(entries[found->second], until);
  };
  for (auto at = setups->rbegin(); at != setups->rend(); ++at) {
    const auto setup = store_.setups.find(machine, at->number);
    if (!setup) return fail(setup.error());
    const auto stated = values_in_setup(setup->text);
    const auto unit = unit_in_force(setup->text, known->control);
    if (!stated || !unit) continue;  // kept before its control read it so: nothing to compare
    std::set<std::string_view> names;
    for (const NamedValue& named : *stated) {
      names.insert(named.target);
      if (!target.empty() && !begins_with(named.target, target)) continue;
      const auto parsed = parse_setup_target(named.target);
      const double value = parsed ? canonical(*parsed, named.value, *unit) : named.value;
      const auto before = values.find(named.target);
      if (before != values.end() && is_same_number(before->second, value)) continue;
      if (auto closed = close(named.target, at->number); !closed) return fail(closed.error());
      values[named.target] = value;
      last_entry[named.target] = entries.size();
      HistoryEntry entry{.target = named.target, .unit = *unit, .value = named.value, .setup = *at};
      const auto proposal = proposals.find(at->number);
      if (proposal != proposals.end() && proposal->second.target == named.target)
        entry.proposal = proposal->second;
      entries.push_back(std::move(entry));
    }
    // What it has no more ends here.
    for (auto value = values.begin(); value != values.end();) {
      if (names.contains(value->first)) {
        ++value;
        continue;
      }
      if (auto closed = close(value->first, at->number); !closed) return fail(closed.error());
      last_entry.erase(value->first);
      value = values.erase(value);
    }
  }
  if (!setups->empty()) {
    for (const auto& [name, index] : last_entry) {
      if (auto closed = close(name, setups->front().number + 1); !closed)
        return fail(closed.error());
    }
  }
  std::ranges::reverse(entries);
  return entries;
}

Result<std::vector<MachineChange>> OffsetHistory::at_machine(const ChangeQuery& query,
                                                             storage::Page page) {
  const auto reports = store_.records.memory_changes(query.machine, query.prefix, page);
  if (!reports) return fail(reports.error());
  std::vector<MachineChange> changes;
  for (const storage::MemoryReport& report : *reports) {
    auto what = library::read_memory_change(report.texts);
    if (!what) continue;
    const auto setting = interpreter::parse_position_setting(what->what);
    if (!setting) continue;
    const bool is_tool = setting->tool > 0;
    const std::string thing = is_tool                   ? fmt::format("T{}", setting->tool)
                              : setting->offset.empty() ? "datum"
                                                        : setting->offset;
    MachineChange change{report.run,
                         fmt::format("{}.{}", thing, interpreter::letter(setting->axis)),
                         report.time, *std::move(what)};
    if (query.target.empty() || begins_with(change.target, query.target))
      changes.push_back(std::move(change));
  }
  return changes;
}

Result<InForce> OffsetHistory::in_force(const std::string& id) {
  auto run = store_.runs.find(id);
  if (!run) return fail(run.error());
  InForce result{.run = *std::move(run), .unit = {}, .values = {}};
  if (!result.run.setup) return result;
  const auto setup = store_.setups.find(result.run.machine, result.run.setup);
  if (!setup) return fail(setup.error());
  auto values = values_in_setup(setup->text);
  if (!values) return fail(values.error());
  auto unit = unit_in_force(setup->text, result.run.control);
  if (!unit) return fail(unit.error());
  result.values = *std::move(values);
  result.unit = *std::move(unit);
  return result;
}

}  // namespace dripline::offsets
