#pragma once

#include <string>
#include <vector>

#include "clients/tools/conversational/fields.hpp"

namespace dripline::conversational {

enum class FieldKind { Number, Whole, Text, Feedrate, Choice };
std::string_view to_string(FieldKind kind);

/// A field, for help texts and for programs that draw screens.
struct FieldDescription {
  FieldKind kind = FieldKind::Number;
  std::string name, word, help, condition;
  bool is_required = false;  ///< where `condition` holds
  Limits english, metric;    ///< of numbers; of texts up to `max` characters
  std::vector<std::string> choices;
  std::string blank;  ///< what a blank field means; empty: nothing is posted
};

struct EventDescription {
  std::string type, title;
  std::vector<FieldDescription> fields;
  std::vector<std::string> rules;  ///< for several fields together
};

/// Every event with every field, those under conditions too.
std::vector<EventDescription> describe_events();

/// A small job as a TOML file with comments, to be changed by hand.
std::string starter_file(int program);

}  // namespace dripline::conversational
