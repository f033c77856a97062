#include "protocol/dds/gateway_listener.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <cerrno>
#include <cstring>

#include "protocol/dds/configuration.hpp"

namespace dripline::dds {
namespace {

/// An announcement has some hundred bytes, and with certificates some thousand.
constexpr std::size_t kMaxDatagram = 64 << 10;
/// Of one socket at one look, so that a flood does not keep the caller: more than all gateways of a
/// cell send meanwhile.
constexpr int kMaxDatagrams = 1024;

Result<Descriptor> listen_at(std::uint16_t port) {
  Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket) return fail(Errc::Io, "UDP port {}: {}", port, std::strerror(errno));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return fail(Errc::Busy, "UDP port {} is in use (another server?)", port);
  return socket;
}

}  // namespace

void HeardGateways::note(const ParticipantAnnouncement::Prefix& gateway, SteadyTime now) {
  const auto found = gateways_.find(gateway);
  if (found == gateways_.end()) {
    if (gateways_.size() >= kMaxMachines) drop_silent(now);
    if (gateways_.size() < kMaxMachines) gateways_.emplace(gateway, Heard{now, now});
    return;
  }
  Heard& heard = found->second;
  if (now - heard.last > lease_) heard.since = now;
  heard.last = now;
}

std::size_t HeardGateways::count(SteadyTime now) const {
  std::size_t count = 0;
  for (const auto& [gateway, heard] : gateways_)
    if (now - heard.last <= lease_ && heard.last - heard.since >= lease_) ++count;
  return count;
}

void HeardGateways::drop_silent(SteadyTime now) {
  std::erase_if(gateways_, [&](const auto& entry) { return now - entry.second.last > lease_; });
}

Result<std::unique_ptr<GatewayListener>> GatewayListener::open(const NetworkOptions& options) {
  std::unique_ptr<GatewayListener> listener(new GatewayListener(options));
  for (std::uint32_t cell = 0; cell < options.cells; ++cell) {
    auto socket = listen_at(first_port(options, cell));
    if (!socket)
      return fail(socket.error().code, "DDS domain {}: {}", options.domain, socket.error().what);
    listener->sockets_.push_back(*std::move(socket));
  }
  listener->buffer_.resize(kMaxDatagram);
  return listener;
}

void GatewayListener::receive(SteadyTime now) {
  const bool is_old =
      received_ != SteadyTime{} && now - received_ >= std::chrono::milliseconds(options_.lease_ms);
  received_ = now;
  for (const auto& socket : sockets_) receive_at(socket, now, is_old);
  heard_.drop_silent(now);
}

void GatewayListener::receive_at(const Descriptor& socket, SteadyTime now, bool is_old) {
  for (int i = 0; i < kMaxDatagrams; ++i) {
    const auto size = ::recv(socket.get(), buffer_.data(), buffer_.size(), 0);
    if (size < 0) {
      if (errno == EAGAIN || errno == EWOULDBLOCK) return;
      continue;
    }
    if (is_old) continue;
    const auto read = read_announcement(std::span(buffer_).first(static_cast<std::size_t>(size)));
    if (read && read->domain == options_.domain && read->tag == options_.tag)
      heard_.note(read->prefix, now);
  }
}

}  // namespace dripline::dds
