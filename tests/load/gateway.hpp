#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "gateway/report/outbox.hpp"
#include "gateway/report/record_sender.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::load {

/// One machine of the load: the endpoint, the outbox and the record sender of a real gateway,
/// without interpreter and machine. A start is accepted at once; from then on its statuses are
/// those of a running program. One thread, except for what DDS delivers.
class LoadGateway {
 public:
  struct Options {
    dds::NetworkOptions network;
    std::string machine;
    /// Bytes of text a second that it executes; 0: the program is small and is there already.
    double text_rate = 0;
  };
  /// Errors: those of GatewayEndpoint::open. The outbox is opened later: Cyclone's select() knows
  /// no descriptor above 1023, so all endpoints of a process come first.
  static Result<std::unique_ptr<LoadGateway>> open(const Options& options);
  /// Announces it.
  Result<void> begin();

  bool is_connected() const { return is_connected_; }
  /// Something has arrived that `turn` handles.
  bool has_mail() const { return has_mail_; }
  void turn(SteadyTime now);
  /// The next block: a status that differs from the last one.
  void change(SteadyTime now);
  /// One more report line.
  void report();

  const std::string& machine() const { return options_.machine; }
  std::uint64_t epoch() const { return outbox_->epoch(); }
  std::uint64_t records() const { return outbox_->last_number(); }
  std::uint64_t unacknowledged() const { return outbox_->unacknowledged(); }
  std::uint64_t refused_statuses() const { return refused_; }
  std::uint64_t text_bytes() const { return text_bytes_; }
  std::uint64_t damaged_texts() const { return damaged_; }

 private:
  using Mail = std::variant<dds::Command, dds::RecordAck, dds::BlockData, bool>;
  explicit LoadGateway(Options options);
  void post(Mail mail);
  void handle(const dds::Command& command, SteadyTime now);
  void handle(const dds::RecordAck& ack, SteadyTime now);
  void handle(const dds::BlockData& block, SteadyTime now);
  void handle(bool is_connected, SteadyTime now);
  void append(dds::RecordKind kind, std::string text);
  void pull(SteadyTime now);
  void write_status();

  Options options_;
  dds::Status status_;
  std::optional<report::Outbox> outbox_;
  std::optional<report::RecordSender> sender_;
  std::atomic<bool> is_connected_ = false, has_mail_ = false;
  std::mutex mutex_;
  std::deque<Mail> mail_;
  std::uint64_t refused_ = 0, text_bytes_ = 0, damaged_ = 0;
  std::optional<SteadyTime> fed_since_;
  std::uint64_t wanted_ = 0;  ///< requested up to here
  SteadyTime asked_{};
  std::unique_ptr<dds::GatewayEndpoint> endpoint_;  // ends first: it delivers
};

/// The program that all machines of the load run: lines of kLineBytes, each with its number, so
/// that a piece shows whether it is the right one.
inline constexpr std::size_t kLineBytes = 32;
std::string program_text(std::uint64_t first_line, std::uint64_t lines);
/// Whether `bytes` are those of the program at `offset`.
bool is_program_text(std::uint64_t offset, std::span<const std::byte> bytes);

}  // namespace dripline::load
