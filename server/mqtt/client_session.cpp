#include "server/mqtt/client_session.hpp"

#include <algorithm>

namespace dripline::mqtt {

using std::chrono::seconds;

namespace {

/// Also with a broker that wants to hear from us more often.
constexpr seconds kPingAnswer{20};

tl::unexpected<Error> unexpected(const Packet& packet) {
  return fail(Errc::Syntax, "a packet of type {} that was not expected",
              static_cast<unsigned>(packet.type));
}

}  // namespace

Result<void> ClientSession::begin(const Message& will, const std::string& subscribed,
                                  SteadyTime now) {
  if (subscribed.size() > kMaxFieldSize)
    return fail(Errc::LimitExceeded, "mqtt: a topic of {} bytes: at most {}", subscribed.size(),
                kMaxFieldSize);
  auto connect = connect_packet(introduction_, will);
  if (!connect) return fail(connect.error());
  subscribed_ = subscribed;
  output_ += *connect;
  sent_ = heard_ = now;
  return {};
}

Result<std::uint64_t> ClientSession::publish(const Message& message) {
  if (!is_connected_) return fail(Errc::Io, "not connected");
  const std::size_t size = publish_size(message, introduction_.is_version_5);
  const bool is_too_long =
      message.payload.size() > kMaxPayload || message.topic.size() > kMaxFieldSize;
  if (is_too_long || size > connack_.max_packet) {
    return fail(Errc::LimitExceeded, "takes no message of {} bytes ({}): at most {}", size,
                message.topic, std::min<std::size_t>(connack_.max_packet, kMaxPayload));
  }
  if (message.qos > connack_.max_qos) {
    return fail(Errc::Unsupported, "takes no QoS {}, {} at most ({})", message.qos,
                connack_.max_qos, message.topic);
  }
  if (output().size() > kMaxOutput) return fail(Errc::LimitExceeded, "does not take what is sent");
  Message sent = message;
  sent.is_retained = message.is_retained && connack_.has_retain;
  ++last_message_;
  if (message.qos > 0) {
    waiting_.emplace_back(last_message_, std::move(sent));
    send_waiting();
  } else {
    output_ += publish_packet(sent, 0, introduction_.is_version_5);
    unwritten_.emplace_back(written_ + output().size(), last_message_);
  }
  return last_message_;
}

void ClientSession::send_waiting() {
  const std::size_t room = std::min<std::size_t>(kMaxInFlight, connack_.receive_maximum);
  while (!waiting_.empty() && flights_.size() < room) {
    const auto& [message, content] = waiting_.front();
    const std::uint16_t number = free_number();
    flights_[number] = {message, content.qos};
    output_ += publish_packet(content, number, introduction_.is_version_5);
    waiting_.pop_front();
  }
}

/// There are many more than may be in flight.
std::uint16_t ClientSession::free_number() {
  do {
    ++last_number_;
  } while (last_number_ <= kSubscribe || flights_.contains(last_number_));
  return last_number_;
}

void ClientSession::written(std::size_t size, SteadyTime now) {
  if (size == 0) return;
  if (is_ping_open_ && written_ < ping_end_) pinged_ = now;  // more before it is gone, or itself
  written_ += size;
  sent_bytes_ += size;
  if (2 * sent_bytes_ >= output_.size()) output_.erase(0, std::exchange(sent_bytes_, 0));
  sent_ = now;
  while (!unwritten_.empty() && unwritten_.front().first <= written_) {
    acknowledged_.push_back({unwritten_.front().second, {}});
    unwritten_.pop_front();
  }
}

Result<void> ClientSession::look(SteadyTime now) {
  const auto wanted = connack_.keep_alive.value_or(0);
  const seconds own(introduction_.keep_alive);
  const seconds interval = wanted > 0 ? std::min(own, seconds(wanted)) : own;
  if (!is_connected_) return {};  // the caller has a limit for that
  if (is_ping_open_ && now - std::max(pinged_, heard_) >= kPingAnswer)
    return fail(Errc::Timeout, "has not answered for {} s", kPingAnswer.count());
  const bool is_quiet = now - sent_ >= interval || now - heard_ >= interval;
  if (is_ping_open_ || !is_quiet) return {};
  is_ping_open_ = true;
  pinged_ = now;
  output_ += empty_packet(PacketType::Pingreq);
  ping_end_ = written_ + output().size();
  return {};
}

Result<void> ClientSession::receive(std::string_view bytes, SteadyTime now) {
  if (!bytes.empty()) heard_ = now;
  reader_.add(bytes);
  while (true) {
    const auto packet = reader_.next();
    if (!packet) return fail(packet.error());
    if (!*packet) return {};
    if (auto taken = take(**packet); !taken) return taken;
    if (output().size() > kMaxOutput)
      return fail(Errc::LimitExceeded, "does not take what is sent");
  }
}

Result<void> ClientSession::take(const Packet& packet) {
  if (packet.type == PacketType::Connack) return take_connack(packet);
  // A refusal may come as DISCONNECT.
  if (packet.type == PacketType::Disconnect) return take_disconnect(packet);
  if (!is_connected_) return unexpected(packet);
  switch (packet.type) {
    case PacketType::Puback:
    case PacketType::Pubrec:
    case PacketType::Pubcomp:
      return take_answer(packet);
    case PacketType::Publish:
      return take_publication(packet);
    case PacketType::Suback:
      return take_suback(packet);
    case PacketType::Pingresp:
      is_ping_open_ = false;
      return {};
    default:
      return unexpected(packet);
  }
}

Result<void> ClientSession::take_connack(const Packet& packet) {
  if (is_connected_) return unexpected(packet);
  const auto connack = read_connack(packet, introduction_.is_version_5);
  if (!connack) return fail(connack.error());
  if (connack->reason != 0) {
    return fail(Errc::Io, "refused: {}",
                introduction_.is_version_5 ? reason_text(connack->reason)
                                           : refusal_text_311(connack->reason));
  }
  connack_ = *connack;
  is_connected_ = true;
  if (!subscribed_.empty())
    output_ += subscribe_packet(subscribed_, kSubscribe, introduction_.is_version_5);
  return {};
}

/// An answer to what was not sent, or another one than it has, acknowledges nothing: a record would
/// be passed over.
Result<void> ClientSession::take_answer(const Packet& packet) {
  const auto answer = read_answer(packet, introduction_.is_version_5);
  if (!answer) return fail(answer.error());
  const auto flight = flights_.find(answer->packet);
  if (flight == flights_.end())
    return fail(Errc::Syntax, "an acknowledgment of message {}, which is not in progress",
                answer->packet);
  auto& state = flight->second;
  const bool is_refusal = answer->reason >= kFirstRefusal;
  if (packet.type == PacketType::Pubrec && state.qos == 2) {
    if (is_refusal && !state.is_released)
      end_flight(flight, answer->reason);
    else if (!std::exchange(state.is_released, true))
      output_ += answer_packet(PacketType::Pubrel, answer->packet);
    return {};  // a repeat is passed over
  }
  const bool is_fit = packet.type == PacketType::Puback
                          ? state.qos == 1
                          : packet.type == PacketType::Pubcomp && state.is_released;
  if (!is_fit) return unexpected(packet);
  end_flight(flight, answer->reason);
  return {};
}

void ClientSession::end_flight(Flights::iterator flight, std::uint8_t reason) {
  acknowledged_.push_back(
      {flight->second.message, reason < kFirstRefusal ? "" : reason_text(reason)});
  flights_.erase(flight);
  send_waiting();
}

/// A refusal costs the wishes of others alone.
Result<void> ClientSession::take_suback(const Packet& packet) {
  const auto answer = read_suback(packet, introduction_.is_version_5);
  if (!answer) return fail(answer.error());
  if (subscribed_.empty() || answer->packet != kSubscribe) return unexpected(packet);
  return {};
}

Result<void> ClientSession::take_publication(const Packet& packet) {
  const auto publication = read_publication(packet, introduction_.is_version_5);
  if (!publication) return fail(publication.error());
  if (publication->qos == 1) output_ += answer_packet(PacketType::Puback, publication->packet);
  const bool is_wanted = publication->topic == subscribed_ && !publication->is_retained;
  const bool fits =
      publication->payload.size() <= kMaxReceivedSize && received_.size() < kMaxReceived;
  if (is_wanted && fits) received_.emplace_back(publication->payload);
  return {};
}

Result<void> ClientSession::take_disconnect(const Packet& packet) {
  if (!introduction_.is_version_5) return unexpected(packet);
  const auto reason = read_disconnect(packet);
  if (!reason) return fail(reason.error());
  return fail(Errc::Io, "{}", reason_text(*reason));
}

}  // namespace dripline::mqtt
