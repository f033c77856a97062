#include "gateway/line/port_view.hpp"

#include <array>

namespace dripline::line {
namespace {

template <class Kind>
struct Name {
  Kind kind;
  std::string_view text;
};
constexpr std::array kTransferStates{
    Name<TransferState>{TransferState::Sending, "sending"},
    Name<TransferState>{TransferState::Receiving, "receiving"},
    Name<TransferState>{TransferState::Completed, "completed"},
    Name<TransferState>{TransferState::Aborted, "aborted"},
    Name<TransferState>{TransferState::Interrupted, "interrupted"},
};
constexpr std::array kTrafficKinds{
    Name<TrafficKind>{TrafficKind::Sent, "sent"},
    Name<TrafficKind>{TrafficKind::Received, "received"},
    Name<TrafficKind>{TrafficKind::Fault, "fault"},
    Name<TrafficKind>{TrafficKind::Lines, "lines"},
    Name<TrafficKind>{TrafficKind::Note, "note"},
};

std::string_view name_of(const auto& names, auto kind) {
  for (const auto& name : names) {
    if (name.kind == kind) return name.text;
  }
  return "unknown";
}

}  // namespace

std::string_view to_string(TransferState state) {
  return name_of(kTransferStates, state);
}

std::string_view to_string(TrafficKind kind) {
  return name_of(kTrafficKinds, kind);
}

Result<TrafficKind> parse_traffic_kind(std::string_view text) {
  for (const auto& name : kTrafficKinds) {
    if (name.text == text) return name.kind;
  }
  return fail(Errc::Syntax, "'{}' is no kind of traffic: sent, received, fault, lines or note",
              text);
}

}  // namespace dripline::line
