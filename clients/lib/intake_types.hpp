#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The part of api_types.hpp, which has the rules for all, about what comes to machines and what
/// goes to other systems: job queues, hot folders, webhooks.
namespace dripline::client {

/// A job of a machine's queue.
struct Job {
  std::uint64_t id = 0;
  std::string machine, program;
  std::optional<std::uint64_t> revision;  ///< absent: the latest that may run
  std::uint64_t quantity = 0, parts_per_run = 0, completed = 0, runs = 0;
  std::string counts = "made";  ///< or good: what is counted up to the quantity
  std::uint64_t good = 0, unknown = 0, rework = 0, scrap = 0;
  std::string state, comment, author, created;
};
struct JobList {
  struct Hold {
    std::string who, reason, since;
  };
  std::vector<Job> jobs;
  std::optional<Hold> hold;  ///< absent: the queue is not held
};

/// A receiver of events.
struct Webhook {
  std::string name, url;
  std::vector<std::string> kinds;  ///< of events; empty: all
  std::string author, created;
  std::uint64_t delivered = 0;  ///< number of the last event
  std::string delivered_at;
  std::uint64_t waiting = 0, lost = 0, failures = 0;
  std::string failing_since, fault;
  std::string secret;  ///< of one that was just added
};
struct WebhookTest {
  bool delivered = false;
  std::string fault;
};

/// A hot folder.
struct Folder {
  std::string name, path, machine, control, fault, looked;
  std::uint64_t waiting = 0, stored = 0, failed = 0;
  std::string last_refused, last_reason;
};
/// What became of one of its files.
struct FolderFile {
  std::string folder, name;
  std::uint64_t size = 0;
  std::string sha256, state, program;
  std::optional<std::uint64_t> revision;
  std::string reason, target, taken, moved;
};

}  // namespace dripline::client
