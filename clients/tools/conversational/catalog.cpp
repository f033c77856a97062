#include "clients/tools/conversational/catalog.hpp"

namespace dripline::conversational {
namespace {

/// Lists the fields that the walk shows it; the event stays unchanged.
class FormLister : public Form {
 public:
  explicit FormLister(EventDescription& description) : description_(description) {}

  void number(const Field& field, Entry&) override { add(FieldKind::Number, field); }
  void whole(const Field& field, std::optional<int>&) override { add(FieldKind::Whole, field); }
  void text(const Field& field, std::string&) override { add(FieldKind::Text, field); }
  void feedrate(const Field& field, Feedrate& entry) override {
    add(FieldKind::Feedrate, field).blank = entry.is_rapid ? "rapid" : "";
  }
  void choice(const Field& field, std::span<const std::string_view> names,
              std::size_t& index) override {
    auto& added = add(FieldKind::Choice, field);
    added.choices.assign(names.begin(), names.end());
    added.blank = names[index];
  }
  void demand(bool, std::string_view text) override { description_.rules.emplace_back(text); }
  void set_units(UnitSystem) override {}

 private:
  FieldDescription& add(FieldKind kind, const Field& field) {
    FieldDescription added;
    added.kind = kind;
    added.name = field.name;
    added.word = field.word;
    added.help = field.help;
    added.condition = field.condition;
    added.is_required = field.is_required;
    const bool is_text = kind == FieldKind::Text;
    added.english = is_text ? Limits{0, field.max, 0} : limits_of(field, UnitSystem::English);
    added.metric = is_text ? Limits{0, field.max, 0} : limits_of(field, UnitSystem::Metric);
    return description_.fields.emplace_back(std::move(added));
  }
  EventDescription& description_;
};

}  // namespace

std::string_view to_string(FieldKind kind) {
  constexpr std::string_view kWords[] = {"number", "whole", "text", "feed or rapid", "choice"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::vector<EventDescription> describe_events() {
  std::vector<EventDescription> all;
  for (const auto& kind : event_kinds()) {
    EventDescription description{std::string(kind.type), std::string(kind.title), {}, {}};
    FormLister lister(description);
    Event event = kind.blank;
    walk_fields(lister, event);
    all.push_back(std::move(description));
  }
  return all;
}

}  // namespace dripline::conversational
