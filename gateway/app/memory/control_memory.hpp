#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/report/kept_memory.hpp"

namespace dripline::gateway {

/// The memory that this machine's control keeps from one program to the next (retained_memory.hpp):
/// the cells that programs have changed, each with what the setup gave it then. At a start the kept
/// number wins, unless the setup now gives the cell something else, or names it as a variable and
/// did not before: that change of the setup was intended, and the cell begins with its value.
/// What the control keeps for good is in the outbox and outlives the process. One thread.
class ControlMemory {
 public:
  explicit ControlMemory(report::KeptMemory& memory);

  /// A program begins under `setup`, which alone gives `cells` the numbers `base`. Returns what it
  /// is to be given besides. Errors: Corrupt (what was kept is damaged or lost).
  Result<std::vector<interpreter::VariableRecord>> begin(std::vector<interpreter::MemoryCell> cells,
                                                         std::vector<double> base,
                                                         const interpreter::Setup& setup);
  /// Whether `begin` was called: which cells there are is known.
  bool has_begun() const { return !known_.empty(); }
  /// After `begin`: the same, as it was when the last run began at its first block. Errors:
  /// NotFound (that was no run of `revision`).
  Result<std::vector<interpreter::VariableRecord>> at_beginning(const std::string& revision) const;
  /// After `begin`: stages what a start in the middle of this revision may ask for later.
  void stage_beginning(const std::string& revision);
  /// Stages an empty memory without a fault, and a tape that is wound back.
  void discard();
  /// Which program of this text its next start reads, where a text holds several as a tape does:
  /// the reader is where the last one has left it. 1 for any other text.
  std::uint32_t tape_part(const std::string& revision) const {
    return tape_ && tape_->revision == revision ? tape_->part : 1;
  }
  /// Of whatever tape is in the reader.
  std::uint32_t next_part() const { return tape_ ? tape_->part : 1; }
  /// The reader is there from now on; 1: at the beginning of whatever tape comes.
  void set_tape(const std::string& revision, std::uint32_t part);
  /// Why nothing can begin; empty: it can.
  const std::string& fault() const { return memory_.fault(); }
  /// The machine has executed a block that changed a cell (`cell`: its index among those of
  /// `begin`).
  void note(std::size_t cell, double value);

  /// A cell of `begin` by its name; nothing: there is none.
  std::optional<std::size_t> place_of(const std::string& name) const;
  /// For a change, or the beginning of a program, that cannot be kept: it is taken back.
  struct Saved;
  std::shared_ptr<const Saved> save() const;
  void restore(const Saved& saved);

  /// Stages what the outbox does not have yet, to go to disk with its next commit.
  void stage();
  bool has_unstaged() const { return has_unstaged_; }
  /// Everything kept for good, as JSON of at most kMaxRecordText bytes each: {"part", "parts",
  /// "cells": {name: [number, what the setup gave]}}, null for a vacant one. `change`: JSON of what
  /// an operator has set, a part of its own; empty: a program's end.
  std::vector<std::string> report(const std::string& change = {}) const;
  /// SHA-256 of the same: two memories with one digest hold the same.
  std::string digest() const;
  /// What programs read and write, as executed blocks have left it: of the present program, or the
  /// last one of this process; before the first, what is kept alone.
  struct Value {
    std::string name;
    double value = 0;  ///< not finite: vacant
  };
  std::vector<Value> values() const;
  /// What the control shows of the present program, or of the last one, and does not keep: nothing
  /// of this goes to disk.
  void begin_live(std::vector<std::string> names, const std::vector<double>& values);
  /// One more name, vacant.
  void add_live(std::string name) { live_.push_back({std::move(name), interpreter::kVacant}); }
  void note_live(std::size_t place, double value) { live_.at(place).value = value; }
  /// Whether anything has changed since this was asked last.
  bool take_change() { return std::exchange(has_changed_, false); }

 private:
  struct Cell {
    report::KeptCell kept;
    interpreter::Keeps keeps = interpreter::Keeps::Always;
  };
  struct Tape {
    std::string revision;  ///< SHA-256
    std::uint32_t part = 1;
  };
  std::string tape_name() const;
  /// Whether the setup, as it is now, leaves the cell as it was kept.
  bool is_in_force(const std::string& name, const report::KeptCell& kept) const;

  report::KeptMemory& memory_;
  std::map<std::string, Cell> cells_;
  std::vector<interpreter::MemoryCell> known_;  ///< of the present program, or the last one
  std::unordered_map<std::string, std::size_t> places_;  ///< index by name
  std::vector<double> base_;
  std::map<std::string, bool> named_;  ///< variables of the program's setup
  std::vector<Value> live_;
  std::optional<Tape> tape_;  ///< none: wound back
  bool has_unstaged_ = false, has_changed_ = false;
};

struct ControlMemory::Saved {
  std::map<std::string, Cell> cells;
  std::vector<interpreter::MemoryCell> known;
  std::unordered_map<std::string, std::size_t> places;
  std::vector<double> base;
  std::map<std::string, bool> named;
  std::vector<Value> live;
  std::optional<Tape> tape;
  bool has_unstaged = false, has_changed = false;
};

}  // namespace dripline::gateway
