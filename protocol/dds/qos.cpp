#include "protocol/dds/qos.hpp"

#include <charconv>
#include <string_view>

#include "protocol/dds/endpoint.hpp"

// Why no writer here is KEEP_ALL: a KEEP_ALL writer stops taking samples while any matched reader
// has not acknowledged the old ones, and a killed peer stays a matched reader until its lease ends.
// A restarted gateway would wait seconds for the ghost of its predecessor. With KEEP_LAST the
// newest sample replaces the oldest unacknowledged one instead, so a write never waits; the layer
// above requests or sends lost samples again, which it must be able to do anyway (the pull, the
// outbox, commands with ids). The depths exceed what that layer keeps in flight, so with a live
// peer no sample is ever lost.
namespace dripline::dds {
namespace {

// A write that is not accepted at once (it should not happen, see above) fails instead of blocking
// the caller's thread.
constexpr dds_duration_t kMaxBlocking = DDS_MSECS(5);

// Readers are emptied in the callback that fills them; this bounds them if a handler stalls.
constexpr int kReaderFactor = 4;

Qos reliable() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kMaxBlocking);
  // The end of a writer must not dispose the machine's instance: a gateway's successor may already
  // be writing it.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

Qos keep_last(std::size_t depth) {
  Qos qos = reliable();
  const int samples = static_cast<int>(depth);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, samples);
  dds_qset_resource_limits(qos.get(), samples * kReaderFactor, DDS_LENGTH_UNLIMITED, samples);
  return qos;
}

/// A reader that comes later gets the latest value of each machine, as long as the writer lives.
/// Presence is the participant's lease (NetworkOptions::lease_ms): a deadline would make an idle
/// machine look dead, because these are written on change.
Qos latest_value() {
  Qos qos = reliable();
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, 1);
  return qos;
}

}  // namespace

std::string partition_of(const std::string& machine) {
  return "machine." + machine;
}

std::string partition_of_all() {
  return "machine.*";
}

Qos partition_qos(const std::string& partition) {
  Qos qos(dds_create_qos());
  dds_qset_partition1(qos.get(), partition.c_str());
  return qos;
}

// User data needs no agreement: an older gateway does not look at it.
void set_term(const Qos& qos, std::uint64_t term) {
  if (term == 0) return;
  const std::string text = fmt::format("term={}", term);
  dds_qset_userdata(qos.get(), text.data(), text.size());
}

std::uint64_t term_in(const dds_qos_t* qos) {
  constexpr std::string_view kBegin = "term=";
  void* data = nullptr;
  std::size_t size = 0;
  if (qos == nullptr || !dds_qget_userdata(qos, &data, &size)) return 0;
  const std::string text(static_cast<const char*>(data), data == nullptr ? 0 : size);
  dds_free(data);
  if (!text.starts_with(kBegin)) return 0;
  std::uint64_t term = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + kBegin.size(), end, term);
  return read.ec == std::errc{} && read.ptr == end ? term : 0;
}

// A restarted server must learn of the gateways without a request.
template <>
Qos topic_qos<Announce>() {
  return latest_value();
}

// Only the newest status matters: a slow server skips, it does not queue.
template <>
Qos topic_qos<Status>() {
  return latest_value();
}

// A reader that asks for no acknowledgment: without it a status costs the server no packet, and a
// gateway keeps nothing. It is repeated until it is superseded, at least once a second
// (gateway/report/status_publisher.hpp), so a lost one hides an alarm or a stop for no longer; an
// older one never follows a newer one. The writer stays as it was: servers and gateways before and
// after this match.
template <>
Qos reader_qos<Status>() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

// All best-effort readers of a writer share one idea of which sample comes next, and nothing but
// the end of the writer sets it back: after a single forged datagram with a high number every
// status of the gateway is an old one. A reliable reader that asks for the latest value catches up
// by itself, with an idea of its own, and stays so while the shared one is ahead of it.
Qos renewed_status_qos() {
  return topic_qos<Status>();
}

// The outbox sends records again until they are acknowledged; the depth is its window.
template <>
Qos topic_qos<Record>() {
  return keep_last(kRecordWindow);
}

// An acknowledgment covers everything before it, so a newer one replaces an older one.
template <>
Qos topic_qos<RecordAck>() {
  return keep_last(1);
}

// Volatile on purpose: a restarted gateway must not receive old commands. A person's commands come
// singly; more unacknowledged commands than this mean that the gateway hangs.
template <>
Qos topic_qos<Command>() {
  return keep_last(64);
}

template <>
Qos topic_qos<CommandResult>() {
  return keep_last(64);
}

// Idempotent; the gateway asks again after a silence.
template <>
Qos topic_qos<BlockRequest>() {
  return keep_last(64);
}

// The pull is the flow control: a gateway that requests at most kBlockWindow pieces loses none. At
// most 2 MiB for each machine, and only while they are unacknowledged.
template <>
Qos topic_qos<BlockData>() {
  return keep_last(kBlockWindow);
}

// One at a time for each machine, repeated until it is answered.
template <>
Qos topic_qos<LineRequest>() {
  return keep_last(8);
}

// The pull is the flow control: one piece is asked for at a time.
template <>
Qos topic_qos<LineData>() {
  return keep_last(8);
}

}  // namespace dripline::dds
