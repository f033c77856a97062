#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/machine_control.hpp"
#include "server/mtconnect/device_model.hpp"
#include "server/mtconnect/observation_buffer.hpp"
#include "storage/record_store.hpp"

namespace dripline::mtconnect {

/// Turns what is known of the machines into observations: only what changed, with the time of the
/// gateway that reported it. When a machine is lost all its data items are UNAVAILABLE, at the
/// server's time; when it is back they have values again, also the faults that were not cleared.
/// Faults are cleared when the machine's next run begins. Any thread; a call costs some
/// microseconds.
class Observer {
 public:
  struct Parts {
    DeviceModel& model;
    ObservationBuffer& buffer;
    const Clock& clock;
    /// The alarms of the machine's last run, if it ended with one: asked once for each machine,
    /// when it is seen for the first time. May be empty.
    std::function<std::vector<storage::Record>(const std::string& machine)> last_alarms = {};
  };
  explicit Observer(Parts parts);

  void observe(const machines::MachineView& view);
  /// A record that is on disk.
  void observe(const storage::Record& record);
  /// Adds machines that were not observed yet; those that were and are not among `views` (a port
  /// was removed) are lost.
  void reconcile(const std::vector<machines::MachineView>& views);
  /// A tool of the machine was changed, or is no longer there.
  void observe_asset(const std::string& machine, const std::string& asset, bool is_removed);

 private:
  using Batch = std::vector<NewObservation>;
  struct Fault {
    Slot slot = Slot::MotionProgram;
    ConditionState state;
  };
  struct Seen {
    std::shared_ptr<const Device> device;
    DeviceFacts facts;  ///< that `device` was made of
    bool is_available = false;
    Shared<dds::Status> status;  ///< the values observed last; absent: UNAVAILABLE
    UtcTime stale;               ///< of the status before the machine was lost
    std::vector<Fault> faults;   ///< not cleared
  };

  Seen& know(const DeviceFacts& facts, Batch& batch);
  void observe_locked(const machines::MachineView& view, Batch& batch);
  void observe_conditions(const Seen& seen, UtcTime time, Batch& batch) const;
  void observe_record(Seen& seen, const storage::Record& record, Batch& batch) const;
  void lose(Seen& seen, Batch& batch) const;

  Parts parts_;
  std::mutex mutex_;
  std::map<std::string, Seen, std::less<>> seen_;
};

/// The condition that an alarm belongs to by its number: SYSTEM for what a back end, a board or
/// LinuxCNC reports, MOTION_PROGRAM for the rest. Pure.
Slot condition_of(std::string_view code);

}  // namespace dripline::mtconnect
