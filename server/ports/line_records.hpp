#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/record_ingest.hpp"
#include "server/ports/line_types.hpp"
#include "server/ports/strand.hpp"
#include "storage/record_store.hpp"

namespace dripline::ports {

/// Records of a machine without a gateway: numbered here, in an epoch of the server's process that
/// is later than all before, and stored before any listener is notified. While the store refuses,
/// everything waits in its order and is tried again with the same numbers, so that a commit whose
/// answer was lost duplicates nothing. Used on the strand only.
class LineRecords : public std::enable_shared_from_this<LineRecords> {
 public:
  struct Parts {
    storage::RecordStore& store;
    const Clock& clock;
    Strand strand;
    std::string machine;
    std::uint64_t epoch = 0;
    std::function<void(const storage::RecordBatch&)> on_stored;  ///< on the strand
    /// On the strand, at every try: why nothing can be stored; empty: it can again.
    std::function<void(const std::string& fault)> on_fault = {};
  };
  struct Entry {
    storage::Record record;  ///< machine, epoch, number and time are filled in here
    std::optional<storage::RunBeginning> beginning;
    std::optional<storage::RunEnding> ending;
    std::function<void()> on_stored;  ///< may be empty
  };
  explicit LineRecords(Parts parts);

  /// Stores them, at once or later. The caller keeps the number of waiting ones bounded.
  void add(std::vector<Entry> entries);
  /// At the server's end, when the strand has stopped: what still waits is not tried again. Returns
  /// how many records that were.
  std::size_t drop();
  std::size_t waiting() const { return waiting_.size(); }
  std::uint64_t epoch() const { return parts_.epoch; }

 private:
  void commit();
  Result<void> number_waiting();
  void retry();

  Parts parts_;
  machines::RecordWriter writer_;
  std::deque<Entry> waiting_;
  std::optional<std::uint64_t> last_;  ///< number given last
  std::size_t numbered_ = 0;           ///< of those that wait
};

/// The line that each machine is connected to now. Any thread.
class LineDirectory {
 public:
  virtual ~LineDirectory() = default;
  /// nullptr: no enabled port has this machine.
  virtual std::shared_ptr<PortLine> line_of(const std::string& machine) const = 0;
  /// In order of the ports' names.
  virtual std::vector<std::shared_ptr<PortLine>> lines() const = 0;
  /// Of a machine that has, or had, a line. Used on its strand only.
  virtual std::shared_ptr<LineRecords> records_of(const std::string& machine) const = 0;
};

}  // namespace dripline::ports
