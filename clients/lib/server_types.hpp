#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The part of api_types.hpp, which has the rules for all, about the server itself: its state,
/// backups, the audit trail.
namespace dripline::client {

struct ServerInfo {
  std::string name, version, started;
  double uptime_s = 0;
  std::string data_dir;
  std::uint64_t machines = 0, machines_connected = 0, programs = 0, runs_active = 0;
  struct Health {
    struct Reason {
      std::string subject, status, message, detail;
    };
    std::string status;  ///< ok, degraded, failed; empty: from an older server
    std::vector<Reason> reasons;
  } health;
  struct Dds {
    std::uint64_t domain = 0, rejected = 0;
  } dds;
  struct Mqtt {
    std::string broker;
    bool connected = false;
    std::string since, fault;
    std::uint64_t records_waiting = 0, records_published = 0, states_published = 0;
    std::uint64_t records_missing = 0;
    struct Sparkplug {
      std::string node;
      bool connected = false;
      std::string since, fault;
      std::uint64_t messages_published = 0, rebirths = 0;
    };
    std::optional<Sparkplug> sparkplug;  ///< absent: it is not spoken
  };
  std::optional<Mqtt> mqtt;  ///< absent: there is no broker
  struct ProgramCache {
    std::uint64_t size_bytes = 0, used_bytes = 0;
    std::uint64_t hits = 0, misses = 0, fetched = 0, damaged = 0;
    std::string fault;
  };
  std::optional<ProgramCache> program_cache;  ///< absent: none on the server's own disk
  struct Sharing {
    std::uint64_t term = 0;
    std::vector<std::string> standbys;  ///< servers that wait to take the library over
  };
  std::optional<Sharing> sharing;  ///< absent: the library is this server's alone
};

/// The server's backups, newest first, and what it does with them now.
struct Backups {
  struct Backup {
    std::string id, made, made_by;
    std::uint64_t size = 0, added = 0;  ///< bytes; `added`: those that no earlier backup had
    std::string verified;               ///< when its bytes were last found good
  };
  struct Work {
    std::string kind, backup, phase;
    std::uint64_t done = 0, total = 0;
  };
  struct Outcome {
    std::string kind, backup, time, error;
  };
  std::string folder;
  std::uint64_t every_hours = 0;
  bool overdue = false;
  std::vector<Backup> backups;
  std::vector<std::string> damaged;
  std::optional<Work> work;
  std::optional<Outcome> last;
};

/// Whether the audit trail is as it was written.
struct AuditState {
  struct Fault {
    std::uint64_t entry = 0;
    std::string what;
  };
  struct Verification {
    std::string time;
    std::uint64_t entries = 0;
    bool intact = false;
    std::optional<Fault> fault;  ///< the first
  };
  struct Checkpoint {
    std::uint64_t number = 0, entry = 0;
    std::string time, sha256;
    std::string text;  ///< a file to be kept elsewhere
  };
  struct ArchiveFault {
    std::string file, what;
  };
  struct Archives {
    std::string time;
    std::uint64_t archives = 0;
    bool intact = false;
    std::vector<ArchiveFault> faults;
  };
  std::optional<Verification> verification;
  std::optional<Checkpoint> checkpoint;
  std::optional<Archives> archives;  ///< absent: the server has no folder of them
  std::string public_key;
};

}  // namespace dripline::client
