#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

/// The conversational editor on the TOML text of an event file: everything else in the file, and
/// its comments, stay as they are. Comment lines directly above an `[[event]]` go with it. Pure.
/// Errors of all: those of `read_toml`; Unsupported (JSON, or events that are not written as
/// `[[event]]`, each on a line of its own); LimitExceeded (a file over kMaxFile).

namespace dripline::conversational {

struct ListedEvent {
  std::size_t number = 0;  ///< from 0, as errors name it
  std::string type;        ///< empty where the event has none
  int line = 0;            ///< of its `[[event]]`
  std::string fields;      ///< `x = 1, z = -2`: as written, without the type and comments
};

struct EventQuery {
  std::string type = {};         ///< empty: any
  std::optional<int> tool = {};  ///< tool changes and calls of this tool
  std::string text = {};         ///< within `fields`, in any case; empty: any
};

/// Lists the events that match; faults of their fields do not matter.
Result<std::vector<ListedEvent>> list_events(std::string_view file, const EventQuery& query);

/// Deletes the events first to last. NotFound (no such event), Syntax (a range that runs
/// backwards), Conflict (the program's first or last event, as at the control; a file that could be
/// posted could not be any more, as with the begin of a pattern whose end stays). Of a file that
/// cannot be posted faults do not matter, so a faulty event can be deleted.
Result<std::string> delete_events(std::string_view file, std::size_t first, std::size_t last);

/// Inserts `[[event]]` tables before an event. NotFound (no such event), Conflict (before the
/// first, as at the control), and the errors of `read_events` for the whole result.
Result<std::string> insert_events(std::string_view file, std::size_t before,
                                  std::string_view inserted);

}  // namespace dripline::conversational
