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
Bytes sealed(const Label& label, Value& value) {
  StateWriter writer;
  std::uint32_t format = kFormat;
  writer(format, value);
  return with_seal(label, writer.take());
}

template <class Value>
Result<Value> opened(const Label& label, const Bytes& bytes) {
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
  if (format != kFormat)
    return fail(Errc::Unsupported, "{} of format {}; this is {}", label.kind, format, kFormat);
  Value value{};
  reader(value);
  if (!reader.is_complete()) return damage();
  return value;
}

constexpr std::string_view kCheckpoint = "checkpoint", kConditions = "conditions of a run",
                           kEnding = "ending of a run", kAnswer = "answer";

std::string numbered(std::string_view run, std::uint64_t number) {
  return fmt::format("{} {}", run, number);
}

}  // namespace

Bytes encode(std::string_view run, Checkpoint checkpoint) {
  return sealed({kCheckpoint, run}, checkpoint);
}
Result<Checkpoint> decode_checkpoint(std::string_view run, const Bytes& bytes) {
  return opened<Checkpoint>({kCheckpoint, run}, bytes);
}

Bytes sealed_checkpoint(std::string_view run, Bytes content) {
  return with_seal({kCheckpoint, run}, std::move(content));
}

Bytes encode(std::string_view run, Conditions conditions) {
  return sealed({kConditions, run}, conditions);
}
Result<Conditions> decode_conditions(std::string_view run, const Bytes& bytes) {
  return opened<Conditions>({kConditions, run}, bytes);
}

Bytes encode(std::string_view run, RunEnding ending) {
  return sealed({kEnding, run}, ending);
}
Result<RunEnding> decode_ending(std::string_view run, const Bytes& bytes) {
  return opened<RunEnding>({kEnding, run}, bytes);
}

Bytes encode(std::string_view run, std::uint64_t number, interpreter::Answer answer) {
  return sealed({kAnswer, numbered(run, number)}, answer);
}
Result<interpreter::Answer> decode_answer(std::string_view run, std::uint64_t number,
                                          const Bytes& bytes) {
  return opened<interpreter::Answer>({kAnswer, numbered(run, number)}, bytes);
}

}  // namespace dripline::gateway
