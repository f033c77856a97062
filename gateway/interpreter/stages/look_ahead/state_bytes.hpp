#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"
#include "protocol/base/result.hpp"

/// The bytes of a stage that looks ahead: its state, which the stage's own `visit_state` lists, and
/// the events that wait.
namespace dripline::interpreter::language {

template <>
inline constexpr auto kLast<look_ahead::HeldText::Kind> = look_ahead::HeldText::Kind::Message;
template <>
inline constexpr auto kLast<compensation::Command::Kind> =
    compensation::Command::Kind::ResumeOutput;
template <>
inline constexpr auto kLast<compensation::Side> = compensation::Side::Right;
template <>
inline constexpr auto kLast<compensation::StartUp> = compensation::StartUp::Tangent;

}  // namespace dripline::interpreter::language

namespace dripline::interpreter::look_ahead {

using language::StateReader;
using language::StateWriter;

template <class Held>
void write_held(StateWriter& archive, const Held& held) {
  auto count = static_cast<std::uint16_t>(held.size());
  archive(count);
  for (std::size_t i = 0; i < held.size(); ++i) {
    typename Held::Event event = held[i];
    archive(event);
    if (const auto* text = std::get_if<HeldText>(&event)) {
      std::string content(held.text(*text));
      archive(content);
    }
  }
}

template <class Held>
void read_held(StateReader& archive, Held& held) {
  std::uint16_t count = 0;
  archive(count);
  held.clear();
  for (std::uint16_t i = 0; i < count && !archive.is_damaged(); ++i) {
    typename Held::Event event;
    archive(event);
    const auto push = [&]<class One>(const One& one) {
      if constexpr (std::is_same_v<One, HeldText>) {
        std::string content;
        archive(content);
        return held.push(one, content);
      } else {
        return held.push(one);
      }
    };
    if (!archive.is_damaged() && !std::visit(push, event)) archive.damage();
  }
}

/// Member by member, so that equal states have equal bytes; only what is in use.
template <class Stage, class State, class FaultKind>
std::vector<std::byte> LookAheadStage<Stage, State, FaultKind>::state() const {
  StateWriter archive;
  State copy = state_;
  visit_state(archive, copy);
  write_held(archive, state_.held);
  return archive.take();
}

template <class Stage, class State, class FaultKind>
Result<void> LookAheadStage<Stage, State, FaultKind>::restore(const std::vector<std::byte>& bytes) {
  StateReader archive(bytes, language::Numbers::Finite);
  State read;
  visit_state(archive, read);
  read_held(archive, read.held);
  if (!archive.is_complete()) {
    return fail(Errc::Corrupt, "{} state of {} bytes does not read back", State::kName,
                bytes.size());
  }
  state_ = read;
  fault_.reset();
  return {};
}

}  // namespace dripline::interpreter::look_ahead
