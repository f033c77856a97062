#include "gateway/app/serial/line_answers.hpp"

#include <algorithm>
#include <utility>

#include "gateway/line/line_texts.hpp"
#include "gateway/line/port_transfer.hpp"
#include "gateway/line/recording/recording_file.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

using dds::LineAction;
using dds::LineData;
using dds::LineResult;

constexpr std::string_view kRunIsThere = "a run is on the line";

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

LineData with_bytes(std::string_view text) {
  LineData data;
  data.bytes = bytes_of(text);
  return data;
}

LineData refused(std::string_view reason) {
  LineData data;
  data.status = LineResult::Refused;
  data.reason = reason;
  return data;
}

LineData not_yet() {
  LineData data;
  data.status = LineResult::NotYet;
  return data;
}

LineData data_of(const Result<void>& result) {
  return result ? LineData{} : refused(result.error().what);
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
    case LineAction::Judge:
      return write(request, judge(request));
    default:
      return write(request, answer_once(request, is_running));
  }
}

void LineAnswers::write(const dds::LineRequest& request, LineData data) {
  data.machine = request.machine;
  data.session = parts_.session;
  data.id = request.id;
  // What is lost is asked for again.
  if (auto written = parts_.endpoint.write(data); !written)
    process::log_debug("answer to the server not written: {}", written.error().what);
}

/// Whole entries, as many as fit.
LineData LineAnswers::recording(std::uint64_t number) const {
  LineData data;
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

LineData LineAnswers::upload(const std::string& id, std::uint64_t offset) const {
  const auto text = parts_.uploads.read(id, offset, dds::kMaxBlockBytes);
  if (!text) return refused(text.error().what);
  LineData data = with_bytes(*text);
  data.next = offset + text->size();
  data.ends = text->size() < dds::kMaxBlockBytes;
  return data;
}

LineData LineAnswers::judge(const dds::LineRequest& request) const {
  const auto verdict = parts_.rules->explain(text_of(request.bytes), parts_.extracts_programs);
  return with_bytes(line::encode(verdict, dds::kMaxBlockBytes));
}

LineAnswers::Done* LineAnswers::find(const std::string& id) {
  const auto found = std::ranges::find(done_, id, &Done::id);
  return found == done_.end() ? nullptr : &*found;
}

void LineAnswers::remember(const std::string& id, LineData data) {
  if (Done* known = find(id)) {
    known->data = std::move(data);
    return;
  }
  done_.push_back({id, std::move(data)});
  if (done_.size() <= kRemembered) return;
  const auto is_over = [](const Done& done) { return done.data.status != LineResult::NotYet; };
  const auto oldest = std::ranges::find_if(done_, is_over);
  done_.erase(oldest == done_.end() ? done_.begin() : oldest);
}

/// What takes its time is asked for until it is done.
LineData LineAnswers::answer_once(const dds::LineRequest& request, bool is_running) {
  look_at_test();
  if (!find(request.id)) carry_out(request, is_running);
  return find(request.id)->data;
}

line::PortLine::Answer LineAnswers::answer_to(const std::string& id) {
  remember(id, not_yet());
  return [this, id](const Result<void>& result) {
    if (!result) process::log_warning("line request {}: {}", id, result.error().what);
    remember(id, data_of(result));
  };
}

void LineAnswers::carry_out(const dds::LineRequest& request, bool is_running) {
  switch (request.action) {
    case LineAction::Stored:
      parts_.uploads.remove(request.name);
      parts_.inbound.report(request.text);
      return remember(request.id, {});
    case LineAction::Answer:
    case LineAction::Refuse:
    case LineAction::Done:
      return give_answer(request, is_running);
    case LineAction::Test:
      return begin_test(request.id, is_running);
    case LineAction::Receive:
      if (is_running) return remember(request.id, refused(kRunIsThere));
      return line::receive_program(*port_, answer_to(request.id));
    case LineAction::Text:
      return remember(request.id, data_of(parts_.transfer.add(request.name, request.number,
                                                              text_of(request.bytes))));
    case LineAction::Send:
      return begin_transfer(request, is_running);
    case LineAction::Stop:
      return line::stop_transfer(*port_, request.text, answer_to(request.id));
    default:
      return remember(request.id, refused("this gateway does not know the request"));
  }
}

/// To what the operator requested at the control.
void LineAnswers::give_answer(const dds::LineRequest& request, bool is_running) {
  parts_.calls.end(request.number);
  remember(request.id, {});
  if (request.action == LineAction::Answer) return send_answer(request, is_running);
  if (request.action == LineAction::Done) {
    if (!request.text.empty()) parts_.inbound.report(request.text);
    return;
  }
  port_->note("refused: " + request.text);
  port_->refuse(request.text);
}

void LineAnswers::send_answer(const dds::LineRequest& request, bool is_running) {
  if (is_running) return remember(request.id, refused(kRunIsThere));
  const auto order = line::decode_transfer_order(request.text);
  auto text =
      order ? parts_.transfer.take(request.name, *order) : Result<std::string>(fail(order.error()));
  if (!text) return remember(request.id, refused(text.error().what));
  const auto sent = parts_.inbound.send_answer(order->name, *std::move(text));
  if (!sent) remember(request.id, refused(sent.error().what));
}

void LineAnswers::begin_transfer(const dds::LineRequest& request, bool is_running) {
  if (is_running) return remember(request.id, refused(kRunIsThere));
  const auto order = line::decode_transfer_order(request.text);
  if (!order) return remember(request.id, refused(order.error().what));
  parts_.transfer.send(request.name, *order, answer_to(request.id));
}

/// The examination listens for a while, on a thread of its own.
void LineAnswers::begin_test(const std::string& id, bool is_running) {
  if (test_.valid()) return remember(id, refused("the line is being tested"));
  if (is_running || port_->is_busy()) return remember(id, refused("the line is busy"));
  remember(id, not_yet());
  tested_ = id;
  test_ = std::async(std::launch::async, [port = port_] { return line::examine(*port); });
}

/// Its result is taken whether anybody still asks for it or not: the line is free for the next.
void LineAnswers::look_at_test() {
  if (!test_.valid() || test_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  const std::string text = line::encode(test_.get());
  remember(tested_, text.size() <= dds::kMaxBlockBytes
                        ? with_bytes(text)
                        : refused("the findings are longer than a message"));
}

}  // namespace dripline::gateway
