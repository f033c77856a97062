#pragma once

#include <string_view>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"
#include "gateway/interpreter/dialects/centurion/modal_state.hpp"

namespace dripline::interpreter::centurion {

/// An option with a value for each axis, and the parameter of the first one.
struct PlaceOption {
  std::string_view name;
  int parameter;
};
inline constexpr PlaceOption kPlaceOptions[] = {
    {"home", kHomePosition},
    {"tool_change", kToolChangePoint},
    {"positive_zone", kPositiveZone},
    {"negative_zone", kNegativeZone},
    {"positive_limit", kPositiveLimit},
    {"negative_limit", kNegativeLimit},
    {"g60_overrun", kSingleOverrun},
    {"g0_overrun", kRapidOverrun},
    {"maximum_feed", kMaximumFeed},
};

/// The control's memory at the start of a run: modes, offsets, tools, parameters.
/// Errors: Unsupported, naming the record of the setup that this control does not have.
Result<void> load_memory(const Setup& setup, ModalState& state, Parameters& parameters);

}  // namespace dripline::interpreter::centurion
