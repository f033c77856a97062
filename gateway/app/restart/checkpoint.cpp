#include "gateway/app/restart/checkpoint.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include "gateway/interpreter/core/language/state_archive.hpp"

namespace dripline::gateway {

using interpreter::language::StateReader;
using interpreter::language::StateWriter;
using report::Bytes;

namespace {

constexpr std::uint32_t kFormat = 3;
/// Of answers, whose times have milliseconds; kFormat: without.
constexpr std::uint32_t kAnswerFormat = 4;
/// Of conditions, which name changes of switches; kFormat: without.
constexpr std::uint32_t kConditionsFormat = 5;
/// Of endings, which have the place where the axes rested; kThreadFormat: without; kFormat: without
/// whether the tool stopped in a thread, too.
constexpr std::uint32_t kEndingFormat = 8, kThreadFormat = 6;

/// Of checkpoints, which have the heights that axes and tip have reached, and what shows that they
/// are clear. Those without are refused: nothing else shows it.
constexpr std::uint32_t kCheckpointFormat = 10;

/// What bytes are, and of what.
struct Label {
  std::string_view kind, owner;
};

Digest seal_of(const Label& label, std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.update(label.kind);
  hash.update(std::string_view(" of "));
  hash.update(label.owner);
  hash.update(std::string_view("\n"));
  hash.update(bytes);
  return hash.digest();
}

Bytes with_seal(const Label& label, Bytes bytes) {
  const Digest seal = seal_of(label, bytes);
  bytes.insert(bytes.end(), seal.bytes.begin(), seal.bytes.end());
  return bytes;
}

template <class Value>
Bytes sealed(const Label& label, Value& value, std::uint32_t format = kFormat) {
  StateWriter writer;
  writer(format, value);
  return with_seal(label, writer.take());
}

template <class Value>
Result<Value> opened(const Label& label, const Bytes& bytes, std::uint32_t expected = kFormat) {
  const auto damage = [&] {
    return fail(Errc::Corrupt, "{} of {} bytes is not as it was written", label.kind, bytes.size());
  };
  if (bytes.size() < Digest::kSize) return damage();
  const std::size_t size = bytes.size() - Digest::kSize;
  const Bytes content(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  const Digest seal = seal_of(label, content);
  if (!std::equal(seal.bytes.begin(), seal.bytes.end(),
                  bytes.begin() + static_cast<std::ptrdiff_t>(size))) {
    return damage();
  }
  StateReader reader(content);
  std::uint32_t format = 0;
  reader(format);
  if (format != expected)
    return fail(Errc::Unsupported, "{} of format {}; this is {}", label.kind, format, expected);
  Value value{};
  reader(value);
  if (!reader.is_complete()) return damage();
  return value;
}

constexpr std::string_view kCheckpoint = "checkpoint", kConditions = "conditions of a run",
                           kEnding = "ending of a run", kAnswer = "answer";

/// Of kFormat: a time without milliseconds.
struct FormerTime {
  int year = 0, month = 1, day = 1, hour = 0, minute = 0, second = 0;
};
using FormerAnswer =
    std::variant<interpreter::ProbeResult, interpreter::PromptAnswer, bool, FormerTime>;

interpreter::Answer answer_of(const FormerAnswer& former) {
  if (const auto* time = std::get_if<FormerTime>(&former)) {
    return interpreter::LocalTime{time->year, time->month,  time->day,
                                  time->hour, time->minute, time->second};
  }
  if (const auto* probe = std::get_if<interpreter::ProbeResult>(&former)) return *probe;
  if (const auto* prompt = std::get_if<interpreter::PromptAnswer>(&former)) return *prompt;
  return std::get<bool>(former);
}

/// Of kFormat.
struct FormerConditions {
  std::string machine, server_setup, gateway_setup;
  bool block_skip = false;
  std::string start;
  interpreter::Position begun_at;
  std::string restart_of;
};

/// Of kFormat.
struct FormerEnding {
  report::Progress executed;
  std::int64_t time_us = 0;
  bool is_completed = false;
  std::optional<interpreter::Position> stopped_at;
  std::string memory;
  InHand in_hand;
};
/// Of kThreadFormat.
struct ThreadEnding {
  report::Progress executed;
  std::int64_t time_us = 0;
  bool is_completed = false;
  std::optional<interpreter::Position> stopped_at;
  std::string memory;
  InHand in_hand;
  bool is_in_thread = false;
};

template <class Former>
RunEnding ending_of(Former former) {
  return {.executed = former.executed,
          .time_us = former.time_us,
          .is_completed = former.is_completed,
          .stopped_at = former.stopped_at,
          .memory = std::move(former.memory),
          .in_hand = std::move(former.in_hand)};
}

std::string numbered(std::string_view run, std::uint64_t number) {
  return fmt::format("{} {}", run, number);
}

}  // namespace

Bytes encode(std::string_view run, Checkpoint checkpoint) {
  return sealed({kCheckpoint, run}, checkpoint, kCheckpointFormat);
}
Result<Checkpoint> decode_checkpoint(std::string_view run, const Bytes& bytes) {
  return opened<Checkpoint>({kCheckpoint, run}, bytes, kCheckpointFormat);
}

Bytes sealed_checkpoint(std::string_view run, Bytes content) {
  return with_seal({kCheckpoint, run}, std::move(content));
}
Bytes sealed_conditions(std::string_view run, Bytes content) {
  return with_seal({kConditions, run}, std::move(content));
}
Bytes sealed_ending(std::string_view run, Bytes content) {
  return with_seal({kEnding, run}, std::move(content));
}
Bytes sealed_answer(std::string_view run, std::uint64_t number, Bytes content) {
  return with_seal({kAnswer, numbered(run, number)}, std::move(content));
}

Bytes encode(std::string_view run, Conditions conditions) {
  return sealed({kConditions, run}, conditions, kConditionsFormat);
}
Result<Conditions> decode_conditions(std::string_view run, const Bytes& bytes) {
  auto conditions = opened<Conditions>({kConditions, run}, bytes, kConditionsFormat);
  if (conditions || conditions.error().code != Errc::Unsupported) return conditions;
  auto former = opened<FormerConditions>({kConditions, run}, bytes);
  if (!former) return conditions;
  return Conditions{.machine = std::move(former->machine),
                    .server_setup = std::move(former->server_setup),
                    .gateway_setup = std::move(former->gateway_setup),
                    .block_skip = former->block_skip,
                    .start = std::move(former->start),
                    .begun_at = former->begun_at,
                    .restart_of = std::move(former->restart_of),
                    .skip_changes = {}};
}

Bytes encode(std::string_view run, RunEnding ending) {
  return sealed({kEnding, run}, ending, kEndingFormat);
}
Result<RunEnding> decode_ending(std::string_view run, const Bytes& bytes) {
  auto ending = opened<RunEnding>({kEnding, run}, bytes, kEndingFormat);
  if (ending || ending.error().code != Errc::Unsupported) return ending;
  if (auto former = opened<ThreadEnding>({kEnding, run}, bytes, kThreadFormat)) {
    RunEnding read = ending_of(*former);
    read.is_in_thread = former->is_in_thread;
    return read;
  }
  auto former = opened<FormerEnding>({kEnding, run}, bytes);
  return former ? Result<RunEnding>(ending_of(*std::move(former))) : ending;
}

Bytes encode(std::string_view run, std::uint64_t number, interpreter::Answer answer) {
  return sealed({kAnswer, numbered(run, number)}, answer, kAnswerFormat);
}
Result<interpreter::Answer> decode_answer(std::string_view run, std::uint64_t number,
                                          const Bytes& bytes) {
  const std::string owner = numbered(run, number);
  auto answer = opened<interpreter::Answer>({kAnswer, owner}, bytes, kAnswerFormat);
  if (answer || answer.error().code != Errc::Unsupported) return answer;
  const auto former = opened<FormerAnswer>({kAnswer, owner}, bytes);
  if (!former) return answer;
  return answer_of(*former);
}

}  // namespace dripline::gateway
