#include "gateway/app/inbox.hpp"

#include <utility>

namespace dripline::gateway {

void Inbox::post(Incoming incoming) {
  const bool is_block = std::holds_alternative<dds::BlockData>(incoming);
  const bool may_be_dropped = is_block || std::holds_alternative<dds::Command>(incoming) ||
                              std::holds_alternative<dds::RecordAck>(incoming) ||
                              std::holds_alternative<dds::LineRequest>(incoming);
  {
    const std::lock_guard lock(mutex_);
    std::size_t& count = is_block ? blocks_ : others_;
    if (may_be_dropped && count >= (is_block ? kMaxBlocks : kMaxOthers)) return;
    ++count;
    waiting_.push_back(std::move(incoming));
  }
  changed_.notify_one();
}

std::vector<Incoming> Inbox::take(SteadyTime deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] { return !waiting_.empty(); });
  blocks_ = others_ = 0;
  return std::exchange(waiting_, {});
}

std::vector<PanelRequest> Inbox::take_panel() {
  std::vector<PanelRequest> requests;
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&requests](Incoming& incoming) {
    auto* const request = std::get_if<PanelRequest>(&incoming);
    if (request != nullptr) requests.push_back(std::move(*request));
    return request != nullptr;
  });
  others_ -= requests.size();
  return requests;
}

}  // namespace dripline::gateway
