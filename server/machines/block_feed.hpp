#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/dds/endpoint.hpp"
#include "server/machines/run_sources.hpp"
#include "server/machines/worker_pool.hpp"

namespace dripline::machines {

/// Answers the gateways' requests for program text. A lane per machine: its requests are served in
/// order, one turn of at most kTurnBytes at a time, so that 200 machines share the workers fairly
/// and none needs more memory than a turn. Asking is idempotent, so what exceeds a
/// limit is dropped: the gateway requests it again.
/// What is near (ProgramStore::near_content) is answered by workers of its own, which never wait
/// for the database; everything else by those that all share. So a database that is away, or does
/// not answer, keeps no machine waiting whose text is near.
class BlockFeed {
 public:
  static constexpr std::size_t kMaxWaiting = 64;  ///< requests of one machine
  static constexpr std::uint64_t kTurnBytes = 256 * 1024;
  /// So long a machine waits for a store that is away (Io), before it learns that it failed; the
  /// store is asked every kAwayPause.
  static constexpr std::chrono::seconds kPatience{45};
  static constexpr std::chrono::milliseconds kAwayPause{500};

  /// All must outlive the feed's last task, that is, the pools must be stopped first.
  struct Parts {
    RunSources sources;
    dds::ServerEndpoint& endpoint;
    WorkerPool& near;   ///< for what is near
    WorkerPool& store;  ///< for what asks the store
    /// A run has got a program that it called. Any thread, returns soon.
    std::function<void(const std::string& run, const Digest& content)> on_called = {};
  };
  explicit BlockFeed(Parts parts) : parts_(std::move(parts)) {}

  /// Any thread; returns at once. A request that is waiting already is not taken twice; a new
  /// session of the gateway replaces what the old one asked for.
  void request(dds::BlockRequest request);
  /// The run has ended: what it asks for from now on is refused.
  void drop(const std::string& machine, const std::string& run);

 private:
  struct Content {
    Digest digest;
    std::uint64_t size = 0;
    bool is_noted = true;  ///< it is on disk that the run got it
  };
  /// What the requests of a machine's current run refer to, by the program name in the request.
  struct Pinned {
    std::string run;
    std::map<std::string, Content> programs;
  };
  /// The store, as this machine's requests found it.
  struct Away {
    SteadyTime since, seen;
  };
  struct Lane {
    std::uint64_t session = 0;
    std::deque<dds::BlockRequest> waiting;
    std::optional<dds::BlockRequest> working;
    bool is_scheduled = false;
    std::optional<Away> away;
    Pinned pinned;
  };
  /// How a turn ended: the request is answered, or the rest of it comes later.
  struct Turn {
    std::optional<dds::BlockRequest> rest;
    std::chrono::milliseconds pause{0};
  };
  using Bytes = std::vector<std::byte>;

  void serve(const std::string& machine);
  void finish(const std::string& machine, Turn turn);
  /// nullopt: not without the store.
  std::optional<Turn> answer_near(const dds::BlockRequest& request);
  Turn answer(const dds::BlockRequest& request);
  Turn send_bytes(dds::BlockRequest request, const Content& content,
                  std::span<const std::byte> bytes);
  struct Refusal {
    dds::BlockStatus status;
    Error error;
  };
  Turn refuse(const dds::BlockRequest& request, const Refusal& refusal);
  /// What the store could not give: later again, or refused.
  Turn put_off(const dds::BlockRequest& request, const Refusal& refusal);
  bool is_patient(const std::string& machine, const Error& error);
  std::optional<Content> pinned(const dds::BlockRequest& request);
  tl::expected<Content, Refusal> content(const dds::BlockRequest& request);
  tl::expected<Content, Refusal> look_up(const dds::BlockRequest& request);

  const Parts parts_;
  std::mutex mutex_;
  std::map<std::string, Lane> lanes_;
};

}  // namespace dripline::machines
