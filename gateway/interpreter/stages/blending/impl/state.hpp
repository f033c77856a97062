#pragma once

#include <array>
#include <optional>

#include "gateway/interpreter/stages/blending/impl/element.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"

namespace dripline::interpreter::blending::impl {

/// The end of a block that compensation does not count.
struct UncountedEnd {
  Origin origin;
};
}  // namespace dripline::interpreter::blending::impl

template <>
inline constexpr bool dripline::interpreter::look_ahead::kIsBlockEnd<
    dripline::interpreter::blending::impl::UncountedEnd> = true;

namespace dripline::interpreter::blending::impl {

/// The place of the piece of a corner that has a block of its own.
struct CornerPlace {
  Origin origin;
};

using Held = look_ahead::HeldEvents<compensation::Command, UncountedEnd, CornerPlace>;

/// Everything that decides the rest of the path; `visit_state` (state.cpp) lists the
/// members: add new ones there too.
struct State : look_ahead::StageState<Element, Held> {
  static constexpr std::string_view kName = "blending";

  Announced next;
  /// The end of a block right after the waiting element, which most blocks have: kept apart from
  /// the events that come later, because this is quicker.
  bool has_end = false;
  Origin end;
};

}  // namespace dripline::interpreter::blending::impl
