#pragma once

#include <thread>

#include "gateway/line/line_texts.hpp"
#include "tests/unit/gateway/app/serial/serial_fixture.hpp"

namespace dripline::gateway {

using dds::LineAction;
using dds::LineResult;

/// With what the server sends to a gateway's line.
class LineAnswersTest : public SerialGatewayTest {
 protected:
  static std::string text_of(const dds::LineData& data) {
    return {reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()};
  }
  static dds::LineRequest request(LineAction action, std::string id = {}) {
    dds::LineRequest request;
    request.machine = "mill-3";
    request.session = kSession;
    request.id = std::move(id);
    request.action = action;
    return request;
  }
  /// As the server does: the text in pieces, then the order.
  dds::LineData send(const std::string& text, const std::string& content,
                     const std::string& id = "transfer-1", std::size_t piece = 1000,
                     LineAction action = LineAction::Send) {
    for (std::size_t at = 0; at < text.size(); at += piece) {
      auto part = request(LineAction::Text);
      part.name = id;
      part.number = at;
      const auto bytes =
          std::as_bytes(std::span(text).subspan(at, std::min(piece, text.size() - at)));
      part.bytes = {bytes.begin(), bytes.end()};
      if (const auto kept = ask(part); kept.status != LineResult::Done) return kept;
    }
    auto order = request(action);
    order.name = id;
    order.text = line::encode(
        line::TransferOrder{.content = content, .name = "O0077", .programs = {"O0077 revision 1"}});
    return ask(order);
  }
  dds::LineData send(const std::string& text) { return send(text, sha256(text).hex()); }
  /// What the control asked for by a text of its own.
  dds::LineData give(const std::string& text) {
    return send(text, sha256(text).hex(), "answer-1", 1000, LineAction::Answer);
  }
  dds::LineData stop(const std::string& reason) {
    auto stop = request(LineAction::Stop);
    stop.text = reason;
    return ask(stop);
  }
  dds::LineTransfer transfer() const {
    return status().serial_line->transfer.value_or(dds::LineTransfer{});
  }
  /// Until the examination's own time is over.
  static void let_time_pass() { std::this_thread::sleep_for(std::chrono::seconds(2)); }
  const std::string program_ = [] {
    std::string text = "O0077\n";
    for (int i = 0; i < 400; ++i) text += "G1 X" + std::to_string(i) + ".\n";
    return text + "M30\n";
  }();
  static constexpr const char* kPlain = "line=9600n81\neob=lf\nflow=none";
};

}  // namespace dripline::gateway
