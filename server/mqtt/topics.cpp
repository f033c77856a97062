#include "server/mqtt/topics.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <array>

namespace dripline::mqtt {
namespace {

constexpr std::array<std::string_view, 10> kKinds{
    "run_started", "run_ended", "output", "probe",         "message",
    "stop",        "warning",   "alarm",  "device_opened", "device_closed"};

}  // namespace

Result<void> check_prefix(std::string_view prefix) {
  if (prefix.size() > kMaxPrefix) {
    return fail(Errc::LimitExceeded, "'{}' has {} characters: at most {}", prefix, prefix.size(),
                kMaxPrefix);
  }
  const bool is_plain = std::ranges::all_of(
      prefix, [](char c) { return c > ' ' && c < '\x7f' && c != '+' && c != '#'; });
  const bool has_levels = !prefix.empty() && prefix.front() != '/' && prefix.back() != '/' &&
                          prefix.find("//") == std::string_view::npos;
  if (is_plain && has_levels && prefix.front() != '$') return {};
  return fail(Errc::Syntax,
              "'{}' must be levels with / between them, without blanks, + and #, and not begin "
              "with $",
              prefix);
}

Result<void> check_kind(std::string_view kind) {
  if (std::ranges::find(kKinds, kind) != kKinds.end()) return {};
  return fail(Errc::Syntax, "'{}' is no kind of record: {}", kind, fmt::join(kKinds, ", "));
}

std::string online_topic(const std::string& prefix) {
  return prefix + "/online";
}

std::string status_topic(const std::string& prefix, const std::string& machine) {
  return fmt::format("{}/{}/status", prefix, machine);
}

std::string record_topic(const std::string& prefix, const storage::Record& record) {
  return fmt::format("{}/{}/records/{}", prefix, record.machine, record.kind);
}

std::string record_id(const storage::Record& record) {
  return fmt::format("{}-{}-{}", record.machine, record.epoch, record.number);
}

}  // namespace dripline::mqtt
