#include "gateway/app/control_memory.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <cmath>
#include <unordered_map>

#include "protocol/dds/message.hpp"

namespace dripline::gateway {
namespace {

constexpr std::size_t kMaxCells = dds::kMaxRecordText - 64;  ///< bytes of them in one text

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

}  // namespace

ControlMemory::ControlMemory(report::Outbox& outbox) : outbox_(outbox) {
  for (const auto& [name, kept] : outbox.memory())
    cells_[name] = {kept, interpreter::Keeps::Always};
}

std::vector<interpreter::VariableRecord> ControlMemory::begin(
    std::vector<interpreter::MemoryCell> cells, std::vector<double> base,
    const interpreter::Setup& setup) {
  known_ = std::move(cells);
  base_ = std::move(base);
  named_.clear();
  for (const auto& variable : setup.variables) named_[variable.name] = true;
  std::unordered_map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < known_.size(); ++i) places[known_[i].name] = i;

  std::vector<interpreter::VariableRecord> given;
  for (auto cell = cells_.begin(); cell != cells_.end();) {
    const auto& [name, now] = *cell;
    const auto place = places.find(name);
    const bool is_as_before = place != places.end() &&
                              report::is_same_number(now.kept.base, base_[place->second]) &&
                              now.kept.is_named == named_.contains(name);
    if (is_as_before) {
      given.push_back({name, now.kept.value});
      ++cell;
      continue;
    }
    spdlog::info("memory: {} is {} by the setup, not {} as it was kept", name,
                 place == places.end() ? "gone" : number_text(base_[place->second]),
                 number_text(now.kept.value));
    cell = cells_.erase(cell);
    has_unstaged_ = has_changed_ = true;
  }
  return given;
}

void ControlMemory::note(std::size_t place, double value) {
  const interpreter::MemoryCell& cell = known_.at(place);
  cells_[cell.name] = {{value, base_.at(place), named_.contains(cell.name)}, cell.keeps};
  if (cell.keeps == interpreter::Keeps::Always) has_unstaged_ = has_changed_ = true;
}

void ControlMemory::stage() {
  has_unstaged_ = false;
  const auto& stored = outbox_.memory();
  for (const auto& [name, cell] : cells_) {
    if (cell.keeps != interpreter::Keeps::Always) continue;
    const auto found = stored.find(name);
    if (found == stored.end() || found->second != cell.kept) outbox_.stage_cell(name, cell.kept);
  }
  for (const auto& [name, kept] : stored) {
    if (!cells_.contains(name)) outbox_.stage_cell(name, std::nullopt);
  }
}

std::vector<std::string> ControlMemory::report() const {
  std::vector<std::string> parts;
  for (const auto& [name, cell] : cells_) {
    if (cell.keeps != interpreter::Keeps::Always) continue;
    const std::string entry = fmt::format("\"{}\":[{},{}]", name, number_text(cell.kept.value),
                                          number_text(cell.kept.base));
    if (parts.empty() || parts.back().size() + entry.size() > kMaxCells) parts.emplace_back();
    parts.back() += (parts.back().empty() ? "" : ",") + entry;
  }
  if (parts.empty()) parts.emplace_back();  // nothing any more is worth telling too
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] =
        fmt::format("{{\"part\":{},\"parts\":{},\"cells\":{{{}}}}}", i + 1, parts.size(), parts[i]);
  }
  return parts;
}

}  // namespace dripline::gateway
