#include "clients/cli/text/table.hpp"

#include <algorithm>

#include "protocol/base/invariant.hpp"

namespace dripline::cli {
namespace {

std::string padding(std::size_t width, std::size_t used) {
  return std::string(width > used ? width - used : 0, ' ');
}

struct Slot {
  std::size_t width = 0;
  Align align = Align::Left;
  bool is_last = false;
};

void append_cell(std::string& line, const Cell& cell, const Slot& slot, bool has_color) {
  const std::string text = styled(cell.text, cell.style, has_color);
  const std::string pad = padding(slot.width, columns(cell.text));
  line += slot.align == Align::Right ? pad + text : text;
  if (slot.is_last) return;
  if (slot.align == Align::Left) line += pad;
  line += "  ";
}

void end_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + "\n";
}

}  // namespace

void Table::add(std::vector<Cell> row) {
  invariant(row.size() == columns_.size(), "a table row has as many cells as columns");
  for (auto& cell : row) cell.text = cell.text.empty() ? "-" : printable(cell.text);
  rows_.push_back(std::move(row));
}

std::string Table::render(bool has_color) const {
  std::vector<Slot> slots;
  std::vector<Cell> headings;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    std::size_t width = columns(columns_[i].heading);
    for (const auto& row : rows_) width = std::max(width, columns(row[i].text));
    slots.push_back({width, columns_[i].align, i + 1 == columns_.size()});
    headings.emplace_back(columns_[i].heading, Style::Heading);
  }
  std::string out;
  const auto add_line = [&](const std::vector<Cell>& cells) {
    std::string line;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      append_cell(line, cells[i], slots[i], has_color);
    }
    end_line(out, std::move(line));
  };
  add_line(headings);
  for (const auto& row : rows_) add_line(row);
  return out;
}

std::string Details::render(bool has_color) const {
  std::size_t width = 0;
  for (const auto& line : lines_) width = std::max(width, columns(line.name));
  std::string out;
  for (const auto& line : lines_) {
    const std::string text = line.value.text.empty() ? "-" : printable(line.value.text);
    end_line(out, styled(line.name, Style::Faint, has_color) + padding(width, columns(line.name)) +
                      "  " + styled(text, line.value.style, has_color));
  }
  return out;
}

}  // namespace dripline::cli
