#pragma once

#include <map>
#include <optional>
#include <string>

#include "protocol/base/result.hpp"
#include "storage/sqlite/database.hpp"

namespace dripline::report {

/// One thing that the machine's control keeps when a program is over; a vacant one is NaN.
struct KeptCell {
  double value = 0;
  double base = 0;        ///< the setup's value when `value` was written
  bool is_named = false;  ///< the setup gave it as a variable
  friend bool operator==(const KeptCell& a, const KeptCell& b);
};
using KeptCells = std::map<std::string, KeptCell>;
/// Two vacant ones are the same.
bool is_same_number(double a, double b);

/// What the control keeps, in the tables `memory`, `memory_beginning` and `memory_state` of the
/// outbox's file, sealed with a digest. Changes are staged; the outbox writes them in its own
/// transaction (`write`, then `apply` once that is committed). One thread.
class KeptMemory {
 public:
  /// The memory when a run of the revision began at its first block; the last one that did.
  struct Beginning {
    std::string revision;  ///< SHA-256; empty: none, or not known
    KeptCells cells;
    friend bool operator==(const Beginning&, const Beginning&) = default;
  };

  /// As they were at the last commit.
  const KeptCells& cells() const { return cells_; }
  const Beginning& beginning() const { return beginning_; }
  /// Why the memory cannot be used: its rows differ from what was written, or were lost with a
  /// former file. Empty: it is sound. Stays until the memory is discarded.
  const std::string& fault() const { return fault_; }

  /// Stages what is kept under a name; nullopt: no longer.
  void stage_cell(const std::string& name, const std::optional<KeptCell>& cell) {
    staged_cells_[name] = cell;
  }
  void stage_beginning(Beginning beginning) { staged_beginning_ = std::move(beginning); }
  void stage_fault(const std::string& fault) { staged_fault_ = fault; }
  /// Stages the end of a fault, with nothing kept.
  void stage_none();

  Result<void> load(storage::sqlite::Database& database);
  bool is_staged() const { return !staged_cells_.empty() || staged_beginning_ || staged_fault_; }
  Result<void> write(storage::sqlite::Database& database) const;
  /// What was staged is in force.
  void apply();
  /// Drops what was staged.
  void discard();

 private:
  Result<void> load_state(storage::sqlite::Database& database);
  Result<void> write_cells(storage::sqlite::Database& database) const;
  Result<void> write_beginning(storage::sqlite::Database& database) const;
  KeptCells cells_with_staged() const;

  KeptCells cells_;
  Beginning beginning_;
  std::string fault_;
  std::map<std::string, std::optional<KeptCell>> staged_cells_;
  std::optional<Beginning> staged_beginning_;
  std::optional<std::string> staged_fault_;
};

}  // namespace dripline::report
