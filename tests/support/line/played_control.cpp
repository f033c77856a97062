#include "tests/support/line/played_control.hpp"

#include <array>
#include <span>

#include "tests/support/patience.hpp"

namespace dripline::test_support {

PlayedControl::PlayedControl(const wire::LineSettings& settings, TestLine& line)
    : cable_(line), discipline_(wire::make_discipline(settings, wire::Role::Control).value()) {}

Result<void> PlayedControl::send(const std::string& text, const std::string& name) {
  to_send_ = text;
  return discipline_->begin_send(name, now());
}

bool PlayedControl::until(const std::function<bool()>& is_so) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!is_so()) {
    if (std::chrono::steady_clock::now() > end) return false;
    step();
  }
  return true;
}

void PlayedControl::step() {
  const std::string bytes = cable_.read_for(std::chrono::milliseconds(2));
  discipline_->receive(std::as_bytes(std::span(bytes)), now());
  if (const auto deadline = discipline_->deadline(); deadline && *deadline <= now()) {
    discipline_->tick(now());
  }
  std::array<std::byte, 256> room{};
  while (const std::size_t size = discipline_->transmit(room, now())) {
    cable_.write({reinterpret_cast<const char*>(room.data()), size});
  }
  for (auto& event : discipline_->take_events()) take(event);
  // A protocol that asks first has room when it was answered.
  if (to_send_ && discipline_->room() >= to_send_->size()) {
    const auto offered = discipline_->offer(*std::exchange(to_send_, {}), true, now());
    if (!offered) failures.push_back(offered.error());
  }
}

void PlayedControl::take(wire::Event& event) {
  if (const auto* text = std::get_if<wire::TextReceived>(&event)) {
    received += text->text;
    program_ += text->text;
  } else if (const auto* ended = std::get_if<wire::TransferEnded>(&event)) {
    if (ended->is_receiving) {
      programs.push_back(std::exchange(program_, {}));
    } else {
      ++sends;
    }
  } else if (const auto* failed = std::get_if<wire::TransferFailed>(&event)) {
    program_.clear();
    failures.push_back(failed->error);
  }
}

}  // namespace dripline::test_support
