#include <condition_variable>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <utility>

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/attachment.hpp"
#include "protocol/dds/impl/matched.hpp"

namespace dripline::dds {
namespace {

/// Threads: DDS threads deliver status, records, results and requests. `watcher_` does what must
/// not be done in a listener: it attaches machines, looks who is matched, and calls on_announce and
/// on_lost. Nothing holds a mutex while it calls into DDS or a handler.
class Server final : public ServerEndpoint {
 public:
  Server(Domain domain, ServerTopics topics, ServerHandlers handlers)
      : domain_(std::move(domain)), topics_(std::move(topics)), handlers_(std::move(handlers)) {}
  ~Server() override {
    watcher_.request_stop();
    if (watcher_.joinable()) watcher_.join();
  }

  Result<void> start();

  Result<void> write(const RecordAck& message) override {
    return write_to(message, &Attachment::ack);
  }
  Result<void> write(const Order& message) override {
    return write_to(message, &Attachment::order);
  }
  Result<void> write(const BlockData& message) override {
    return write_to(message, &Attachment::block);
  }
  Rejected rejected() const override { return rejections_.get(); }

 private:
  /// An Announce as it arrived.
  struct Arrived {
    Announce announce;
    std::string heard;                 ///< the server its gateway is matched with
    dds_instance_handle_t writer = 0;  ///< where it came from
  };
  /// News of machines, the latest each: an Announce, or none when the machine is gone.
  using News = std::map<std::string, std::optional<Arrived>>;

  template <class Message>
  Result<void> write_to(const Message& message, std::unique_ptr<Writer<Message>> Attachment::*way) {
    // Not only after on_announce: a record that overtook it may be acknowledged.
    Attachment* machine = find(message.machine);
    if (machine == nullptr || !(machine->*way)->has_readers()) {
      return fail(Errc::NotFound, "machine {} is not connected", message.machine);
    }
    return (machine->*way)->write(message);
  }
  Attachment* find(const std::string& machine) const {
    std::shared_lock lock(machines_mutex_);
    const auto found = machines_.find(machine);
    return found != machines_.end() ? found->second.get() : nullptr;
  }

  void post(const std::string& machine, std::optional<Arrived> news);
  void wake_watcher();
  void watch(const std::stop_token& stop);
  void handle_lost(const std::string& machine);
  void handle_announced(const std::string& machine, Arrived arrived);
  Attachment* attach(const std::string& machine);
  void try_ready(Attachment& machine);
  std::vector<Attachment*> waiting_machines() const;

  // Order matters: the listeners of readers and writers use what is above them.
  Domain domain_;
  ServerTopics topics_;
  ServerHandlers handlers_;
  Rejections rejections_;

  std::mutex news_mutex_;
  std::condition_variable_any news_came_;
  News news_;
  bool matches_changed_ = false;

  Entity subscriber_;
  mutable std::shared_mutex machines_mutex_;
  std::map<std::string, std::unique_ptr<Attachment>> machines_;  // only the watcher adds
  std::unique_ptr<Reader<Announce>> announces_;
  std::jthread watcher_;
};

Result<void> Server::start() {
  const Qos all = partition_qos(partition_of_all());
  auto subscriber =
      own(dds_create_subscriber(domain_.participant.get(), all.get(), nullptr), "subscriber");
  if (!subscriber) return fail(subscriber.error());
  subscriber_ = std::move(*subscriber);
  auto announces = Reader<Announce>::create(
      subscriber_, topics_.announce, "", rejections_,
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

void Server::post(const std::string& machine, std::optional<Arrived> news) {
  {
    std::lock_guard lock(news_mutex_);
    if (news_.size() >= kMaxMachines && !news_.contains(machine)) {
      return rejections_.add(Topic<Announce>::kName, "too many machines announced at once");
    }
    news_.insert_or_assign(machine, std::move(news));
  }
  news_came_.notify_one();
}

void Server::wake_watcher() {
  {
    std::lock_guard lock(news_mutex_);
    matches_changed_ = true;
  }
  news_came_.notify_one();
}

void Server::watch(const std::stop_token& stop) {
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

void Server::handle_lost(const std::string& machine) {
  Attachment* attached = find(machine);
  if (attached == nullptr) return;
  attached->waiting.reset();
  attached->delivered.reset();
  attached->gateway.clear();
  if (std::exchange(attached->is_ready, false) && handlers_.on_lost) handlers_.on_lost(machine);
}

/// The first Announce of a machine makes us attach it; when the gateway hears what was made, it
/// announces itself again, naming us. Only then nothing we write is lost on the way.
void Server::handle_announced(const std::string& machine, Arrived arrived) {
  const auto source = publication(announces_->get(), arrived.writer);
  if (!source) return;  // gone already; its successor announces itself
  if (source->partitions != std::vector{partition_of(machine)}) {
    return rejections_.add(Topic<Announce>::kName, "announced in another machine's partition");
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

Attachment* Server::attach(const std::string& machine) {
  if (Attachment* attached = find(machine)) return attached;
  if (machines_.size() >= kMaxMachines) {
    rejections_.add(Topic<Announce>::kName, "too many machines");
    return nullptr;
  }
  auto created = Attachment::create(domain_, topics_, machine, handlers_, rejections_,
                                    [this] { wake_watcher(); });
  if (!created) {
    rejections_.add(Topic<Announce>::kName, created.error().what);
    return nullptr;
  }
  std::unique_lock lock(machines_mutex_);
  return machines_.emplace(machine, std::move(*created)).first->second.get();
}

std::vector<Attachment*> Server::waiting_machines() const {
  std::vector<Attachment*> result;
  for (const auto& [name, machine] : machines_) {  // the watcher reads its own writes
    if (machine->waiting) result.push_back(machine.get());
  }
  return result;
}

void Server::try_ready(Attachment& machine) {
  if (!machine.is_matched_with(machine.waiting->participant)) return;  // the rest is to come
  Announce announce = std::move(machine.waiting->announce);
  machine.gateway = std::move(machine.waiting->participant);
  machine.waiting.reset();
  const bool was_ready = std::exchange(machine.is_ready, true);
  if (was_ready && machine.delivered == announce) return;
  machine.delivered = announce;
  if (handlers_.on_announce) handlers_.on_announce(std::move(announce));
}

}  // namespace

Result<std::unique_ptr<ServerEndpoint>> ServerEndpoint::open(const NetworkOptions& options,
                                                             ServerHandlers handlers) {
  auto domain = open_domain(options, Role::Server);
  if (!domain) return fail(domain.error());
  auto topics = ServerTopics::create(*domain);
  if (!topics) return fail(topics.error());
  auto server =
      std::make_unique<Server>(std::move(*domain), std::move(*topics), std::move(handlers));
  if (auto started = server->start(); !started) return fail(started.error());
  return server;
}

}  // namespace dripline::dds
