#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {

enum class Align { Left, Right };

struct Column {
  // Implicit, because most columns are aligned to the left.
  Column(std::string_view text, Align side = Align::Left) : heading(text), align(side) {}
  Column(const char* text) : Column(std::string_view(text)) {}
  std::string heading;  ///< with the unit where the cells are bare numbers
  Align align;
};
inline Column right(std::string_view heading) {
  return {heading, Align::Right};
}

struct Cell {
  // Implicit, because most cells are plain texts.
  Cell(std::string content) : text(std::move(content)) {}
  Cell(const char* content) : text(content) {}
  Cell(std::string content, Style look) : text(std::move(content)), style(look) {}
  std::string text;
  Style style = Style::Plain;
};

/// A listing: one line a row, columns aligned and two blanks apart, no trailing blanks.
class Table {
 public:
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// As many cells as columns.
  void add(std::vector<Cell> row);
  bool empty() const { return rows_.empty(); }
  std::string render(bool has_color) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// "name   value" lines, for one thing's details.
class Details {
 public:
  void add(std::string name, Cell value) { lines_.push_back({std::move(name), std::move(value)}); }
  std::string render(bool has_color) const;

 private:
  struct Line {
    std::string name;
    Cell value;
  };
  std::vector<Line> lines_;
};

}  // namespace dripline::cli
