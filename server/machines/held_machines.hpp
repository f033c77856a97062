#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/machine_control.hpp"

namespace dripline::machines {

/// Why machines are held: who gave the hold of their motion, and for what; and the same of their
/// job queues. Known to the server, kept over its restarts, and gone when the machine continues, by
/// whatever it was resumed. Any thread.
class HoldReasons {
 public:
  struct Parts {
    const storage::Store& store;
    const Clock& clock;
    /// What is known of the machine has changed. Called without a lock; must return soon.
    std::function<void(const std::string& machine)> on_change = {};
    /// What is stored of a hold that has been given (library::LateWriter::write). Empty: at once,
    /// in the caller's thread.
    std::function<void(std::string what, std::function<Result<void>()> write)> late = {};
  };
  explicit HoldReasons(Parts parts) : parts_(std::move(parts)) {}

  /// Reads what is stored; called first. Errors: those of the store.
  Result<void> load();
  /// A hold is about to be commanded: known at once and stored later, because no hold waits for a
  /// store. One without a reason does not replace one of the same run with a reason. Returns what
  /// was there before.
  std::optional<storage::MachineHold> expect(storage::MachineHold hold);
  /// It was given, or may have been.
  void keep(const std::string& machine);
  /// It was refused: `before` is why the machine is held, if it is.
  void take_back(const std::string& machine, std::optional<storage::MachineHold> before);
  void release(const std::string& machine);
  /// nullopt: the queue is released.
  void set_queue_hold(const std::string& machine, std::optional<storage::JobHold> hold);
  /// A run that has ended is not held any more.
  void note(const storage::Run& run);
  /// Adds the reasons to what is shown, and drops those of a machine that continues.
  void add_to(MachineView& view);

  /// A hold that no status shows within this time has stopped nothing.
  static constexpr std::chrono::seconds kTakesEffect{10};

 private:
  struct Entry {
    storage::MachineHold hold;
    SteadyTime given{};
    bool is_seen = false;  ///< the machine's status has shown it
  };
  /// True: the machine continues, and its entry is gone. Hold the mutex.
  bool drop_if_over(const MachineView& view);
  /// The store gets what is known of the machine when it is written.
  void save(const std::string& machine);
  Result<void> save_now(const std::string& machine);
  void changed(const std::string& machine) const;

  const Parts parts_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
  std::map<std::string, storage::JobHold> queues_;
};

/// The machines with the reasons of their holds. A hold that is commanded here has its reason
/// before it goes out, so the first status that shows it has it too.
class HeldMachines final : public MachineControl {
 public:
  HeldMachines(storage::RunStore& runs, MachineControl& inner, HoldReasons& reasons)
      : runs_(runs), inner_(inner), reasons_(reasons) {}

  std::vector<MachineView> machines() const override;
  std::vector<MachineView> machines_after(const MachinePage& page) const override;
  Result<MachineView> machine(const std::string& name) const override;
  std::optional<std::string> machine_of_run(const std::string& run) const override {
    return inner_.machine_of_run(run);
  }
  Result<storage::Run> start(const StartRequest& request) override { return inner_.start(request); }
  Result<void> command(const CommandRequest& request) override;
  Result<std::string> values(const ValueQuery& query) override { return inner_.values(query); }
  Result<PositionAnswer> position(const PositionRequest& request) override {
    return inner_.position(request);
  }
  Result<JogAnswer> jog(const JogRequest& request) override { return inner_.jog(request); }
  Result<std::string> confirm_gateway(const std::string& machine) override {
    return inner_.confirm_gateway(machine);
  }
  Result<void> remove(const std::string& machine, const storage::Actor& who) override {
    return inner_.remove(machine, who);
  }

 private:
  Result<void> hold(const CommandRequest& request, const std::string& machine);

  storage::RunStore& runs_;
  MachineControl& inner_;
  HoldReasons& reasons_;
};

}  // namespace dripline::machines
