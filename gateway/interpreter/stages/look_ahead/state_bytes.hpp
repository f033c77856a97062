#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "gateway/interpreter/core/language/event_archive.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"
#include "protocol/base/result.hpp"

/// The bytes of a stage that looks ahead: its state, which the stage's own `visit_state` lists, and
/// the events that wait.
namespace dripline::interpreter::look_ahead {

using language::StateReader;
using language::StateWriter;
using language::up_to;
using language::visit;
using language::visit_all;
using language::visit_numbers;
using language::visit_optional;

template <class Archive>
void visit(Archive& archive, BlockEnd& event) {
  visit(archive, event.origin);
}
template <class Archive>
void visit(Archive& archive, HeldText& text) {
  up_to(archive, text.kind, HeldText::Kind::Message);
  up_to(archive, text.device, OutputDevice::Printer);
  visit(archive, text.origin);
  archive(text.size);
}

template <class Held>
void write_held(StateWriter& archive, const Held& held) {
  auto count = static_cast<std::uint16_t>(held.size());
  archive(count);
  for (std::size_t i = 0; i < held.size(); ++i) {
    typename Held::Event event = held[i];
    auto kind = static_cast<std::uint8_t>(event.index());
    archive(kind);
    std::visit([&](auto& one) { visit(archive, one); }, event);
    if (const auto* text = std::get_if<HeldText>(&event)) {
      for (char c : held.text(*text)) archive(c);
    }
  }
}

template <class Event, class Held>
void read_event(StateReader& archive, Held& held) {
  Event event{};
  visit(archive, event);
  if constexpr (std::is_same_v<Event, HeldText>) {
    if (event.size > kMaxHeldText) archive.damage();
    std::array<char, kMaxHeldText> content;
    for (std::uint32_t i = 0; i < event.size && !archive.is_damaged(); ++i) archive(content[i]);
    if (!archive.is_damaged() && !held.push(event, {content.data(), event.size})) archive.damage();
  } else {
    if (!archive.is_damaged() && !held.push(event)) archive.damage();
  }
}

template <class Held, std::size_t... Kinds>
void read_kind(StateReader& archive, Held& held, std::size_t kind, std::index_sequence<Kinds...>) {
  using Event = typename Held::Event;
  const bool is_known =
      ((kind == Kinds ? (read_event<std::variant_alternative_t<Kinds, Event>>(archive, held), true)
                      : false) ||
       ...);
  if (!is_known) archive.damage();
}

template <class Held>
void read_held(StateReader& archive, Held& held) {
  constexpr std::size_t kKinds = std::variant_size_v<typename Held::Event>;
  std::uint16_t count = 0;
  archive(count);
  held.clear();
  for (std::uint16_t i = 0; i < count && !archive.is_damaged(); ++i) {
    std::uint8_t kind = 0;
    archive(kind);
    read_kind(archive, held, kind, std::make_index_sequence<kKinds>{});
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
  StateReader archive(bytes);
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
