#pragma once

#include "clients/tools/conversational/form.hpp"

namespace dripline::conversational {

/// A kind of event: `type` in a file, `title` on the screen.
struct EventKind {
  std::string_view type, title;
  Event blank;  ///< with every default
};

/// All of them, in the order of the control's menus.
std::span<const EventKind> event_kinds();
/// nullptr: no such type.
const EventKind* find_event_kind(std::string_view type);
/// The kind of a record, for messages.
const EventKind& kind_of(const Event& event);

/// Shows the form every field of the event.
void walk_fields(Form& form, Event& event);

}  // namespace dripline::conversational
