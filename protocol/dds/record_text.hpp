#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

/// The texts of structured records (message.hpp, RecordKind) as JSON. Both ends use these.
/// Decoding is strict: every member must be there with its type; members that a newer version added
/// are ignored. Pure; any thread. Errors of decoding: Syntax, LimitExceeded (too long or nested).
namespace dripline::dds {

/// RecordKind::RunStarted
struct RunStartText {
  std::string program;
  std::string revision;  ///< SHA-256 of the content, 64 hexadecimal digits
  std::string control;
  /// SHA-256 of the gateway's own setup file, 64 hexadecimal digits; empty: it has none, or is an
  /// older gateway.
  std::string setup = {};
  friend bool operator==(const RunStartText&, const RunStartText&) = default;
};

enum class RunOutcome : std::uint8_t {
  Completed,
  Aborted,
  Alarmed,
  Interrupted,
  Tested,  ///< a test run that found nothing; nothing moved, and no part was made
};
std::string_view to_string(RunOutcome value);  ///< completed, aborted, alarmed, interrupted, tested

/// RecordKind::RunEnded
struct RunEndText {
  RunOutcome outcome = RunOutcome::Interrupted;
  std::uint64_t sent = 0;      ///< bytes of the program that the gateway received
  std::uint64_t accepted = 0;  ///< blocks interpreted
  std::uint64_t executed = 0;  ///< blocks finished by the machine
  std::uint64_t line = 0;      ///< of the last executed block, 1-based; 0: none
  std::int64_t sequence = -1;  ///< its N number, -1 none
  std::string reason;          ///< empty when completed
  /// SHA-256 of the first `content_length` bytes of the program as the gateway received them;
  /// empty: unknown.
  std::string content_sha256;
  std::uint64_t content_length = 0;
  /// Of moves and dwells, by the machine's time, and the path of the executed blocks; both absent
  /// when they are not known, and from an older gateway.
  std::optional<double> motion_seconds = {}, path_mm = {};
  friend bool operator==(const RunEndText&, const RunEndText&) = default;
};

/// RecordKind::Alarm
struct AlarmText {
  std::string code;  ///< the diagnostic's stable id
  std::string text;
  friend bool operator==(const AlarmText&, const AlarmText&) = default;
};

/// RecordKind::Probe. Axis letters to mm or degrees, as in the trace.
struct ProbeText {
  std::map<char, double> to;
  std::string until;  ///< contact, release
  bool tripped = false;
  std::map<char, double> at;
  friend bool operator==(const ProbeText&, const ProbeText&) = default;
};

/// Invalid UTF-8 becomes U+FFFD; a number that is not finite breaks an invariant.
std::string encode(const RunStartText& value);
std::string encode(const RunEndText& value);
std::string encode(const AlarmText& value);
std::string encode(const ProbeText& value);

Result<RunStartText> decode_run_start(std::string_view text);
Result<RunEndText> decode_run_end(std::string_view text);
Result<AlarmText> decode_alarm(std::string_view text);
Result<ProbeText> decode_probe(std::string_view text);

}  // namespace dripline::dds
