#include "gateway/app/serial/line_calls.hpp"

#include "gateway/app/run/run_texts.hpp"

namespace dripline::gateway {

void LineCalls::add(dds::LineCallAction action, const std::string& argument, SteadyTime now) {
  constexpr std::size_t kMaxArgument = 128;
  call_ = dds::LineCall{++last_number_, action, valid_text(argument, kMaxArgument), reply_};
  until_ = now + kLife;
}

void LineCalls::end(std::uint64_t number) {
  if (call_ && call_->number == number) call_.reset();
}

void LineCalls::poll(SteadyTime now) {
  if (call_ && now >= until_) call_.reset();
}

}  // namespace dripline::gateway
