#include "server/machines/record_ingest.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "protocol/dds/message.hpp"
#include "protocol/dds/record_text.hpp"
#include "protocol/process/log.hpp"
#include "server/machines/run_ending.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

namespace {

/// Nothing where the gateway has no setup of its own, or the text is not what gateways write.
std::optional<std::string> setup_of_start(const dds::Record& record) {
  const auto text = dds::decode_run_start(record.text);
  if (!text || text->setup.empty()) return std::nullopt;
  return text->setup;
}

using namespace std::chrono_literals;

constexpr auto kAckRetry = 20ms;

storage::Record to_stored(const dds::Record& record) {
  return {.machine = record.machine,
          .epoch = record.epoch,
          .number = record.number,
          .time = record.time,
          .run = record.run,
          .kind = std::string(dds::to_string(record.kind)),
          .block = record.block,
          .line = record.line,
          .sequence = record.sequence,
          .device = record.device,
          .text = record.text};
}

/// Records after a gap have not been stored; the gateway sends them again.
void leave_out_after(std::uint64_t stored, storage::RecordBatch& batch) {
  if (batch.records.back().number <= stored) return;
  std::erase_if(batch.records, [&](const auto& record) { return record.number > stored; });
  const auto is_reported = [&](const std::string& run, std::string_view kind) {
    return std::ranges::any_of(batch.records, [&](const auto& record) {
      return record.run == run && record.kind == kind;
    });
  };
  std::erase_if(batch.beginnings, [&](const auto& b) {
    return !is_reported(b.run, dds::to_string(dds::RecordKind::RunStarted));
  });
  std::erase_if(batch.endings, [&](const auto& e) {
    return !is_reported(e.run, dds::to_string(dds::RecordKind::RunEnded));
  });
}

}  // namespace

void RecordIngest::take(dds::Record record) {
  const std::string machine = record.machine;
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = this->lane(machine);
    if (lane.waiting.size() >= kMaxWaiting) return;
    lane.waiting.push_back(std::move(record));
    if (std::exchange(lane.is_scheduled, true)) return;
    due_.push_back(machine);
    if (std::exchange(is_gathering_, true)) return;
  }
  parts_.pool.post([this] { commit_all(); });
}

/// Hold the mutex.
RecordIngest::Lane& RecordIngest::lane(const std::string& machine) {
  Lane& lane = lanes_[machine];
  if (!lane.writer) {
    lane.writer = std::make_unique<RecordWriter>(
        RecordWriter::Parts{.store = parts_.store.records,
                            .machine = machine,
                            .consequence = "the gateway keeps them",
                            .on_fault = [this, machine](const std::string& fault) {
                              if (parts_.on_fault) parts_.on_fault(machine, fault);
                            }});
  }
  return lane;
}

void RecordIngest::greet(const std::string& machine, std::uint64_t epoch) {
  storage::RecordBatch nothing;
  nothing.machine = machine;
  nothing.epoch = epoch;
  const auto stored = parts_.store.records.store(nothing);
  if (stored && *stored > 0) succeed(machine, epoch, *stored);
}

/// Records of many machines cost one flush of the disk. What begins or ends a run may read a whole
/// program: that machine is served by itself, and delays no other.
void RecordIngest::commit_all() {
  std::vector<Taken> group = take_group();
  std::vector<storage::RecordBatch> batches;
  std::size_t records = 0;
  for (Taken& taken : group) {
    taken.foreign = foreign_runs(taken.records);
    batches.push_back(to_batch(taken.records, taken.foreign));
    records += taken.records.size();
  }
  std::vector<Result<std::uint64_t>> stored;
  if (!group.empty()) stored = parts_.store.records.store_all(batches);
  for (std::size_t i = 0; i < group.size(); ++i) {
    RecordWriter* writer = nullptr;  // lives as long as this
    {
      const std::lock_guard lock(mutex_);
      writer = lane(group[i].machine).writer.get();
    }
    conclude(std::move(group[i]), std::move(batches[i]), writer->note(stored[i]));
  }
  if (group.empty()) {
    const std::lock_guard lock(mutex_);
    is_gathering_ = !due_.empty();
    if (!is_gathering_) return;
  }
  const auto pause = records < kWorthACommit ? kGather : std::chrono::milliseconds{0};
  parts_.pool.post_after(pause, [this] { commit_all(); });
}

std::vector<RecordIngest::Taken> RecordIngest::take_group() {
  const auto changes_run = [](const dds::Record& record) {
    return record.kind == dds::RecordKind::RunStarted || record.kind == dds::RecordKind::RunEnded;
  };
  std::vector<Taken> group;
  const std::lock_guard lock(mutex_);
  while (!due_.empty() && group.size() < kMaxGroup) {
    const std::string machine = std::move(due_.front());
    due_.pop_front();
    Lane& lane = lanes_[machine];
    if (lane.waiting.empty()) {
      lane.is_scheduled = false;
    } else if (std::ranges::any_of(lane.waiting, changes_run)) {
      parts_.pool.post([this, machine] { commit(machine); });
    } else {
      group.push_back({machine, take_batch(lane), {}});
    }
  }
  return group;
}

void RecordIngest::commit(const std::string& machine) {
  Taken taken{machine, {}, {}};
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    if (lane.waiting.empty()) {
      lane.is_scheduled = false;
      return;
    }
    taken.records = take_batch(lane);
  }
  taken.foreign = foreign_runs(taken.records);
  storage::RecordBatch batch = to_batch(taken.records, taken.foreign);
  const auto stored = store(batch);
  conclude(std::move(taken), std::move(batch), stored);
}

void RecordIngest::conclude(Taken taken, storage::RecordBatch batch,
                            const Result<std::uint64_t>& stored) {
  const std::string& machine = taken.machine;
  if (!stored && !is_hopeless(stored.error())) return put_back(machine, std::move(taken.records));
  if (stored) {
    leave_out_after(*stored, batch);
    std::erase_if(batch.records, [&](const auto& r) { return taken.foreign.contains(r.run); });
    parts_.on_stored(batch);
    succeed(machine, batch.epoch, *stored);
  } else {  // not acknowledged; records after them are not delayed
    process::log_error("records dropped machine={} epoch={}: {}", machine, batch.epoch,
                       stored.error().what);
  }
  const std::lock_guard lock(mutex_);
  Lane& lane = lanes_[machine];
  lane.is_scheduled = !lane.waiting.empty();
  if (!lane.is_scheduled) return;
  due_.push_back(machine);
  if (!std::exchange(is_gathering_, true)) parts_.pool.post([this] { commit_all(); });
}

/// Records of one epoch, ascending, each once: a gateway that heard no acknowledgment repeats.
std::vector<dds::Record> RecordIngest::take_batch(Lane& lane) {
  const std::uint64_t epoch = lane.waiting.front().epoch;
  std::vector<dds::Record> records;
  while (!lane.waiting.empty() && lane.waiting.front().epoch == epoch &&
         records.size() < kMaxBatch) {
    records.push_back(std::move(lane.waiting.front()));
    lane.waiting.pop_front();
  }
  std::ranges::stable_sort(records, {}, &dds::Record::number);
  // Not ranges::unique: clang 14 cannot parse libstdc++'s.
  const auto is_same = [](const dds::Record& a, const dds::Record& b) {
    return a.number == b.number;
  };
  records.erase(std::unique(records.begin(), records.end(), is_same), records.end());
  return records;
}

/// Or not known: a gateway may know of more runs than the store. Whose a run is never changes.
bool RecordIngest::is_own(const std::string& machine, const std::string& id) {
  {
    const std::lock_guard lock(mutex_);
    if (lanes_[machine].own_run == id) return true;
  }
  const auto run = parts_.store.runs.find(id);
  if (!run) return true;
  if (run->machine != machine) return false;
  const std::lock_guard lock(mutex_);
  lanes_[machine].own_run = id;
  return true;
}

std::set<std::string> RecordIngest::foreign_runs(const std::vector<dds::Record>& records) {
  std::set<std::string> asked, foreign;
  const std::string& machine = records.front().machine;
  for (const auto& record : records) {
    if (record.run.empty()) continue;
    if (asked.insert(record.run).second && !is_own(machine, record.run)) foreign.insert(record.run);
    if (!foreign.contains(record.run)) continue;
    ++foreign_;
    const std::lock_guard lock(mutex_);
    if (std::exchange(lanes_[machine].foreign_run, record.run) == record.run) continue;
    process::log_error(
        "machine={} reports on run={}, which is another machine's: kept, without any effect on it",
        machine, record.run);
  }
  return foreign;
}

/// When it happened by the server's clock, as far as known: not later than now.
UtcTime RecordIngest::our_time(const dds::Record& record) const {
  return std::min(record.time - parts_.clock_ahead(record.machine), parts_.clock.now());
}

storage::RecordBatch RecordIngest::to_batch(const std::vector<dds::Record>& records,
                                            const std::set<std::string>& foreign) {
  storage::RecordBatch batch;
  batch.machine = records.front().machine;
  batch.epoch = records.front().epoch;
  const UtcTime received = parts_.clock.now();
  for (const auto& record : records) {
    batch.records.push_back(to_stored(record));
    batch.records.back().received = received;
    if (foreign.contains(record.run)) continue;
    if (record.kind == dds::RecordKind::RunStarted) {
      batch.beginnings.push_back({.run = record.run,
                                  .started = our_time(record),
                                  .gateway_setup = setup_of_start(record)});
    }
    if (record.kind != dds::RecordKind::RunEnded) continue;
    auto ending = read_run_ending(parts_.store, record);
    if (ending) {
      ending->ended = our_time(record);
      batch.endings.push_back(*std::move(ending));
    } else {
      process::log_error("end of run not understood machine={} run={} record={}: {}",
                         record.machine, record.run, record.number, ending.error().what);
    }
  }
  return batch;
}

Result<std::uint64_t> RecordIngest::store(const storage::RecordBatch& batch) {
  RecordWriter* writer = nullptr;  // lives as long as this
  {
    const std::lock_guard lock(mutex_);
    writer = lane(batch.machine).writer.get();
  }
  if (batch.beginnings.empty() && batch.endings.empty()) return writer->store(batch);
  const std::lock_guard lock(parts_.state_mutex);
  return writer->store(batch);
}

void RecordIngest::put_back(const std::string& machine, std::vector<dds::Record> records) {
  std::chrono::milliseconds pause{};
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    lane.waiting.insert(lane.waiting.begin(), std::make_move_iterator(records.begin()),
                        std::make_move_iterator(records.end()));
    pause = lane.writer->pause();
  }
  parts_.pool.post_after(pause, [this, machine] { commit(machine); });
}

void RecordIngest::succeed(const std::string& machine, std::uint64_t epoch, std::uint64_t number) {
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    lane.ack = {.machine = machine, .epoch = epoch, .number = number};
    lane.ack_is_owed = true;
  }
  acknowledge(machine);
}

/// The newest acknowledgment contains the older ones, so only that one is ever repeated.
void RecordIngest::acknowledge(const std::string& machine) {
  dds::RecordAck ack;
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    if (!std::exchange(lane.ack_is_owed, false)) return;
    ack = lane.ack;
  }
  const auto written = parts_.endpoint.write(ack);
  if (written || written.error().code != Errc::Timeout) return;
  {
    const std::lock_guard lock(mutex_);
    lanes_[machine].ack_is_owed = true;
  }
  parts_.pool.post_after(kAckRetry, [this, machine] { acknowledge(machine); });
}

Result<std::uint64_t> RecordWriter::note(Result<std::uint64_t> stored) {
  if (!stored && is_hopeless(stored.error())) return stored;
  std::chrono::milliseconds before{};
  {
    const std::lock_guard lock(mutex_);
    before = pause_;
    pause_ =
        stored ? std::chrono::milliseconds{0} : std::clamp(pause_ * 2, kFirstPause, kLongestPause);
  }
  if (!stored) {
    if (before.count() == 0) {
      process::log_error("records cannot be stored, {} machine={}: {}", parts_.consequence,
                         parts_.machine, stored.error().what);
    }
    if (parts_.on_fault) parts_.on_fault(stored.error().what);
  } else if (before.count() > 0) {
    process::log_info("records are stored again machine={}", parts_.machine);
    if (parts_.on_fault) parts_.on_fault("");
  }
  return stored;
}

std::chrono::milliseconds RecordWriter::pause() const {
  const std::lock_guard lock(mutex_);
  return pause_;
}

}  // namespace dripline::machines
