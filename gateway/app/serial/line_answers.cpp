#include "gateway/app/serial/line_answers.hpp"

#include <utility>

#include "gateway/line/recording/recording_file.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

using dds::LineAction;
using dds::LineResult;

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

dds::LineData refused(std::string reason) {
  dds::LineData data;
  data.status = LineResult::Refused;
  data.reason = std::move(reason);
  return data;
}

}  // namespace

LineAnswers::~LineAnswers() {
  if (test_.valid()) test_.wait();
}

void LineAnswers::take(const dds::LineRequest& request, bool is_running) {
  if (request.session != parts_.session) return;
  switch (request.action) {
    case LineAction::Recording:
      return write(request, recording(request.number));
    case LineAction::Upload:
      return write(request, upload(request.name, request.number));
    case LineAction::Test:
      return write(request, test(request, is_running));
    default:
      break;
  }
  if (request.id != last_id_) {
    last_ = carry_out(request, is_running);
    last_id_ = request.id;
  }
  write(request, last_);
}

void LineAnswers::write(const dds::LineRequest& request, dds::LineData data) {
  data.machine = request.machine;
  data.session = parts_.session;
  data.id = request.id;
  // What is lost is asked for again.
  if (auto written = parts_.endpoint.write(data); !written)
    process::log_debug("answer to the server not written: {}", written.error().what);
}

/// Whole entries, as many as fit.
dds::LineData LineAnswers::recording(std::uint64_t number) const {
  dds::LineData data;
  std::string text;
  constexpr std::size_t kMaxEntries = 512;
  const auto part = port_->recorder().entries_from(number, kMaxEntries);
  data.next = part.first;
  data.ends = part.entries.size() < kMaxEntries;
  for (const auto& entry : part.entries) {
    const std::string line = line::to_recording_line(entry) + "\n";
    if (text.size() + line.size() > dds::kMaxBlockBytes) {
      data.ends = false;
      break;
    }
    text += line;
    ++data.next;
  }
  data.bytes = bytes_of(text);
  return data;
}

dds::LineData LineAnswers::upload(const std::string& id, std::uint64_t offset) const {
  const auto text = parts_.uploads.read(id, offset, dds::kMaxBlockBytes);
  if (!text) return refused(text.error().what);
  dds::LineData data;
  data.next = offset + text->size();
  data.ends = text->size() < dds::kMaxBlockBytes;
  data.bytes = bytes_of(*text);
  return data;
}

dds::LineData LineAnswers::carry_out(const dds::LineRequest& request, bool is_running) {
  switch (request.action) {
    case LineAction::Stored:
      parts_.uploads.remove(request.name);
      parts_.inbound.report(request.text);
      return {};
    case LineAction::Answer:
      parts_.calls.end(request.number);
      if (is_running) return refused("a run is on the line");
      parts_.inbound.send_answer(request.name, request.text);
      return {};
    case LineAction::Refuse:
      parts_.calls.end(request.number);
      port_->note("refused: " + request.text);
      port_->refuse(request.text);
      return {};
    case LineAction::Done:
      parts_.calls.end(request.number);
      if (!request.text.empty()) parts_.inbound.report(request.text);
      return {};
    case LineAction::Receive:
      if (is_running || port_->is_busy()) return refused("the line is busy");
      port_->begin_receive([](const Result<void>& begun) {
        if (!begun) process::log_warning("the control was not asked: {}", begun.error().what);
      });
      return {};
    default:
      return refused("this gateway does not know the request");
  }
}

/// The examination listens for a while, on a thread of its own; it is asked for until it is done.
dds::LineData LineAnswers::test(const dds::LineRequest& request, bool is_running) {
  if (request.id != last_id_) {
    if (test_.valid()) return refused("the line is being tested");
    if (is_running || port_->is_busy()) return refused("the line is busy");
    last_id_ = request.id;
    last_ = {};
    last_.status = LineResult::NotYet;
    test_ = std::async(std::launch::async, [port = port_] { return line::examine(*port); });
  }
  const bool is_ready =
      test_.valid() && test_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!is_ready) return last_;
  const line::PortTest test = test_.get();
  std::string text = test.is_passed ? "passed\n" : "failed\n";
  for (const std::string& finding : test.findings) text += finding + "\n";
  last_ = {};
  last_.bytes = bytes_of(std::string_view(text).substr(0, dds::kMaxBlockBytes));
  return last_;
}

}  // namespace dripline::gateway
