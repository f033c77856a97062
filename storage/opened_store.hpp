#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "storage/store.hpp"

namespace dripline::storage {

/// What other servers of the store have to know of the one that has it.
struct ServerFacts {
  std::string url;          ///< where clients reach it; empty: nowhere yet
  std::string signing_key;  ///< public, hexadecimal
  std::string settings;     ///< what they are to have alike; whose text it is the server's matter
};

/// A server that waits to take over the store.
struct WaitingServer {
  std::string described;  ///< "dncd 812 on srv-2, /var/lib/dripline"
  UtcTime seen{};         ///< by the database's clock, which may be set: another with each look
  std::optional<std::uint64_t> gateways = {};  ///< that it hears; nullopt: not known
  bool operator==(const WaitingServer&) const = default;
};

/// Of the hand-overs that servers made because they heard no gateway any more.
struct OwnHandOvers {
  std::uint64_t count = 0;  ///< one soon after the other; 0: none that matters
  bool has_helped = true;   ///< a gateway was heard after the last of them
  bool operator==(const OwnHandOvers&) const = default;
};

/// A store with what its owner asks besides, whatever engine keeps it.
class OpenedStore : public Store {
 public:
  OpenedStore(const OpenedStore&) = delete;
  OpenedStore& operator=(const OpenedStore&) = delete;
  virtual ~OpenedStore() = default;

  /// Searches for damage of the database's structure (not of program content, which is checked
  /// whenever it is read), for at most `limit` or until `stop`. False: the time was not enough, and
  /// no damage was found so far. Reads and writes continue beside it. Errors: Corrupt.
  virtual Result<bool> check(std::chrono::milliseconds limit, const std::stop_token& stop) = 0;
  Result<bool> check() { return check(std::chrono::hours(24), {}); }
  Result<bool> check(std::chrono::milliseconds limit) { return check(limit, {}); }

  /// Writes something small onto the disk, and reads it. Errors: Io (a full disk), Corrupt, Busy.
  virtual Result<void> probe() = 0;

  /// A copy in a SQLite file, as everything is now, while everything works. False: `proceed(done,
  /// total)`, in bytes, ended it. Errors: also Unsupported (the engine has backups of its own).
  virtual Result<bool> copy_to(
      const std::filesystem::path& file,
      const std::function<bool(std::uint64_t, std::uint64_t)>& proceed) = 0;

  /// Now, by the clock of the computer that keeps the store; nullopt: this one does. Errors: Io.
  virtual Result<std::optional<UtcTime>> time() { return std::optional<UtcTime>{}; }

  /// Made together with the database and never changed: 32 hexadecimal digits.
  virtual Result<std::string> identity() = 0;

  /// Of a store that several servers know: the number of this server's taking of it, above that of
  /// every one before, in any of them. 0: no other server can have it.
  virtual std::uint64_t term() const { return 0; }
  /// False: another server may have it by now, because this one's place was not renewed in time.
  /// It asks the own clock alone, so that it answers at once.
  virtual bool has_place() const { return true; }
  /// The server ends: its place is not renewed any more, so that no part of it that does not come
  /// to its end keeps another server from it. What is still written may renew it. Any thread.
  virtual void stop_renewing() {}
  /// After that: another server may have the place at once, and this one stores and reads nothing
  /// any more. It waits for the database for some seconds at most. Otherwise the destructor does
  /// it.
  virtual void give_back() {}
  /// For servers that wait, and for their clients. Errors: Io.
  virtual Result<void> publish(const ServerFacts&) { return {}; }
  /// Those that have asked for the place in the last seconds. Errors: Io.
  virtual Result<std::vector<WaitingServer>> waiting() { return std::vector<WaitingServer>{}; }
  /// Kept for all servers of the store. Errors: Io.
  virtual Result<OwnHandOvers> own_hand_overs() { return OwnHandOvers{}; }
  virtual Result<void> note_own_hand_overs(const OwnHandOvers&) { return {}; }

 protected:
  explicit OpenedStore(const Store& store) : Store(store) {}
};

}  // namespace dripline::storage
