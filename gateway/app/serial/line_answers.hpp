#pragma once

#include <deque>
#include <future>
#include <memory>
#include <string>

#include "gateway/app/serial/line_calls.hpp"
#include "gateway/app/serial/serial_inbound.hpp"
#include "gateway/app/serial/serial_transfer.hpp"
#include "gateway/line/line_examination.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// Answers what the server wants of the line: its recording, a program that the control has sent,
/// programs for the control, a test. What changes something is done once for each id, of which the
/// last kRemembered are known. One thread.
class LineAnswers {
 public:
  static constexpr std::size_t kRemembered = 64;
  struct Parts {
    std::uint64_t session = 0;
    dds::GatewayEndpoint& endpoint;
    UploadStore& uploads;
    SerialInbound& inbound;
    LineCalls& calls;
    SerialTransfer& transfer;
    std::shared_ptr<const line::RuleSet> rules;
    bool extracts_programs = false;  ///< of the line's settings
  };
  /// All references must outlive it.
  explicit LineAnswers(const Parts& parts) : parts_(parts) {}
  ~LineAnswers();
  LineAnswers(const LineAnswers&) = delete;
  LineAnswers& operator=(const LineAnswers&) = delete;
  void use(std::shared_ptr<line::PortLine> port) { port_ = std::move(port); }

  /// `is_running`: a run is there; the control gets nothing else.
  void take(const dds::LineRequest& request, bool is_running);

 private:
  /// A request that was carried out, or is being carried out: NotYet.
  struct Done {
    std::string id;
    dds::LineData data;
  };
  dds::LineData recording(std::uint64_t number) const;
  dds::LineData upload(const std::string& id, std::uint64_t offset) const;
  dds::LineData judge(const dds::LineRequest& request) const;
  dds::LineData answer_once(const dds::LineRequest& request, bool is_running);
  void carry_out(const dds::LineRequest& request, bool is_running);
  void give_answer(const dds::LineRequest& request, bool is_running);
  void send_answer(const dds::LineRequest& request, bool is_running);
  void begin_transfer(const dds::LineRequest& request, bool is_running);
  void begin_test(const std::string& id, bool is_running);
  void look_at_test();
  Done* find(const std::string& id);
  void remember(const std::string& id, dds::LineData data);
  line::PortLine::Answer answer_to(const std::string& id);
  void write(const dds::LineRequest& request, dds::LineData data);

  const Parts parts_;
  std::shared_ptr<line::PortLine> port_;
  std::deque<Done> done_;  ///< the latest last
  std::string tested_;     ///< id of the test that was begun last
  std::future<line::PortTest> test_;
};

}  // namespace dripline::gateway
