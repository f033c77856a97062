#include "server/library/history/kept_memory.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dripline::library {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxText = 4096;  ///< of a record

/// A number or null.
bool read_number(const Json& json, std::optional<double>& number) {
  if (json.is_null()) return true;
  if (!json.is_number()) return false;
  number = json.get<double>();
  return std::isfinite(*number);
}

/// A name as controls have them: P10, #500, G54.1P7.X
bool is_cell_name(std::string_view name) {
  if (name.empty() || name.size() > 64) return false;
  return name.find_first_not_of(
             "#.0123456789_ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz") ==
         std::string_view::npos;
}

Result<Json> parse(std::string_view text) {
  if (text.size() > kMaxText)
    return fail(Errc::LimitExceeded, "a memory text of {} bytes, at most {}", text.size(),
                kMaxText);
  // A gateway's text nests three deep; brackets within names do not occur.
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (depth > 8) return fail(Errc::Syntax, "a memory text is nested too deeply");
    if (c == ']' || c == '}') --depth;
  }
  Json json = Json::parse(text, nullptr, false);
  const auto is_count = [&](const char* key) {
    return json.contains(key) && json[key].is_number_unsigned();
  };
  if (!json.is_object() || !json.contains("cells") || !json["cells"].is_object() ||
      !is_count("part") || !is_count("parts"))
    return fail(Errc::Syntax, "a memory text without cells");
  return json;
}

}  // namespace

Result<std::map<std::string, KeptCell>> read_memory_texts(const std::vector<std::string>& texts) {
  std::map<std::string, KeptCell> cells;
  std::uint64_t part = 0, parts = 0;
  for (const std::string& text : texts) {
    const auto json = parse(text);
    if (!json) return fail(json.error());
    const auto number = (*json)["part"].get<std::uint64_t>();
    if (number == 1) cells.clear();  // a report that is sent again replaces the first
    if (number != 1 && number != part + 1)
      return fail(Errc::NotFound, "part {} of a memory after part {}", number, part);
    part = number;
    parts = (*json)["parts"].get<std::uint64_t>();
    for (const auto& [name, pair] : (*json)["cells"].items()) {
      KeptCell cell;
      const bool is_good = is_cell_name(name) && pair.is_array() && pair.size() == 2 &&
                           read_number(pair[0], cell.value) && read_number(pair[1], cell.base);
      if (!is_good) return fail(Errc::Syntax, "a memory text with a cell that is none");
      cells[name] = cell;
    }
  }
  if (part == 0 || part != parts)
    return fail(Errc::NotFound, "{} of {} parts of a memory", part, parts);
  return cells;
}

std::optional<MemoryChange> read_memory_change(const std::vector<std::string>& texts) {
  if (texts.empty()) return std::nullopt;
  const auto json = parse(texts.back());
  if (!json || !json->contains("change")) return std::nullopt;
  const Json& given = (*json)["change"];
  const auto has_text = [&](const char* key) {
    return given.contains(key) && given[key].is_string();
  };
  if (!given.is_object() || !has_text("what") || !has_text("by") || !given.contains("cells") ||
      !given["cells"].is_object())
    return std::nullopt;
  MemoryChange change{given["what"].get<std::string>(), given["by"].get<std::string>(), {}};
  for (const auto& [name, pair] : given["cells"].items()) {
    std::optional<double> before, after;
    const bool is_good = is_cell_name(name) && pair.is_array() && pair.size() == 2 &&
                         read_number(pair[0], before) && read_number(pair[1], after) && after;
    if (!is_good) return std::nullopt;
    change.cells[name] = {before, *after};
  }
  constexpr std::size_t kMaxUnit = 3;
  if (has_text("unit") && given["unit"].get<std::string>().size() <= kMaxUnit)
    change.unit = given["unit"].get<std::string>();
  if (given.contains("length")) (void)read_number(given["length"], change.length);
  if (given.contains("zero")) (void)read_number(given["zero"], change.zero);
  return change;
}

Result<std::vector<KeptMemory>> kept_memories(const storage::Store& store,
                                              const std::string& machine,
                                              const std::optional<std::string>& run,
                                              storage::Page page) {
  const auto reports = store.records.memory_reports(machine, run, page);
  if (!reports) return fail(reports.error());
  std::vector<KeptMemory> memories;
  std::string why;
  for (const auto& report : *reports) {
    auto cells = read_memory_texts(report.texts);
    if (!cells) {
      why = ": " + cells.error().what;
      continue;
    }
    KeptMemory memory{machine, report.run, std::nullopt, report.time, *std::move(cells)};
    memory.change = read_memory_change(report.texts);
    if (const auto known = store.runs.find(report.run); known && known->machine == machine)
      memory.program = known->program;
    memories.push_back(std::move(memory));
  }
  if (run && memories.empty()) {
    return fail(Errc::NotFound, "run {} of machine {} has left nothing in its control's memory{}",
                *run, machine, why);
  }
  return memories;
}

}  // namespace dripline::library
