#pragma once

#include <utility>

#include "server/api/api.hpp"

namespace dripline::api {

/// Asks a machine for something that the audit trail has before it goes out, and after it with what
/// came of it. `ask` returns a Result whose value has a `text`. Errors: those of the trail, and of
/// `ask`.
template <class Ask>
auto ask_audited(library::AuditTrail& audit, library::AuditTrail::Change change, const Ask& ask)
    -> decltype(ask()) {
  if (auto written = audit.write_before(change); !written) return fail(written.error());
  auto answer = ask();
  if (answer) {
    change.detail += ": " + answer->text;
  } else {
    const bool is_unknown = answer.error().code == Errc::Timeout;
    change.detail += is_unknown ? ": not answered" : ": refused, " + answer.error().what;
  }
  audit.write(std::move(change));
  return answer;
}

}  // namespace dripline::api
