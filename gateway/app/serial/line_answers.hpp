#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>

#include "gateway/app/serial/line_calls.hpp"
#include "gateway/app/serial/serial_inbound.hpp"
#include "gateway/line/line_examination.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// Answers what the server wants of the line: its recording, a program that the control has sent,
/// an answer for the control, a test. What changes something is done once for each id. One thread.
class LineAnswers {
 public:
  struct Parts {
    std::uint64_t session = 0;
    dds::GatewayEndpoint& endpoint;
    UploadStore& uploads;
    SerialInbound& inbound;
    LineCalls& calls;
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
  dds::LineData recording(std::uint64_t number) const;
  dds::LineData upload(const std::string& id, std::uint64_t offset) const;
  dds::LineData carry_out(const dds::LineRequest& request, bool is_running);
  dds::LineData test(const dds::LineRequest& request, bool is_running);
  void write(const dds::LineRequest& request, dds::LineData data);

  const Parts parts_;
  std::shared_ptr<line::PortLine> port_;
  std::string last_id_;
  dds::LineData last_;
  std::future<line::PortTest> test_;
};

}  // namespace dripline::gateway
