#include "gateway/app/memory/control_memory.hpp"

#include <fmt/format.h>
#include <cmath>

#include "protocol/base/digest.hpp"
#include "protocol/dds/message.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

constexpr std::size_t kMaxCells = dds::kMaxRecordText - 64;  ///< bytes of cells in one text

/// The row of the tape among those of the memory: no cell has a blank in its name.
constexpr std::string_view kTape = "tape ";

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

}  // namespace

ControlMemory::ControlMemory(report::KeptMemory& memory) : memory_(memory) {
  for (const auto& [name, kept] : memory.cells()) {
    if (name.starts_with(kTape)) {
      tape_ = Tape{name.substr(kTape.size()), static_cast<std::uint32_t>(kept.value)};
    } else {
      cells_[name] = {kept, interpreter::Keeps::Always};
    }
  }
}

bool ControlMemory::is_in_force(const std::string& name, const report::KeptCell& kept) const {
  const auto place = places_.find(name);
  return place != places_.end() && report::is_same_number(kept.base, base_[place->second]) &&
         kept.is_named == named_.contains(name);
}

Result<std::vector<interpreter::VariableRecord>> ControlMemory::begin(
    std::vector<interpreter::MemoryCell> cells, std::vector<double> base,
    const interpreter::Setup& setup) {
  if (!fault().empty()) {
    return fail(Errc::Corrupt,
                "{}: nothing begins with unknown numbers. `dncgw panel ... "
                "discard-memory` at the machine begins with what the setup gives, `dnc memory "
                "restore` gives back what a run had left",
                fault());
  }
  known_ = std::move(cells);
  base_ = std::move(base);
  named_.clear();
  for (const auto& variable : setup.variables) named_[variable.name] = true;
  places_.clear();
  for (std::size_t i = 0; i < known_.size(); ++i) places_[known_[i].name] = i;

  std::vector<interpreter::VariableRecord> given;
  for (auto cell = cells_.begin(); cell != cells_.end();) {
    const auto& [name, now] = *cell;
    if (is_in_force(name, now.kept)) {
      given.push_back({name, now.kept.value});
      ++cell;
      continue;
    }
    const auto place = places_.find(name);
    process::log_info("memory: {} is {} by the setup, not {} as it was kept", name,
                      place == places_.end() ? "gone" : number_text(base_[place->second]),
                      number_text(now.kept.value));
    cell = cells_.erase(cell);
    has_unstaged_ = has_changed_ = true;
  }
  return given;
}

Result<std::vector<interpreter::VariableRecord>> ControlMemory::at_beginning(
    const std::string& revision) const {
  const report::KeptMemory::Beginning& beginning = memory_.beginning();
  if (revision.empty() || beginning.revision != revision) {
    return fail(Errc::NotFound,
                "memory as it was when the program began: the last run that began at its first "
                "block was {}",
                beginning.revision.empty() ? "none of the server's programs"
                                           : "of revision " + beginning.revision.substr(0, 12));
  }
  std::vector<interpreter::VariableRecord> given;
  for (const auto& [name, kept] : beginning.cells) {
    if (is_in_force(name, kept)) given.push_back({name, kept.value});
  }
  return given;
}

void ControlMemory::stage_beginning(const std::string& revision) {
  report::KeptMemory::Beginning beginning{revision, {}};
  for (const auto& [name, cell] : cells_) {
    if (cell.keeps == interpreter::Keeps::Always) beginning.cells[name] = cell.kept;
  }
  if (memory_.beginning() != beginning) memory_.stage_beginning(std::move(beginning));
}

std::vector<ControlMemory::Value> ControlMemory::values() const {
  std::vector<Value> values;
  values.reserve(known_.size() + live_.size());
  if (known_.empty()) {
    for (const auto& [name, cell] : cells_) values.push_back({name, cell.kept.value});
  }
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const auto changed = cells_.find(known_[i].name);
    values.push_back(
        {known_[i].name, changed != cells_.end() ? changed->second.kept.value : base_[i]});
  }
  values.insert(values.end(), live_.begin(), live_.end());
  return values;
}

void ControlMemory::begin_live(std::vector<std::string> names, const std::vector<double>& values) {
  live_.clear();
  for (std::size_t i = 0; i < names.size(); ++i) live_.push_back({std::move(names[i]), values[i]});
}

void ControlMemory::set_tape(const std::string& revision, std::uint32_t part) {
  const bool is_same = part == tape_part(revision) && (part > 1 || !tape_);
  if (is_same) return;
  tape_.reset();
  if (part > 1) tape_ = Tape{revision, part};
  has_unstaged_ = true;
}

std::string ControlMemory::tape_name() const {
  return tape_ ? fmt::format("{}{}", kTape, tape_->revision) : std::string();
}

void ControlMemory::discard() {
  cells_.clear();
  tape_.reset();
  memory_.stage_none();
  has_unstaged_ = false;
  has_changed_ = true;
}

void ControlMemory::note(std::size_t place, double value) {
  const interpreter::MemoryCell& cell = known_.at(place);
  cells_[cell.name] = {{value, base_.at(place), named_.contains(cell.name)}, cell.keeps};
  if (cell.keeps == interpreter::Keeps::Always) has_unstaged_ = has_changed_ = true;
}

std::optional<std::size_t> ControlMemory::place_of(const std::string& name) const {
  const auto found = places_.find(name);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

std::shared_ptr<const ControlMemory::Saved> ControlMemory::save() const {
  return std::make_shared<const Saved>(
      Saved{cells_, known_, places_, base_, named_, live_, tape_, has_unstaged_, has_changed_});
}

void ControlMemory::restore(const Saved& saved) {
  cells_ = saved.cells;
  known_ = saved.known;
  places_ = saved.places;
  base_ = saved.base;
  named_ = saved.named;
  live_ = saved.live;
  tape_ = saved.tape;
  has_unstaged_ = saved.has_unstaged;
  has_changed_ = saved.has_changed;
}

void ControlMemory::stage() {
  has_unstaged_ = false;
  const auto& stored = memory_.cells();
  for (const auto& [name, cell] : cells_) {
    if (cell.keeps != interpreter::Keeps::Always) continue;
    const auto found = stored.find(name);
    if (found == stored.end() || found->second != cell.kept) memory_.stage_cell(name, cell.kept);
  }
  for (const auto& [name, kept] : stored) {
    if (!cells_.contains(name) && name != tape_name()) memory_.stage_cell(name, std::nullopt);
  }
  if (!tape_) return;
  const report::KeptCell kept{static_cast<double>(tape_->part), 0, false};
  const auto found = stored.find(tape_name());
  if (found == stored.end() || found->second != kept) memory_.stage_cell(tape_name(), kept);
}

std::vector<std::string> ControlMemory::report(const std::string& change) const {
  std::vector<std::string> parts;
  for (const auto& [name, cell] : cells_) {
    if (cell.keeps != interpreter::Keeps::Always) continue;
    const std::string entry = fmt::format("\"{}\":[{},{}]", name, number_text(cell.kept.value),
                                          number_text(cell.kept.base));
    if (parts.empty() || parts.back().size() + entry.size() > kMaxCells) parts.emplace_back();
    parts.back() += (parts.back().empty() ? "" : ",") + entry;
  }
  if (parts.empty()) parts.emplace_back();  // an empty memory is reported too
  const std::size_t count = parts.size() + (change.empty() ? 0 : 1);
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i] = fmt::format("{{\"part\":{},\"parts\":{},\"cells\":{{{}}}}}", i + 1, count, parts[i]);
  if (!change.empty()) {
    parts.push_back(fmt::format("{{\"part\":{},\"parts\":{},\"cells\":{{}},\"change\":{}}}", count,
                                count, change));
  }
  return parts;
}

std::string ControlMemory::digest() const {
  Sha256 hash;
  for (const std::string& part : report()) hash.update(part);
  return hash.digest().hex();
}

}  // namespace dripline::gateway
