#include "clients/tools/offline/stop_list.hpp"

namespace dripline::interpreter {

void StopList::on_stop(const Stop& event) {
  ++count_;
  const auto place = std::tuple(event.origin.program, event.origin.offset, event.kind);
  if (const auto known = known_.find(place); known != known_.end()) {
    ++places_[known->second].times;
  } else if (places_.size() < kMaxPlaces) {
    known_.emplace(place, places_.size());
    places_.push_back({event, 1});
  }
}

}  // namespace dripline::interpreter
