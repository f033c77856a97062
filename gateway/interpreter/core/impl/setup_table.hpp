#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/result.hpp"

#include <toml++/toml.h>

/// How a setup file is read: only setup.cpp includes this, so that one translation unit sees
/// toml++.
namespace dripline::interpreter::setup_file {

/// What reading a file carries along. The first error wins; after it every reader does nothing, so
/// the readers below need no error paths of their own.
struct Reading {
  Units units;
  std::optional<Error> error;

  void complain(const toml::source_region& at, std::string_view key, std::string_view problem) {
    if (!error)
      error = Error{Errc::Syntax, fmt::format("line {}: {}: {}", at.begin.line, key, problem)};
  }
  Length length(double value) const {
    return units == Units::Inch ? Length::inch(value) : Length::mm(value);
  }
};

/// A number in a file is finite; whole numbers count as well.
inline std::optional<double> finite_number(const toml::node& node) {
  const auto number = node.value<double>();
  if (!node.is_number() || !number || !std::isfinite(*number)) return std::nullopt;
  return *number;
}

/// One table of the file. `name` is how errors call it, empty for the file itself. Keys that are
/// not among `known` are errors.
class Table {
 public:
  Table(Reading& reading, const toml::table& table, std::string name,
        std::initializer_list<std::string_view> known)
      : reading_(reading), table_(table), name_(std::move(name)) {
    for (const auto& [key, node] : table_) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      std::string names;
      for (const std::string_view one : known)
        names += (names.empty() ? "" : ", ") + std::string(one);
      reading_.complain(key.source(), full_name(key.str()),
                        "is not a key of a setup file here; known are " + names);
    }
  }

  bool has(std::string_view key) const { return table_.contains(key); }
  void require(std::string_view key) {
    if (!has(key)) reading_.complain(table_.source(), full_name(key), "is missing");
  }
  void complain(std::string_view key, std::string_view problem) {
    const toml::node* node = table_.get(key);
    reading_.complain(node ? node->source() : table_.source(), full_name(key), problem);
  }

  void flag(std::string_view key, bool& out) {
    read(key, "expected true or false", [&](const toml::node& node) {
      const auto* value = node.as_boolean();
      if (value) out = value->get();
      return value != nullptr;
    });
  }
  void number(std::string_view key, double& out) {
    read(key, "expected a number", [&](const toml::node& node) {
      const auto value = finite_number(node);
      if (value) out = *value;
      return value.has_value();
    });
  }
  void integer(std::string_view key, int least, int most, int& out) {
    read(key, fmt::format("expected a whole number from {} to {}", least, most),
         [&](const toml::node& node) {
           const auto* value = node.as_integer();
           if (!value || value->get() < least || value->get() > most) return false;
           out = static_cast<int>(value->get());
           return true;
         });
  }
  void length(std::string_view key, Length& out) {
    double value = 0;
    number(key, value);
    if (has(key)) out = reading_.length(value);
  }
  void text(std::string_view key, std::string& out) {
    read(key, "expected a text in quotes that is not empty", [&](const toml::node& node) {
      const auto* value = node.as_string();
      if (!value || value->get().empty()) return false;
      out = value->get();
      return true;
    });
  }
  void texts(std::string_view key, std::vector<std::string>& out) {
    each(key, "expected a list of texts in quotes", [&](const toml::node& node) {
      const auto* value = node.as_string();
      if (value) out.push_back(value->get());
      return value != nullptr;
    });
  }
  /// The keys that are axis letters: lengths of linear axes, degrees of rotary ones.
  void axes(std::initializer_list<Axis> allowed, Position& out) {
    for (const Axis axis : allowed) {
      const char name = letter(axis);
      const std::string_view key(&name, 1);
      double value = 0;
      number(key, value);
      if (!has(key)) continue;
      if (is_rotary(axis)) {
        out.set(axis, Angle::degrees(value));
      } else {
        out.set(axis, reading_.length(value));
      }
    }
  }

  /// `use(Table&)` on the table under `key`.
  template <class Use>
  void table(std::string_view key, std::initializer_list<std::string_view> known, Use use) {
    read(key, "expected a table", [&](const toml::node& node) {
      const auto* inner = node.as_table();
      if (!inner) return false;
      Table reader(reading_, *inner, full_name(key), known);
      use(reader);
      return true;
    });
  }
  /// `use(Table&)` on every table of the list under `key`.
  template <class Use>
  void tables(std::string_view key, std::initializer_list<std::string_view> known, Use use) {
    each(key, "expected a list of tables", [&](const toml::node& node) {
      const auto* inner = node.as_table();
      if (!inner) return false;
      Table reader(reading_, *inner, "[[" + full_name(key) + "]]", known);
      use(reader);
      return true;
    });
  }
  /// `use(node)` on every element of the list under `key`; false means "not as expected".
  template <class Use>
  void each(std::string_view key, std::string_view expected, Use use) {
    read(key, expected, [&](const toml::node& node) {
      const auto* list = node.as_array();
      if (!list) return false;
      for (const toml::node& element : *list) {
        if (reading_.error) return true;
        if (use(element)) continue;
        reading_.complain(element.source(), full_name(key), expected);
      }
      return true;
    });
  }
  template <class Use>
  void read(std::string_view key, std::string_view expected, Use use) {
    const toml::node* node = table_.get(key);
    if (!node || reading_.error) return;
    if (!use(*node)) reading_.complain(node->source(), full_name(key), expected);
  }
  Reading& reading() { return reading_; }

 private:
  std::string full_name(std::string_view key) const {
    return name_.empty() ? std::string(key) : name_ + "." + std::string(key);
  }
  Reading& reading_;
  const toml::table& table_;
  std::string name_;
};

}  // namespace dripline::interpreter::setup_file
