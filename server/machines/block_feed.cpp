#include "server/machines/block_feed.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"
#include "server/machines/control_memory.hpp"

namespace dripline::machines {
namespace {

using namespace std::chrono_literals;

/// A run calls at most so many different programs between two look-ups in the library.
constexpr std::size_t kMaxPinned = 256;
constexpr auto kPause = 5ms;  ///< before a machine whose queue is full is tried again

bool is_same(const dds::BlockRequest& a, const dds::BlockRequest& b) {
  return a.run == b.run && a.program == b.program && a.offset == b.offset && a.length == b.length;
}

dds::BlockStatus status_of(const Error& error) {
  return error.code == Errc::Corrupt ? dds::BlockStatus::Corrupt : dds::BlockStatus::Failed;
}

dds::BlockData answer_to(const dds::BlockRequest& request) {
  dds::BlockData data;
  data.machine = request.machine;
  data.session = request.session;
  data.run = request.run;
  data.program = request.program;
  data.offset = request.offset;
  return data;
}

/// Of one turn.
std::uint64_t wanted(const dds::BlockRequest& request, std::uint64_t size) {
  return std::min<std::uint64_t>({request.length, size - request.offset, BlockFeed::kTurnBytes});
}

}  // namespace

void BlockFeed::request(dds::BlockRequest request) {
  const std::string machine = request.machine;
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    if (lane.session != request.session) {
      lane.session = request.session;
      lane.waiting.clear();
    }
    const auto asks_same = [&](const auto& other) { return is_same(other, request); };
    if (lane.working && lane.working->session == request.session && asks_same(*lane.working))
      return;
    if (std::ranges::any_of(lane.waiting, asks_same)) return;
    if (lane.waiting.size() >= kMaxWaiting) return;
    lane.waiting.push_back(std::move(request));
    if (std::exchange(lane.is_scheduled, true)) return;
  }
  parts_.near.post([this, machine] { serve(machine); });
}

void BlockFeed::drop(const std::string& machine, const std::string& run) {
  const std::lock_guard lock(mutex_);
  const auto lane = lanes_.find(machine);
  if (lane != lanes_.end() && lane->second.pinned.run == run) lane->second.pinned = {};
}

void BlockFeed::serve(const std::string& machine) {
  dds::BlockRequest request;
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    if (lane.waiting.empty()) {
      lane.is_scheduled = false;
      return;
    }
    request = std::move(lane.waiting.front());
    lane.waiting.pop_front();
    lane.working = request;
  }
  if (auto turn = answer_near(request)) return finish(machine, *std::move(turn));
  parts_.store.post([this, machine, request] { finish(machine, answer(request)); });
}

void BlockFeed::finish(const std::string& machine, Turn turn) {
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[machine];
    lane.working.reset();
    if (turn.rest && turn.rest->session == lane.session) {
      lane.waiting.push_front(*std::move(turn.rest));
    }
    if (lane.waiting.empty()) {
      lane.is_scheduled = false;
      return;
    }
  }
  const auto again = [this, machine] { serve(machine); };
  if (turn.pause.count() > 0) {
    parts_.near.post_after(turn.pause, again);
  } else {
    parts_.near.post(again);
  }
}

std::optional<BlockFeed::Turn> BlockFeed::answer_near(const dds::BlockRequest& request) {
  const auto content = pinned(request);
  if (!content || !content->is_noted || request.offset > content->size) return std::nullopt;
  const auto bytes = parts_.sources.store.programs.near_content(content->digest, request.offset,
                                                                wanted(request, content->size));
  if (!bytes) return std::nullopt;
  return send_bytes(request, *content, *bytes);
}

BlockFeed::Turn BlockFeed::answer(const dds::BlockRequest& request) {
  const auto content = this->content(request);
  if (!content) return put_off(request, content.error());
  if (request.offset > content->size) {
    return refuse(request, {dds::BlockStatus::OutOfRange,
                            {Errc::LimitExceeded, fmt::format("offset {} is after the end at {}",
                                                              request.offset, content->size)}});
  }
  const auto bytes = parts_.sources.store.programs.read_content(content->digest, request.offset,
                                                                wanted(request, content->size));
  if (!bytes) return put_off(request, {status_of(bytes.error()), bytes.error()});
  {
    const std::lock_guard lock(mutex_);
    lanes_[request.machine].away.reset();
  }
  return send_bytes(request, *content, *bytes);
}

BlockFeed::Turn BlockFeed::put_off(const dds::BlockRequest& request, const Refusal& refusal) {
  if (refusal.error.code == Errc::Busy) return {.rest = request, .pause = kPause};
  if (is_patient(request.machine, refusal.error)) return {.rest = request, .pause = kAwayPause};
  return refuse(request, refusal);
}

bool BlockFeed::is_patient(const std::string& machine, const Error& error) {
  if (error.code != Errc::Io && error.code != Errc::Timeout) return false;
  const SteadyTime now = parts_.sources.clock.steady_now();
  const std::lock_guard lock(mutex_);
  auto& away = lanes_[machine].away;
  if (!away || now - away->seen > kPatience) {  // what was seen long ago was another time
    away = {.since = now, .seen = now};
    process::log_warning("text waits for the store machine={}: {}", machine, error.what);
  }
  away->seen = now;
  return now - away->since < kPatience;
}

/// One turn: whole pieces of at most kMaxBlockBytes until the request, the turn or the machine's
/// queue is at its end.
BlockFeed::Turn BlockFeed::send_bytes(dds::BlockRequest request, const Content& content,
                                      std::span<const std::byte> bytes) {
  if (bytes.empty() && wanted(request, content.size) > 0) {
    return refuse(request, {dds::BlockStatus::Corrupt,
                            {Errc::Corrupt, fmt::format("content {} has no bytes at {}",
                                                        content.digest.hex(), request.offset)}});
  }
  do {
    const auto piece = bytes.first(std::min(bytes.size(), dds::kMaxBlockBytes));
    dds::BlockData data = answer_to(request);
    data.total_bytes = content.size;
    if (!request.program.empty()) data.content = content.digest.hex();
    data.bytes.assign(piece.begin(), piece.end());
    data.ends = request.offset + piece.size() == content.size;
    if (auto written = parts_.endpoint.write(data); !written) {
      if (written.error().code == Errc::Timeout)
        return {.rest = std::move(request), .pause = kPause};
      return {};  // the machine is disconnected; it requests them again
    }
    request.offset += piece.size();
    request.length -= static_cast<std::uint32_t>(piece.size());
    bytes = bytes.subspan(piece.size());
  } while (!bytes.empty());
  if (request.length == 0 || request.offset == content.size) return {};
  return {.rest = std::move(request)};
}

BlockFeed::Turn BlockFeed::refuse(const dds::BlockRequest& request, const Refusal& refusal) {
  process::log_warning("refused blocks machine={} run={} program={} offset={}: {}: {}",
                       request.machine, request.run, request.program, request.offset,
                       dds::to_string(refusal.status), refusal.error.what);
  dds::BlockData data = answer_to(request);
  data.status = refusal.status;
  constexpr std::size_t kMaxReason = 256;
  data.reason = refusal.error.what.substr(0, kMaxReason);
  const auto written = parts_.endpoint.write(data);
  const bool is_full = !written && written.error().code == Errc::Timeout;
  if (is_full) return {.rest = request, .pause = kPause};
  return {};
}

std::optional<BlockFeed::Content> BlockFeed::pinned(const dds::BlockRequest& request) {
  const std::lock_guard lock(mutex_);
  const Pinned& pinned = lanes_[request.machine].pinned;
  if (pinned.run != request.run) return std::nullopt;
  const auto found = pinned.programs.find(request.program);
  if (found == pinned.programs.end()) return std::nullopt;
  return found->second;
}

tl::expected<BlockFeed::Content, BlockFeed::Refusal> BlockFeed::content(
    const dds::BlockRequest& request) {
  if (auto known = pinned(request)) return *std::move(known);
  auto content = look_up(request);
  if (!content || !content->is_noted) return content;
  const std::lock_guard lock(mutex_);
  Pinned& pinned = lanes_[request.machine].pinned;
  if (pinned.run != request.run || pinned.programs.size() >= kMaxPinned) {
    pinned = {.run = request.run, .programs = {}};
  }
  pinned.programs[request.program] = *content;
  return content;
}

tl::expected<BlockFeed::Content, BlockFeed::Refusal> BlockFeed::look_up(
    const dds::BlockRequest& request) {
  const auto refuse_with = [](dds::BlockStatus status, Error error) {
    return tl::unexpected<Refusal>(Refusal{status, std::move(error)});
  };
  const auto no_run = [&](std::string why) {
    return refuse_with(dds::BlockStatus::NoSuchRun, {Errc::NotFound, std::move(why)});
  };
  const auto run = parts_.sources.store.runs.find(request.run);
  if (!run && run.error().code == Errc::NotFound) return no_run(run.error().what);
  if (!run) return refuse_with(status_of(run.error()), run.error());
  if (run->machine != request.machine) {
    return no_run(fmt::format("run {} is of machine {}", run->id, run->machine));
  }
  if (storage::is_finished(run->state)) {
    return no_run(fmt::format("run {} has ended: {}", run->id, storage::to_string(run->state)));
  }
  if (request.program.empty() || request.program == run->program) {
    return Content{.digest = run->content, .size = run->size};
  }
  const auto revision = resolve_called_program(parts_.sources, *run, request.program);
  if (!revision) {
    const bool is_missing = revision.error().code == Errc::NotFound;
    const auto status = is_missing ? dds::BlockStatus::NoSuchProgram : status_of(revision.error());
    return refuse_with(status, revision.error());
  }
  // Before its first byte goes out, so that the run's attestation names all that it called. A disk
  // that is full stops no machine: the next request tries again.
  const auto noted = parts_.sources.store.runs.add_call(
      run->id, {request.program, revision->program, revision->number, revision->content});
  if (!noted && noted.error().code != Errc::Io)
    return refuse_with(status_of(noted.error()), noted.error());
  if (!noted) {
    process::log_error("called program not noted machine={} run={} program={}: {}", request.machine,
                       run->id, revision->program, noted.error().what);
  }
  process::log_info("pinned called program machine={} run={} program={} revision={}",
                    request.machine, run->id, revision->program, revision->number);
  if (parts_.on_called) parts_.on_called(run->id, revision->content);
  return Content{
      .digest = revision->content, .size = revision->size, .is_noted = noted.has_value()};
}

}  // namespace dripline::machines
