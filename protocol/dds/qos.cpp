#include "protocol/dds/qos.hpp"

#include "protocol/dds/endpoint.hpp"

// Why no writer here is KEEP_ALL: a KEEP_ALL writer stops taking samples while any matched reader
// has not acknowledged the old ones, and a killed peer stays a matched reader until its lease ends.
// A restarted gateway would wait seconds for the ghost of its predecessor. With KEEP_LAST the
// oldest unacknowledged sample gives way instead, so a write never waits; what was pushed out is
// asked for or sent again by the layer above, which has to be able to do that anyway (the pull, the
// outbox, orders with ids). Depths are larger than what that layer keeps in flight, so with a live
// peer nothing is ever pushed out.
namespace dripline::dds {
namespace {

// A write that cannot be taken at once (it should not happen, see above) fails instead of holding
// up the caller's thread.
constexpr dds_duration_t kMaxBlocking = DDS_MSECS(5);

// Readers are emptied in the callback that fills them; this bounds them should a handler stall.
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

/// The latest value of each machine is there for whoever comes later, as long as the writer lives.
/// Presence is the participant's lease (configuration.hpp): a deadline would make an idle machine
/// look dead, because these are written on change.
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

// A restarted server must learn who is there without asking.
template <>
Qos topic_qos<Announce>() {
  return latest_value();
}

// Only the newest status matters: a slow server skips, it does not queue.
template <>
Qos topic_qos<Status>() {
  return latest_value();
}

// The outbox sends again what was not acknowledged on disk; the depth is its window.
template <>
Qos topic_qos<Record>() {
  return keep_last(kRecordWindow);
}

// An acknowledgement covers everything before it, so a newer one replaces an older one.
template <>
Qos topic_qos<RecordAck>() {
  return keep_last(1);
}

// Volatile on purpose: a restarted gateway must not be handed the orders of its past. A person's
// orders come singly; more than this many unacknowledged means the gateway hangs.
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

// The pull is the flow control: a gateway that has at most kBlockWindow pieces asked for loses
// none. 2 MiB per machine at most, and only while they are unacknowledged.
template <>
Qos topic_qos<BlockData>() {
  return keep_last(kBlockWindow);
}

}  // namespace dripline::dds
