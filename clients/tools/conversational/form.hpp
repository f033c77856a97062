#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "clients/tools/conversational/events.hpp"

namespace dripline::conversational {

/// Decides limits and decimals.
enum class Quantity {
  Length,
  Diameter,
  Radius,
  Feed,
  Lead,
  Angle,
  Speed,
  Seconds,
  Factor,
  Count,
  Text,
  Comment
};

/// One field of a screen: `Field{"x", "X", Quantity::Diameter, "end"}.required()`.
struct Field {
  std::string_view name = {};  ///< its key in a file
  std::string_view word = {};  ///< the letter the screen shows, empty for a toggle
  Quantity quantity = Quantity::Length;
  std::string_view help = {};
  bool is_required = false;
  bool applies = true;              ///< with the present choices of the toggles before it
  std::string_view condition = {};  ///< those choices, to be read: "coordinates = polar"
  double min = std::numeric_limits<double>::lowest();  ///< in addition to the quantity's
  double max = std::numeric_limits<double>::max();

  Field required(bool is = true) const { return with(&Field::is_required, is); }
  Field only(bool is_chosen, std::string_view choices) const {
    return with(&Field::applies, is_chosen).with(&Field::condition, choices);
  }
  Field at_least(double limit) const { return with(&Field::min, limit); }
  Field at_most(double limit) const { return with(&Field::max, limit); }

 private:
  template <class Value>
  Field with(Value Field::*member, Value value) const {
    Field changed = *this;
    changed.*member = value;
    return changed;
  }
};

struct Limits {
  double min = 0, max = 0;
  int decimals = 0;
};
/// What fits the field: the quantity's range and decimals in these units, within the field's own.
Limits limits_of(const Field& field, UnitSystem units);

/// Walks the fields of an event in the order of its screen: fills them, or lists them. The members
/// of the event are the defaults.
class Form {
 public:
  virtual ~Form() = default;
  virtual void number(const Field& field, Entry& entry) = 0;
  virtual void whole(const Field& field, std::optional<int>& entry) = 0;
  virtual void text(const Field& field, std::string& entry) = 0;
  virtual void feedrate(const Field& field, Feedrate& entry) = 0;
  virtual void choice(const Field& field, std::span<const std::string_view> names,
                      std::size_t& index) = 0;
  /// A rule over several fields; `text` states it when it does not hold.
  virtual void demand(bool holds, std::string_view text) = 0;
  /// The units of all fields from here on.
  virtual void set_units(UnitSystem units) = 0;

  /// `names` in the order of the enumerators; for a bool: false, true.
  template <class Value>
  void toggle(const Field& field, std::initializer_list<std::string_view> names, Value& value) {
    auto index = static_cast<std::size_t>(value);
    choice(field, {names.begin(), names.size()}, index);
    value = static_cast<Value>(index);
  }
};

}  // namespace dripline::conversational
