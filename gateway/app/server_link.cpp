#include "gateway/app/server_link.hpp"

#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::gateway {

ServerLink::ServerLink(const Parts& parts)
    : parts_(parts),
      sender_(
          parts_.options.machine, parts_.outbox, {},
          [this](const dds::Record& record) { return parts_.endpoint.write(record).has_value(); }),
      publisher_([this](const dds::Status& status) {
        return parts_.endpoint.write(status).has_value();
      }) {}

void ServerLink::on_server(bool is_connected) {
  process::log_info("server {} machine={}", is_connected ? "connected" : "gone",
                    parts_.options.machine);
  is_connected_ = is_connected;
  was_connected_ = was_connected_ || is_connected;
  refused_.clear();
  if (is_connected_) is_due_ = true;
  sender_.on_server(is_connected);
  publisher_.reset();
}

void ServerLink::on_refusal(const dds::Command& command) {
  if (std::exchange(refused_, command.argument) == command.argument) return;
  process::log_error("the server does not command this gateway: {} machine={}", command.argument,
                     parts_.options.machine);
}

void ServerLink::announce() {
  if (!is_due_) return;
  dds::Announce message;
  message.machine = parts_.options.machine;
  message.control = parts_.options.control;
  message.version = DRIPLINE_VERSION;
  message.epoch = parts_.outbox.epoch();
  message.session = parts_.session;
  message.description = parts_.options.description;
  if (const auto& certificate = parts_.options.certificate)
    message.certificate_expires = certificate->not_after;
  message.has_line = parts_.options.drives_control();
  message.commands = static_cast<std::uint32_t>(dds::words_of(dds::CommandAction{}).size());
  is_due_ = !parts_.endpoint.write(message).has_value();
}

void ServerLink::send_records(SteadyTime now) {
  const std::uint64_t unsent = parts_.outbox.unacknowledged();
  if (const auto done = sender_.poll(now); !done) {
    process::log_error("outbox of {} records machine={}: {}", unsent, parts_.options.machine,
                       done.error().what);
  }
  if (!sender_.take_epoch_change()) return;
  process::log_warning("record numbers begin again, epoch {} machine={}", parts_.outbox.epoch(),
                       parts_.options.machine);
  is_due_ = true;
}

void ServerLink::send_status(SteadyTime now, const std::function<dds::Status()>& make) {
  log_silence(now);
  if (!publisher_.is_due(now)) return;
  publisher_.offer(make(), now);
  log_rejected(now);
}

/// Neither end can know why they do not meet: what both have to agree on is named, once.
void ServerLink::log_silence(SteadyTime now) {
  constexpr std::chrono::seconds kPatience{10};
  if (was_connected_ || !parts_.options.has_server) return;
  if (!begun_) begun_ = now;
  if (now - *begun_ < kPatience) return;
  was_connected_ = true;
  const auto& network = parts_.options.network;
  process::log_warning(
      "no server has answered in 10 s machine={} server={} dds-domain={} dds-tag='{}' "
      "dds-cells={}: it must run there with this domain and tag and at least as many cells (an "
      "earlier version has {}), and its UDP ports be open to this computer",
      parts_.options.machine, network.server, network.domain, network.tag, network.cells,
      dds::kFewestCells);
}

/// Dropped messages are logged once a minute at most: their sender must not fill the log.
void ServerLink::log_rejected(SteadyTime now) {
  constexpr std::chrono::minutes kInterval{1};
  const dds::Rejected dropped = parts_.endpoint.rejected();
  if (dropped.messages == logged_ || now < next_log_) return;
  process::log_warning("dropped {} DDS messages, the last: {} machine={}",
                       dropped.messages - logged_, dropped.last_reason, parts_.options.machine);
  logged_ = dropped.messages;
  next_log_ = now + kInterval;
}

}  // namespace dripline::gateway
