#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace dripline::api {

/// The connections, and which of them is closed when the table is full. A connection without a
/// request in progress (Opening, Idle) makes room for a new one: one of the new one's address when
/// that address has its maximum, any when the server is full; Opening before Idle, the longest
/// silent first. So clients that only hold a connection never keep out clients that use one. When
/// none can make room, the new one gets a reserve seat: for a request of the health or one that may
/// stop a machine, of which a quarter of these seats is kept free. Pure; one thread.
class ConnectionTable {
 public:
  struct Limits {
    std::size_t connections = 0, per_address = 0, reserve = 0;
    std::size_t streams = 0, streams_per_address = 0;
  };
  using Id = std::uint64_t;
  enum class State {
    Opening,    ///< has sent no whole request yet, or nothing that a known user may send
    Idle,       ///< of a known user, between two requests
    Busy,       ///< a request is in progress
    Streaming,  ///< receives events
  };
  struct Admission {
    Id id = 0;
    bool is_reserve = false;    ///< only for health and stops
    std::optional<Id> evicted;  ///< to be closed; no longer counted
  };

  explicit ConnectionTable(Limits limits) : limits_(limits) {}

  Admission admit(const std::string& address);
  /// Has no effect on an evicted one.
  void set(Id id, State state);
  /// Makes it Busy; false when it was evicted, or has a reserve seat and too many of these are:
  /// with what is no stop half of them.
  bool begin_request(Id id, bool may_be_stop);
  /// Makes it Streaming; false when there are too many already.
  bool begin_stream(Id id);
  /// A silent connection to close when the process is out of descriptors.
  std::optional<Id> evict_any();
  void leave(Id id);

  std::size_t size() const { return entries_.size(); }
  const Limits& limits() const { return limits_; }

 private:
  struct Entry {
    std::string address;
    State state = State::Opening;
    bool is_reserve = false;
    std::uint64_t since = 0;  ///< when it entered its state; a counter
  };
  struct Counts {
    std::size_t seats = 0, streams = 0;
  };
  using Entries = std::map<Id, Entry>;

  template <class Condition>
  std::optional<Id> evict(Condition may_go);
  Counts& counts_of(const Entry& entry) { return addresses_[entry.address]; }
  void change(Entry& entry, State state);
  void erase(Entries::iterator entry);

  Limits limits_;
  Entries entries_;
  std::map<std::string, Counts> addresses_;  ///< without reserve seats
  std::size_t seats_ = 0, reserved_ = 0, busy_reserve_ = 0, streams_ = 0;
  std::uint64_t ticks_ = 0;
  Id last_id_ = 0;
};

/// Holds a place in the table for its lifetime. On the table's thread.
class Seat {
 public:
  Seat(ConnectionTable& table, ConnectionTable::Id id) : table_(&table), id_(id) {}
  Seat(Seat&& other) noexcept : table_(std::exchange(other.table_, nullptr)), id_(other.id_) {}
  Seat& operator=(Seat&&) = delete;
  ~Seat() {
    if (table_ != nullptr) table_->leave(id_);
  }
  void set(ConnectionTable::State state) { table_->set(id_, state); }
  bool begin_request(bool may_be_stop) { return table_->begin_request(id_, may_be_stop); }
  bool begin_stream() { return table_->begin_stream(id_); }
  ConnectionTable::Id id() const { return id_; }

 private:
  ConnectionTable* table_;
  ConnectionTable::Id id_;
};

}  // namespace dripline::api
