#pragma once

#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gateway/app/serial/serial_gateway.hpp"
#include "gateway/line/inbound/rule_reader.hpp"
#include "protocol/dds/record_text.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/gateway/app/serial/simulated_line.hpp"

namespace dripline::gateway {

/// A gateway beside a control with everything around it in a test's hands: its clock, its server,
/// its disk, and its line, whose time goes by with the clock.
class SerialGatewayTest : public testing::Test, public dds::GatewayEndpoint {
 protected:
  static constexpr std::uint64_t kSession = 7;

  /// `settings`: of the line, one a line, over those of the template "plain".
  void begin(const std::string& settings, const std::string& rules = "") {
    options_.machine = "mill-3";
    options_.control = "fanuc";
    options_.line.emplace();
    options_.line->address = "/dev/line";
    options_.line->ahead = ahead;
    for (std::size_t at = 0; at < settings.size();) {
      const auto end = std::min(settings.find('\n', at), settings.size());
      const std::string pair = settings.substr(at, end - at);
      const auto equals = pair.find('=');
      ASSERT_TRUE(
          wire::set_value(options_.line->settings, pair.substr(0, equals), pair.substr(equals + 1)))
          << pair;
      at = end + 1;
    }
    outbox_.emplace(report::Outbox::open(folder_.path() / "outbox.sqlite").value());
    journal_.emplace(report::RunJournal::open(folder_.path() / "run.journal").value());
    uploads_.emplace(UploadStore::open(folder_.path() / "uploads").value());
    gateway_.emplace(SerialGateway::Parts{
        .options = options_,
        .endpoint = *this,
        .outbox = *outbox_,
        .journal = *journal_,
        .uploads = *uploads_,
        .clock = clock_,
        .rules = rules.empty() ? std::make_shared<const line::RuleSet>()
                               : std::make_shared<const line::RuleSet>(
                                     line::RuleSet(line::read_rules(rules).value())),
        .recordings = folder_.path() / "recordings",
        .kept_transfer = folder_.path() / "line-transfer.json",
        .kept_emergency_stop = folder_.path() / "emergency-stop",
        .session = kSession,
        .wake = [] {},
        .open =
            [this](serial::LineDriver::Parts parts) {
              auto made = std::make_unique<SimulatedLine>(std::move(parts), wire_);
              line_ = made.get();
              return Result<std::unique_ptr<serial::LineDriver>>(std::move(made));
            }});
    ASSERT_TRUE(gateway_->recover());
    connect(true);
    pass(std::chrono::milliseconds(500));
  }
  /// `begin` is the gateway's next life then.
  void end() {
    gateway_.reset();
    uploads_.reset();
    journal_.reset();
    outbox_.reset();
    options_.line.reset();
    wire_ = {};
  }
  /// As the process does at SIGTERM; it is not over then, its line is.
  void stop() {
    gateway_->receive(StopRequested{15}, clock_.steady_now());
    ASSERT_TRUE(gateway_->is_at_rest());
    ASSERT_TRUE(gateway_->interrupt_run("the gateway was stopped"));
    line_ = nullptr;
  }
  /// The next life finds the folder as a kill leaves it.
  void kill() {
    const auto copy = folder_.path().parent_path() / (folder_.path().filename().string() + "-copy");
    std::filesystem::copy(folder_.path(), copy, std::filesystem::copy_options::recursive);
    end();
    std::filesystem::remove_all(folder_.path());
    std::filesystem::rename(copy, folder_.path());
  }
  /// As a signal ends the process: in order.
  void stop_process() {
    EXPECT_TRUE(gateway_->interrupt_run("the gateway was stopped"));
    end();
  }
  void connect(bool is_up) {
    is_up_ = is_up;
    gateway_->receive(ServerSeen{is_up}, clock_.steady_now());
  }
  /// Time goes by for the gateway, its line and its server.
  void pass(std::chrono::milliseconds time) {
    for (const auto end = clock_.steady_now() + time; clock_.steady_now() < end;) {
      gateway_->turn(clock_.steady_now());
      serve();
      clock_.advance(kStep);
      if (line_ != nullptr) line_->move(kStep);
      if (each_step) each_step();
    }
    gateway_->turn(clock_.steady_now());
  }
  bool pass_until(const std::function<bool()>& is_so, std::chrono::milliseconds limit) {
    for (const auto end = clock_.steady_now() + limit; clock_.steady_now() < end; pass(kStep))
      if (is_so()) return true;
    return is_so();
  }
  void start(const std::string& text) {
    order(text);
    ASSERT_TRUE(result_ && result_->accepted) << (result_ ? result_->reason : "no answer");
  }
  /// A start with this argument.
  void order(const std::string& text, const std::string& argument = "") {
    text_ = text;
    dds::Command start;
    start.machine = "mill-3";
    start.id = "order-" + std::to_string(++ordered_);
    start.action = dds::CommandAction::Start;
    start.session = kSession;
    start.server = start.number = ordered_;
    start.deadline = std::chrono::duration_cast<std::chrono::microseconds>(
                         clock_.steady_now().time_since_epoch()) +
                     std::chrono::seconds(5);
    start.run = "run-" + std::to_string(ordered_);
    start.program = "O0077";
    start.revision = sha256(text).hex();
    start.size = text.size();
    start.control = "fanuc";
    start.argument = argument;
    gateway_->receive(start, clock_.steady_now());
    pass(kStep);
  }
  std::optional<dds::RunEndText> ended() const {
    for (const auto& record : records_)
      if (record.kind == dds::RecordKind::RunEnded) return dds::decode_run_end(record.text).value();
    return std::nullopt;
  }
  /// Asks as the server does: the same again until there is an answer.
  dds::LineData ask(dds::LineRequest request) {
    request.machine = "mill-3";
    request.session = kSession;
    if (request.id.empty()) request.id = "ask-" + std::to_string(++asked_);
    for (int i = 0; i < 100; ++i) {
      if (const auto data = ask_once(request); data.status != dds::LineResult::NotYet) return data;
    }
    ADD_FAILURE() << "no answer";
    return {};
  }
  dds::LineData ask_once(const dds::LineRequest& request) {
    answer_.reset();
    gateway_->receive(request, clock_.steady_now());
    pass(std::chrono::milliseconds(100));
    EXPECT_TRUE(answer_);
    return answer_.value_or(dds::LineData{});
  }
  /// Before anything else is done.
  void take(const dds::LineRequest& request) { gateway_->receive(request, clock_.steady_now()); }
  std::string panel(const std::string& line, const std::string& why_late = "") {
    std::string answer;
    gateway_->receive(
        PanelRequest{parse_panel_command(line).value(),
                     [&](std::string text) { answer = std::move(text); }, [&] { return why_late; }},
        clock_.steady_now());
    return answer;
  }
  dds::Status status() const { return gateway_->status(); }

  Result<void> write(const dds::Announce&) override { return {}; }
  Result<void> write(const dds::Status&) override { return {}; }
  Result<void> write(const dds::Record& message) override {
    if (is_up_ && message.number == records_.size() + 1) records_.push_back(message);
    return {};
  }
  Result<void> write(const dds::CommandResult& message) override {
    result_ = message;
    return {};
  }
  Result<void> write(const dds::BlockRequest& message) override {
    if (is_up_) requests_.push_back(message);
    return {};
  }
  Result<void> write(const dds::LineData& message) override {
    answer_ = message;
    return {};
  }
  bool is_connected() const override { return is_up_; }
  dds::Rejected rejected() const override { return {}; }

  static constexpr std::chrono::milliseconds kStep{50};
  std::chrono::seconds ahead{600};
  std::function<void()> each_step;
  test_support::TemporaryFolder folder_;
  test_support::ManualClock clock_;
  GatewayOptions options_;
  SimulatedWire wire_;
  SimulatedLine* line_ = nullptr;
  std::vector<dds::Record> records_;
  std::optional<dds::CommandResult> result_;

 private:
  void serve() {
    if (!is_up_) return;
    for (const auto& request : std::exchange(requests_, {})) {
      const std::size_t end = std::min<std::size_t>(text_.size(), request.offset + request.length);
      for (std::size_t at = request.offset; at < end;) {
        dds::BlockData data;
        data.machine = request.machine;
        data.session = request.session;
        data.run = request.run;
        data.offset = at;
        data.total_bytes = text_.size();
        const std::size_t length = std::min(dds::kMaxBlockBytes, end - at);
        const auto bytes = std::as_bytes(std::span(text_).subspan(at, length));
        data.bytes = {bytes.begin(), bytes.end()};
        at += length;
        data.ends = at == text_.size();
        gateway_->receive(data, clock_.steady_now());
      }
    }
    if (!records_.empty())
      gateway_->receive(dds::RecordAck{"mill-3", records_.back().epoch, records_.back().number},
                        clock_.steady_now());
  }

  std::string text_;
  std::vector<dds::BlockRequest> requests_;
  std::optional<dds::LineData> answer_;
  int asked_ = 0;
  std::uint64_t ordered_ = 0;
  bool is_up_ = false;
  std::optional<report::Outbox> outbox_;
  std::optional<report::RunJournal> journal_;
  std::optional<UploadStore> uploads_;
  std::optional<SerialGateway> gateway_;  // last: it ends before what it uses
};

}  // namespace dripline::gateway
