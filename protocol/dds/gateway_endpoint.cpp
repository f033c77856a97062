#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <iterator>
#include <mutex>
#include <thread>

#include "protocol/base/names.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/domain.hpp"
#include "protocol/dds/impl/matched.hpp"
#include "protocol/dds/impl/peer_reader.hpp"
#include "protocol/dds/impl/writer.hpp"

namespace dripline::dds {
namespace {

/// Threads: DDS threads deliver commands, acks and blocks; `watcher_` checks the matched
/// participants whenever they change (a listener must not access DDS tables) and repeats the
/// Announce.
class Gateway final : public GatewayEndpoint {
 public:
  Gateway(Domain domain, std::string machine, GatewayHandlers handlers)
      : domain_(std::move(domain)), machine_(std::move(machine)), handlers_(std::move(handlers)) {}
  ~Gateway() override {
    watcher_.request_stop();
    if (watcher_.joinable()) watcher_.join();
  }

  Result<void> start();

  Result<void> write(const Announce& message) override {
    std::lock_guard lock(announce_mutex_);
    if (auto checked = own_machine(message); !checked) return checked;
    announce_ = message;
    return write_announce();
  }
  Result<void> write(const Status& message) override { return write_own(*status_, message); }
  Result<void> write(const Record& message) override { return write_own(*record_, message); }
  Result<void> write(const CommandResult& message) override { return write_own(*result_, message); }
  Result<void> write(const BlockRequest& message) override { return write_own(*request_, message); }
  Result<void> write(const LineData& message) override {
    if (!line_data_) return fail(Errc::Unsupported, "machine {} has no line of its own", machine_);
    return write_own(*line_data_, message);
  }
  bool is_connected() const override { return is_connected_; }
  Rejected rejected() const override { return rejections_.get(); }

 private:
  template <class Message>
  Result<void> own_machine(const Message& message) const {
    if (message.machine == machine_) return {};
    return fail(Errc::Syntax, "message of machine {} at the gateway of {}", message.machine,
                machine_);
  }
  template <class Message>
  Result<void> write_own(Writer<Message>& writer, const Message& message) {
    if (auto checked = own_machine(message); !checked) return checked;
    return writer.write(message);
  }
  template <class Message>
  Result<void> open_writer(const Entity& publisher, std::unique_ptr<Writer<Message>>& writer);
  template <class Message>
  Result<void> open_reader(const Entity& subscriber, std::unique_ptr<PeerReader<Message>>& reader,
                           std::function<void(Message)>& handler);
  void believe(const std::string& server);
  template <class Message>
  void deliver(Message message, const std::function<void(Message)>& handler);
  std::string choose(const std::set<std::string>& servers);

  void wake_watcher();
  void watch(const std::stop_token& stop);
  void look_at_servers();
  std::set<std::string> complete_servers() const;
  Result<void> write_announce();

  // Order matters: the listeners of readers and writers use the members above them.
  Domain domain_;
  std::string machine_;
  GatewayHandlers handlers_;
  Rejections rejections_;
  std::atomic<bool> is_connected_ = false;

  std::mutex watch_mutex_;
  std::condition_variable_any watch_wanted_;
  bool matches_changed_ = false;

  std::mutex announce_mutex_;
  std::optional<Announce> announce_;
  std::string heard_;                  // written by the watcher under announce_mutex_
  std::vector<std::string> complete_;  // this and the next are the watcher's; newest last
  bool announce_due_ = false;
  std::atomic<std::uint64_t> seen_ = 0;  ///< the highest term of a server that was this gateway's
  std::set<std::string> stale_;          ///< the watcher's: reported already

  Entity publisher_, subscriber_;
  std::vector<Entity> topics_;
  std::unique_ptr<Writer<Announce>> announcer_;
  std::unique_ptr<Writer<Status>> status_;
  std::unique_ptr<Writer<Record>> record_;
  std::unique_ptr<Writer<CommandResult>> result_;
  std::unique_ptr<Writer<BlockRequest>> request_;
  std::unique_ptr<PeerReader<Command>> command_;
  std::unique_ptr<PeerReader<RecordAck>> ack_;
  std::unique_ptr<PeerReader<BlockData>> block_;
  std::unique_ptr<Writer<LineData>> line_data_;  ///< null: no line of its own, as the next one
  std::unique_ptr<PeerReader<LineRequest>> line_request_;
  std::jthread watcher_;
};

template <class Message>
Result<void> Gateway::open_writer(const Entity& publisher,
                                  std::unique_ptr<Writer<Message>>& writer) {
  auto topic = create_topic<Message>(domain_);
  if (!topic) return fail(topic.error());
  auto created = Writer<Message>::create(publisher, *topic, [this] { wake_watcher(); });
  if (!created) return fail(created.error());
  topics_.push_back(std::move(*topic));
  writer = std::move(*created);
  return {};
}

template <class Message>
Result<void> Gateway::open_reader(const Entity& subscriber,
                                  std::unique_ptr<PeerReader<Message>>& reader,
                                  std::function<void(Message)>& handler) {
  auto topic = create_topic<Message>(domain_);
  if (!topic) return fail(topic.error());
  auto created = PeerReader<Message>::create(
      subscriber, *topic, rejections_,
      {.machine = machine_,
       .on_message = [this, &handler](Message message) { deliver(std::move(message), handler); },
       .wake = [this] { wake_watcher(); }});
  if (!created) return fail(created.error());
  topics_.push_back(std::move(*topic));
  reader = std::move(*created);
  return {};
}

Result<void> Gateway::start() {
  const Qos partition = partition_qos(partition_of(machine_));
  auto publisher =
      own(dds_create_publisher(domain_.participant.get(), partition.get(), nullptr), "publisher");
  if (!publisher) return fail(publisher.error());
  publisher_ = std::move(*publisher);
  auto subscriber =
      own(dds_create_subscriber(domain_.participant.get(), partition.get(), nullptr), "subscriber");
  if (!subscriber) return fail(subscriber.error());
  subscriber_ = std::move(*subscriber);

  if (auto r = open_reader(subscriber_, command_, handlers_.on_command); !r) return r;
  if (auto r = open_reader(subscriber_, ack_, handlers_.on_ack); !r) return r;
  if (auto r = open_reader(subscriber_, block_, handlers_.on_block); !r) return r;
  if (auto r = open_writer(publisher_, announcer_); !r) return r;
  if (auto r = open_writer(publisher_, status_); !r) return r;
  if (auto r = open_writer(publisher_, record_); !r) return r;
  if (auto r = open_writer(publisher_, result_); !r) return r;
  if (auto r = open_writer(publisher_, request_); !r) return r;
  if (handlers_.on_line_request) {
    if (auto r = open_reader(subscriber_, line_request_, handlers_.on_line_request); !r) return r;
    if (auto r = open_writer(publisher_, line_data_); !r) return r;
  }
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  return {};
}

void Gateway::wake_watcher() {
  {
    std::lock_guard lock(watch_mutex_);
    matches_changed_ = true;
  }
  watch_wanted_.notify_one();
}

void Gateway::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(watch_mutex_);
      if (!watch_wanted_.wait(lock, stop, [this] { return matches_changed_; })) return;
      matches_changed_ = false;
    }
    look_at_servers();
    command_->resolve();
    ack_->resolve();
    block_->resolve();
    if (line_request_) line_request_->resolve();
  }
}

template <class Message>
void Gateway::deliver(Message message, const std::function<void(Message)>& handler) {
  if (const std::uint64_t seen = seen_; message.term < seen) {
    return rejections_.add(
        Topic<Message>::kName,
        fmt::format("from a server of term {}, after one of {}", message.term, seen));
  }
  if (handler) handler(std::move(message));
}

/// Commands, acknowledgments and text of any other participant are rejected.
void Gateway::believe(const std::string& server) {
  command_->set_peer(server);
  ack_->set_peer(server);
  block_->set_peer(server);
  if (line_request_) line_request_->set_peer(server);
}

/// A server is complete when all of its writers and readers for this machine are matched here: only
/// then no message of either side is lost.
std::set<std::string> Gateway::complete_servers() const {
  std::set<std::string> result = matched_with_writer(announcer_->get());
  const auto keep = [&result](const std::set<std::string>& others) {
    std::erase_if(result, [&](const std::string& key) { return !others.contains(key); });
  };
  keep(matched_with_writer(status_->get()));
  keep(matched_with_writer(record_->get()));
  keep(matched_with_writer(result_->get()));
  keep(matched_with_writer(request_->get()));
  keep(matched_with_reader(command_->get()));
  keep(matched_with_reader(ack_->get()));
  keep(matched_with_reader(block_->get()));
  return result;
}

/// The server of this gateway from now on; empty: none. One of a lower term than one that it had is
/// never chosen: it was frozen or cut off while another took its library over, or is a copy of
/// before. One of a higher term is chosen at once, whoever is there. Among equals (servers without
/// a term) the present one is kept until it is lost: another one never takes over by being newer. A
/// killed one stays matched until its lease ends, and its successor waits until then. Of several
/// that wait, the newest is chosen: the others may have been killed too.
std::string Gateway::choose(const std::set<std::string>& servers) {
  std::map<std::string, std::uint64_t> terms = terms_of_writers(command_->get());
  std::erase_if(stale_, [&](const std::string& key) { return !servers.contains(key); });
  std::uint64_t highest = seen_;
  for (const std::string& key : servers) highest = std::max(highest, terms[key]);
  std::string chosen;
  for (const std::string& key : complete_) {  // newest last
    if (terms[key] == highest && (chosen != heard_ || chosen.empty())) chosen = key;
    if (terms[key] >= seen_ || !stale_.insert(key).second || !handlers_.on_stale_server) continue;
    handlers_.on_stale_server(terms[key], seen_);
  }
  if (!chosen.empty()) seen_ = highest;
  return chosen;
}

void Gateway::look_at_servers() {
  const std::set<std::string> now = complete_servers();
  std::erase_if(complete_, [&](const std::string& key) { return !now.contains(key); });
  for (const std::string& key : now) {
    if (std::find(complete_.begin(), complete_.end(), key) == complete_.end())
      complete_.push_back(key);
  }
  const std::string heard = choose(now);
  const bool is_news = heard != heard_;
  if (!is_news && !announce_due_) return;
  believe(heard);
  {
    std::lock_guard lock(announce_mutex_);
    heard_ = heard;
    announce_due_ = announce_ && !write_announce();
  }
  if (announce_due_)
    wake_watcher();  // not accepted: try again; each attempt waits a little by itself
  if (!is_news) return;
  is_connected_ = !heard.empty();
  if (handlers_.on_server) handlers_.on_server(is_connected_);
}

Result<void> Gateway::write_announce() {
  return announcer_->write(*announce_, [this](dripline_idl_Announce& sample) {
    std::copy(heard_.begin(), heard_.end(), std::begin(sample.heard));
  });
}

}  // namespace

Result<std::unique_ptr<GatewayEndpoint>> GatewayEndpoint::open(const NetworkOptions& options,
                                                               const std::string& machine,
                                                               GatewayHandlers handlers) {
  if (auto checked = check_machine_name(machine); !checked) return fail(checked.error());
  auto domain = open_domain(options, Role::Gateway, cell_of(machine, options.cells));
  if (!domain) return fail(domain.error());
  auto gateway = std::make_unique<Gateway>(std::move(*domain), machine, std::move(handlers));
  if (auto started = gateway->start(); !started) return fail(started.error());
  return gateway;
}

}  // namespace dripline::dds
