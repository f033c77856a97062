#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/dds/endpoint.hpp"
#include "server/machines/run_sources.hpp"
#include "server/machines/worker_pool.hpp"

namespace dripline::machines {

/// Answers the gateways' requests for program text. A lane per machine: its requests are served in
/// order, one turn of at most kTurnBytes at a time, so that 200 machines share the workers fairly
/// and none needs more memory than a turn. Asking is idempotent, so what exceeds a
/// limit is dropped: the gateway requests it again.
class BlockFeed {
 public:
  static constexpr std::size_t kMaxWaiting = 64;  ///< requests of one machine
  static constexpr std::uint64_t kTurnBytes = 256 * 1024;

  /// All must outlive the feed's last task, that is, the pool must be stopped first.
  BlockFeed(const RunSources& sources, dds::ServerEndpoint& endpoint, WorkerPool& pool)
      : sources_(sources), endpoint_(endpoint), pool_(pool) {}

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
  struct Lane {
    std::uint64_t session = 0;
    std::deque<dds::BlockRequest> waiting;
    std::optional<dds::BlockRequest> working;
    bool is_scheduled = false;
    Pinned pinned;
  };
  /// How a turn ended: the request is answered, or the rest of it comes later.
  struct Turn {
    std::optional<dds::BlockRequest> rest;
    bool must_pause = false;
  };

  void serve(const std::string& machine);
  void finish(const std::string& machine, Turn turn);
  Turn answer(const dds::BlockRequest& request);
  Turn send_bytes(dds::BlockRequest request, const Content& content);
  struct Refusal {
    dds::BlockStatus status;
    Error error;
  };
  Turn refuse(const dds::BlockRequest& request, const Refusal& refusal);
  tl::expected<Content, Refusal> content(const dds::BlockRequest& request);
  tl::expected<Content, Refusal> look_up(const dds::BlockRequest& request);

  const RunSources sources_;
  dds::ServerEndpoint& endpoint_;
  WorkerPool& pool_;
  std::mutex mutex_;
  std::map<std::string, Lane> lanes_;
};

}  // namespace dripline::machines
