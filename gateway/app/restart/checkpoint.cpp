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

constexpr std::uint32_t kFormat = 1;

Digest seal_of(std::string_view kind, std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.update(kind);
  hash.update(bytes);
  return hash.digest();
}

Bytes with_seal(std::string_view kind, Bytes bytes) {
  const Digest seal = seal_of(kind, bytes);
  bytes.insert(bytes.end(), seal.bytes.begin(), seal.bytes.end());
  return bytes;
}

template <class Value>
Bytes sealed(std::string_view kind, Value& value) {
  StateWriter writer;
  std::uint32_t format = kFormat;
  writer(format, value);
  return with_seal(kind, writer.take());
}

template <class Value>
Result<Value> opened(std::string_view kind, const Bytes& bytes) {
  const auto damage = [&] {
    return fail(Errc::Corrupt, "{} of {} bytes is not as it was written", kind, bytes.size());
  };
  if (bytes.size() < Digest::kSize) return damage();
  const std::size_t size = bytes.size() - Digest::kSize;
  const Bytes content(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  const Digest seal = seal_of(kind, content);
  if (!std::equal(seal.bytes.begin(), seal.bytes.end(),
                  bytes.begin() + static_cast<std::ptrdiff_t>(size))) {
    return damage();
  }
  StateReader reader(content);
  std::uint32_t format = 0;
  reader(format);
  if (format != kFormat)
    return fail(Errc::Unsupported, "{} of format {}; this is {}", kind, format, kFormat);
  Value value{};
  reader(value);
  if (!reader.is_complete()) return damage();
  return value;
}

constexpr std::string_view kCheckpoint = "checkpoint", kConditions = "conditions of a run",
                           kEnding = "ending of a run", kAnswer = "answer";

}  // namespace

Bytes encode(Checkpoint checkpoint) {
  return sealed(kCheckpoint, checkpoint);
}
Result<Checkpoint> decode_checkpoint(const Bytes& bytes) {
  return opened<Checkpoint>(kCheckpoint, bytes);
}

Bytes sealed_checkpoint(Bytes content) {
  return with_seal(kCheckpoint, std::move(content));
}

Bytes encode(Conditions conditions) {
  return sealed(kConditions, conditions);
}
Result<Conditions> decode_conditions(const Bytes& bytes) {
  return opened<Conditions>(kConditions, bytes);
}

Bytes encode(RunEnding ending) {
  return sealed(kEnding, ending);
}
Result<RunEnding> decode_ending(const Bytes& bytes) {
  return opened<RunEnding>(kEnding, bytes);
}

Bytes encode(interpreter::Answer answer) {
  return sealed(kAnswer, answer);
}
Result<interpreter::Answer> decode_answer(const Bytes& bytes) {
  return opened<interpreter::Answer>(kAnswer, bytes);
}

}  // namespace dripline::gateway
