#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"

namespace dripline::storage {

struct Machine {
  std::string name;
  std::string control;
  std::string description;
  std::string gateway_version;
  std::uint64_t epoch = 0;
  std::uint64_t last_record = 0;  ///< of this epoch, stored without a gap
  UtcTime first_seen, last_seen;
};

/// Who holds the motion of a machine, and why.
struct MachineHold {
  std::string machine;
  std::string run;          ///< empty: of no run
  std::string who, reason;  ///< reason empty: none was given
  UtcTime since;
};

/// Promises of every store: storage/store.hpp.
class MachineStore {
 public:
  virtual ~MachineStore() = default;

  /// Adds or updates, also one that was removed. `last_record` is the store's own and ignored,
  /// `first_seen` is kept. Errors: Syntax and LimitExceeded (the name).
  virtual Result<void> save(const Machine& machine) = 0;
  /// Errors: NotFound.
  virtual Result<Machine> find(const std::string& name) = 0;
  /// In order of their names, without those that were removed.
  virtual Result<std::vector<Machine>> list() = 0;
  /// It is listed no more, until it is saved again; what refers to it (runs, records, setups)
  /// stays, and `find` finds it. With an entry of the audit trail. Errors: NotFound (not listed),
  /// Busy (a run of it has not ended), Conflict (jobs of it are open).
  virtual Result<void> remove(const std::string& name, const Actor& who, UtcTime time) = 0;

  /// A later hold replaces the earlier one. Errors: NotFound (the machine).
  virtual Result<void> hold(const MachineHold& hold) = 0;
  /// One that is not held stays so.
  virtual Result<void> release(const std::string& machine) = 0;
  virtual Result<std::vector<MachineHold>> holds() = 0;
};

}  // namespace dripline::storage
