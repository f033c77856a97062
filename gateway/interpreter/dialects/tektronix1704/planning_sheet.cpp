#include "gateway/interpreter/dialects/tektronix1704/planning_sheet.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tektronix1704/block_reader.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

/// Sign and digits of each column's widest word.
constexpr int width_of(Address address) {
  const WordFormat format = kFormats[static_cast<std::size_t>(address)];
  return format.digits + (format.is_signed ? 1 : 0);
}

/// G01 and M03 keep their two digits, whatever was written.
std::string cell(Address address, std::int32_t value) {
  const bool is_code = !kFormats[static_cast<std::size_t>(address)].is_signed &&
                       address != Address::F && address != Address::N;
  if (is_code) return fmt::format("{:02}", value);
  return address == Address::N ? fmt::format("{:03}", value) : fmt::format("{}", value);
}

std::string heading() {
  std::string row;
  for (std::size_t i = 0; i < kAddressCount; ++i) {
    row += fmt::format("{:>{}}  ", kLetters[i], width_of(static_cast<Address>(i)));
  }
  return row;
}

std::string row_of(const Words& words) {
  std::string row;
  for (std::size_t i = 0; i < kAddressCount; ++i) {
    const auto address = static_cast<Address>(i);
    row += fmt::format("{:>{}}  ", words.has(address) ? cell(address, words[address]) : "",
                       width_of(address));
  }
  return row;
}

void add_line(std::string& sheet, std::string row) {
  row.erase(row.find_last_not_of(' ') + 1);
  sheet += row + "\n";
}

}  // namespace

Result<std::string> planning_sheet(std::string_view text) {
  EventSink no_sink;
  Run run(ControlOptions{}, no_sink);
  std::string sheet;
  add_line(sheet, heading());
  bool is_leader = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at = end + 1;
    if (std::exchange(is_leader, false)) continue;
    const ReadOutcome outcome = read_line(run, line);
    if (outcome == ReadOutcome::EndCode) break;
    if (outcome == ReadOutcome::GoesOn) continue;
    if (outcome == ReadOutcome::Alarm) {
      add_line(sheet, "! " + std::string(line));
    } else if (!run.state.block.words.empty()) {
      add_line(sheet, row_of(run.state.block.words));
    }
    run.state.block = {};
  }
  return sheet;
}

}  // namespace dripline::interpreter::tektronix1704
