#include "protocol/dds/impl/cell.hpp"

#include <algorithm>
#include <utility>

#include "protocol/dds/impl/matched.hpp"

namespace dripline::dds {

bool ServerShared::claim(const std::string& machine, std::uint32_t cell,
                         const std::function<void()>& wake) {
  const std::lock_guard lock(mutex_);
  Place& place = places_.try_emplace(machine, Place{.cell = cell, .waiting = {}}).first->second;
  if (place.cell == cell) return true;
  place.waiting.insert_or_assign(cell, wake);
  return false;
}

void ServerShared::release(const std::string& machine, std::uint32_t cell) {
  const std::lock_guard lock(mutex_);
  const auto found = places_.find(machine);
  if (found == places_.end() || found->second.cell != cell) return;
  for (const auto& [other, wake] : found->second.waiting) wake();
  places_.erase(found);
}

void ServerShared::drop_waiting(std::uint32_t cell) {
  const std::lock_guard lock(mutex_);
  for (auto& [machine, place] : places_) place.waiting.erase(cell);
}

std::uint32_t ServerShared::cell_with(const std::string& machine) const {
  const std::lock_guard lock(mutex_);
  const auto found = places_.find(machine);
  return found != places_.end() ? found->second.cell : cell_of(machine, cells);
}

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
  shared_.drop_waiting(number_);
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
             post_announced({std::move(message), sample.heard, writer, {}});
           },
       .on_gone = [this](const std::string& machine) { post_gone(machine); },
       .on_matched = [this] { wake_watcher(); }});
  if (!announces) return fail(announces.error());
  announces_ = std::move(*announces);
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  return {};
}

/// Null: no room for another machine. `news_mutex_` is held.
Cell::MachineNews* Cell::news_of(const std::string& machine) {
  if (news_.size() >= kMaxMachines && !news_.contains(machine)) return nullptr;
  return &news_[machine];
}

void Cell::post_announced(Arrived arrived) {
  constexpr std::size_t kMaxWriters = 8;  // for one machine, between two looks of the watcher
  bool is_taken = false;
  {
    std::lock_guard lock(news_mutex_);
    MachineNews* news = news_of(arrived.announce.machine);
    is_taken = news != nullptr &&
               (news->announced.size() < kMaxWriters || news->announced.contains(arrived.writer));
    if (is_taken) news->announced.insert_or_assign(arrived.writer, std::move(arrived));
  }
  if (!is_taken) {
    return shared_.rejections.add(Topic<Announce>::kName, "too many machines announced at once");
  }
  news_came_.notify_one();
}

void Cell::post_gone(const std::string& machine) {
  {
    std::lock_guard lock(news_mutex_);
    if (MachineNews* news = news_of(machine))
      *news = {.is_gone = true, .is_silent = false, .announced = {}};
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
    for (auto& [machine, what] : news) {
      if (what.is_gone) handle_lost(machine);
      if (what.is_silent) handle_silent(machine);
      for (auto& [writer, arrived] : what.announced) handle_announced(machine, std::move(arrived));
    }
    for (const auto& [name, machine] : machines_) {  // the watcher reads its own writes
      look_at_rival(name, *machine);
      if (machine->waiting) try_ready(*machine);
      machine->resolve();
    }
  }
}

/// The machine is no longer announced. One that was never ready may be any stranger's invention:
/// its entities are released.
void Cell::handle_lost(const std::string& machine) {
  const auto attached = find(machine);
  if (attached == nullptr) return;
  set_rival(machine, *attached, std::nullopt);
  const bool was_ever_ready = attached->delivered.has_value();
  lose_gateway(machine, *attached);
  if (!was_ever_ready) drop(machine);
}

void Cell::lose_gateway(const std::string& machine, Attachment& attached) {
  attached.set_gateway({});
  shared_.release(machine, number_);
  lose(attached, machine);
}

bool Cell::may_serve(const Arrived& arrived) const {
  const auto& may = shared_.handlers.may_serve;
  return !may || may(arrived.announce);
}

void Cell::renew_status(const std::string& machine) {
  {
    const std::lock_guard lock(news_mutex_);
    if (MachineNews* news = news_of(machine)) news->is_silent = true;
  }
  news_came_.notify_one();
}

/// Each has one writer of announcements.
std::size_t Cell::heard_gateways() const {
  const dds_return_t count = dds_get_matched_publications(announces_->get(), nullptr, 0);
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

void Cell::handle_silent(const std::string& machine) {
  const auto attached = find(machine);
  if (attached == nullptr || !attached->is_ready) return;
  const auto renewed = attached->renew_status(topics_, machine, shared_.handlers,
                                              shared_.rejections, [this] { wake_watcher(); });
  if (!renewed) shared_.rejections.add(Topic<Status>::kName, renewed.error().what);
}

void Cell::lose(Attachment& attached, const std::string& machine) {
  attached.waiting.reset();
  if (std::exchange(attached.is_ready, false) && shared_.handlers.on_lost)
    shared_.handlers.on_lost(machine);
}

void Cell::drop(const std::string& machine) {
  std::shared_ptr<Attachment> dropped;  // destroyed without the lock
  std::unique_lock lock(machines_mutex_);
  const auto found = machines_.find(machine);
  if (found == machines_.end()) return;
  dropped = std::move(found->second);
  machines_.erase(found);
  --shared_.machines;
  lock.unlock();
}

/// The first Announce of a machine attaches it; when the gateway is matched with the new entities,
/// it announces itself again and names this server. Only from then on are no messages lost.
void Cell::handle_announced(const std::string& machine, Arrived arrived) {
  const auto source = publication(announces_->get(), arrived.writer);
  if (!source) return;  // already lost; its successor announces itself
  if (source->partitions != std::vector{partition_of(machine)}) {
    return shared_.rejections.add(Topic<Announce>::kName,
                                  "announced in another machine's partition");
  }
  arrived.participant = source->participant;
  if (speaks_for_another(arrived.participant, machine)) {
    return shared_.rejections.add(Topic<Announce>::kName, "one participant, several machines");
  }
  const auto attached = attach(machine, arrived.announce.has_line);
  if (attached == nullptr) return;
  look_at_rival(machine, *attached);
  if (attached->gateway.empty() && may_serve(arrived) && claim(machine))
    attached->set_gateway(arrived.participant);
  if (attached->gateway != arrived.participant) {
    return set_rival(machine, *attached, std::move(arrived));
  }
  handle_news_of_gateway(*attached, std::move(arrived));
}

void Cell::handle_news_of_gateway(Attachment& attached, Arrived arrived) {
  attached.announcer = arrived.writer;
  if (arrived.heard == domain_.key) {
    attached.waiting = std::move(arrived);
  } else {  // it is not, or no longer, matched with us
    lose(attached, arrived.announce.machine);
  }
}

/// A machine keeps its gateway until that is lost. Then the waiting one takes over, without the
/// machine being lost in between; or the machine is lost, if that one may not.
void Cell::look_at_rival(const std::string& machine, Attachment& attached) {
  if (!attached.rival) return;
  const bool is_there = publication(announces_->get(), attached.rival->writer).has_value();
  if (!is_there) return set_rival(machine, attached, std::nullopt);
  const bool has_gateway = !attached.gateway.empty();
  if (has_gateway && publication(announces_->get(), attached.announcer)) return;
  if (!may_serve(*attached.rival)) {
    if (has_gateway) lose_gateway(machine, attached);
    return;
  }
  if (!claim(machine)) return;  // its gateway is in another cell
  Arrived successor = std::move(*attached.rival);
  set_rival(machine, attached, std::nullopt);
  attached.set_gateway(successor.participant);
  handle_news_of_gateway(attached, std::move(successor));
}

void Cell::set_rival(const std::string& machine, Attachment& attached,
                     std::optional<Arrived> rival) {
  const bool was_there = attached.rival.has_value();
  attached.rival = std::move(rival);
  const bool is_there = attached.rival.has_value();
  if (was_there != is_there && shared_.handlers.on_rival)
    shared_.handlers.on_rival(machine, is_there);
}

/// Each gateway is one participant, so that a stranger who announces thousands of machines needs as
/// many participants.
bool Cell::speaks_for_another(const std::string& participant, const std::string& machine) const {
  return std::any_of(machines_.begin(), machines_.end(), [&](const auto& entry) {
    return entry.first != machine && entry.second->gateway == participant;
  });
}

/// Drops a lost machine to make room for a connected one.
bool Cell::has_room() {
  if (shared_.machines < kMaxMachines) return true;
  const auto lost = std::find_if(machines_.begin(), machines_.end(),
                                 [](const auto& entry) { return entry.second->gateway.empty(); });
  if (lost == machines_.end()) return false;
  drop(std::string(lost->first));
  return true;
}

bool Cell::claim(const std::string& machine) {
  return shared_.claim(machine, number_, [this] { wake_watcher(); });
}

/// A machine that has a line now and had none is attached again: its entities are all there, or
/// none are.
std::shared_ptr<Attachment> Cell::attach(const std::string& machine, bool has_line) {
  if (auto attached = find(machine)) {
    if (attached->has_line() || !has_line) return attached;
    handle_lost(machine);
    drop(machine);
  }
  if (!takes_machine(machine, number_, shared_.cells)) {
    shared_.rejections.add(Topic<Announce>::kName, "announced to another cell than the machine's");
    return nullptr;
  }
  if (!has_room()) {
    shared_.rejections.add(Topic<Announce>::kName, "too many machines");
    return nullptr;
  }
  auto created = Attachment::create(
      domain_, topics_, {.machine = machine, .has_line = has_line, .term = shared_.term},
      shared_.handlers, shared_.rejections, [this] { wake_watcher(); });
  if (!created) {
    shared_.rejections.add(Topic<Announce>::kName, created.error().what);
    return nullptr;
  }
  ++shared_.machines;
  std::unique_lock lock(machines_mutex_);
  return machines_.emplace(machine, std::move(*created)).first->second;
}

void Cell::try_ready(Attachment& machine) {
  if (!machine.is_matched_with(machine.waiting->participant)) return;  // further matches will come
  Announce announce = std::move(machine.waiting->announce);
  machine.waiting.reset();
  const bool was_ready = std::exchange(machine.is_ready, true);
  if (was_ready && machine.delivered == announce) return;
  machine.delivered = announce;
  if (shared_.handlers.on_announce) shared_.handlers.on_announce(std::move(announce));
}

}  // namespace dripline::dds
