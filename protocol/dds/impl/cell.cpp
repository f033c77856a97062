#include "protocol/dds/impl/cell.hpp"

#include <utility>

#include "protocol/dds/impl/matched.hpp"

namespace dripline::dds {

Result<std::unique_ptr<Cell>> Cell::open(const NetworkOptions& options, std::uint32_t number,
                                         ServerShared& shared) {
  auto domain = open_domain(options, Role::Server, number);
  if (!domain) return fail(domain.error());
  auto topics = ServerTopics::create(*domain);
  if (!topics) return fail(topics.error());
  std::unique_ptr<Cell> cell(new Cell(std::move(*domain), std::move(*topics), number, shared));
  if (auto started = cell->start(); !started) return fail(started.error());
  return cell;
}

Cell::~Cell() {
  watcher_.request_stop();
  if (watcher_.joinable()) watcher_.join();
}

Result<void> Cell::start() {
  const Qos all = partition_qos(partition_of_all());
  auto subscriber =
      own(dds_create_subscriber(domain_.participant.get(), all.get(), nullptr), "subscriber");
  if (!subscriber) return fail(subscriber.error());
  subscriber_ = std::move(*subscriber);
  auto announces = Reader<Announce>::create(
      subscriber_, topics_.announce, "", shared_.rejections,
      {.on_message =
           [this](Announce message, const auto& sample, dds_instance_handle_t writer) {
             const std::string machine = message.machine;
             post(machine, Arrived{std::move(message), sample.heard, writer});
           },
       .on_gone = [this](std::string machine) { post(machine, std::nullopt); },
       .on_matched = {}});
  if (!announces) return fail(announces.error());
  announces_ = std::move(*announces);
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  return {};
}

void Cell::post(const std::string& machine, std::optional<Arrived> news) {
  {
    std::lock_guard lock(news_mutex_);
    if (news_.size() >= kMaxMachines && !news_.contains(machine)) {
      return shared_.rejections.add(Topic<Announce>::kName, "too many machines announced at once");
    }
    news_.insert_or_assign(machine, std::move(news));
  }
  news_came_.notify_one();
}

void Cell::wake_watcher() {
  {
    std::lock_guard lock(news_mutex_);
    matches_changed_ = true;
  }
  news_came_.notify_one();
}

void Cell::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    News news;
    {
      std::unique_lock lock(news_mutex_);
      if (!news_came_.wait(lock, stop, [this] { return !news_.empty() || matches_changed_; })) {
        return;
      }
      news.swap(news_);
      matches_changed_ = false;
    }
    for (auto& [machine, announced] : news) {
      if (announced) {
        handle_announced(machine, std::move(*announced));
      } else {
        handle_lost(machine);
      }
    }
    for (Attachment* machine : waiting_machines()) try_ready(*machine);
  }
}

void Cell::handle_lost(const std::string& machine) {
  Attachment* attached = find(machine);
  if (attached == nullptr) return;
  attached->waiting.reset();
  attached->delivered.reset();
  attached->gateway.clear();
  if (std::exchange(attached->is_ready, false) && shared_.handlers.on_lost)
    shared_.handlers.on_lost(machine);
}

/// The first Announce of a machine makes us attach it; when the gateway hears what was made, it
/// announces itself again, naming us. Only then nothing we write is lost on the way.
void Cell::handle_announced(const std::string& machine, Arrived arrived) {
  const auto source = publication(announces_->get(), arrived.writer);
  if (!source) return;  // gone already; its successor announces itself
  if (source->partitions != std::vector{partition_of(machine)}) {
    return shared_.rejections.add(Topic<Announce>::kName,
                                  "announced in another machine's partition");
  }
  Attachment* attached = attach(machine);
  if (attached == nullptr) return;
  if (arrived.heard != domain_.key) {
    // Ours does not hear us any more; or a successor of ours does not yet, and then nothing is said
    // of the predecessor before the successor is there.
    if (attached->gateway == source->participant) handle_lost(machine);
    return;
  }
  attached->waiting = Announced{std::move(arrived.announce), source->participant};
}

Attachment* Cell::attach(const std::string& machine) {
  if (Attachment* attached = find(machine)) return attached;
  if (cell_of(machine) != number_) {
    shared_.rejections.add(Topic<Announce>::kName, "announced to another cell than the machine's");
    return nullptr;
  }
  if (shared_.machines >= kMaxMachines) {
    shared_.rejections.add(Topic<Announce>::kName, "too many machines");
    return nullptr;
  }
  auto created = Attachment::create(domain_, topics_, machine, shared_.handlers, shared_.rejections,
                                    [this] { wake_watcher(); });
  if (!created) {
    shared_.rejections.add(Topic<Announce>::kName, created.error().what);
    return nullptr;
  }
  ++shared_.machines;
  std::unique_lock lock(machines_mutex_);
  return machines_.emplace(machine, std::move(*created)).first->second.get();
}

std::vector<Attachment*> Cell::waiting_machines() const {
  std::vector<Attachment*> result;
  for (const auto& [name, machine] : machines_) {  // the watcher reads its own writes
    if (machine->waiting) result.push_back(machine.get());
  }
  return result;
}

void Cell::try_ready(Attachment& machine) {
  if (!machine.is_matched_with(machine.waiting->participant)) return;  // the rest is to come
  Announce announce = std::move(machine.waiting->announce);
  machine.gateway = std::move(machine.waiting->participant);
  machine.waiting.reset();
  const bool was_ready = std::exchange(machine.is_ready, true);
  if (was_ready && machine.delivered == announce) return;
  machine.delivered = announce;
  if (shared_.handlers.on_announce) shared_.handlers.on_announce(std::move(announce));
}

}  // namespace dripline::dds
