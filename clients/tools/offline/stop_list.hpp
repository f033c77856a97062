#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// The places at which a program stops and waits for the operator, in the order they are met. A
/// place that is met again, in a repeat or a subprogram, is counted. The end of a program is no
/// stop. One thread; memory bounded by kMaxPlaces.
class StopList final : public EventSink {
 public:
  struct Place {
    Stop stop;  ///< when it was met first
    std::uint64_t times = 0;
  };
  static constexpr std::size_t kMaxPlaces = 1000;

  const std::vector<Place>& places() const { return places_; }
  /// Number of all places, those beyond the first kMaxPlaces included.
  std::uint64_t count() const { return count_; }

  void on_stop(const Stop& event) override;

 private:
  std::vector<Place> places_;
  /// Where in `places_` a stop of that program, offset and kind is.
  std::map<std::tuple<ProgramIndex, std::uint64_t, StopKind>, std::size_t> known_;
  std::uint64_t count_ = 0;
};

}  // namespace dripline::interpreter
