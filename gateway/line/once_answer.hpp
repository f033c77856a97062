#pragma once

#include <utility>

#include "gateway/line/port_line.hpp"

namespace dripline::line {

/// Calls the answer exactly once: with a result, or when the work that should have given one was
/// dropped with its line.
class OnceAnswer {
 public:
  OnceAnswer(PostTask post, PortLine::Answer answer)
      : post_(std::move(post)), answer_(std::move(answer)) {}
  OnceAnswer(const OnceAnswer&) = delete;
  OnceAnswer& operator=(const OnceAnswer&) = delete;
  ~OnceAnswer() { give(fail(Errc::Io, "the line was closed")); }

  void give(Result<void> result) {
    if (!answer_) return;
    post_(
        [answer = std::exchange(answer_, nullptr), result = std::move(result)] { answer(result); });
  }

 private:
  PostTask post_;
  PortLine::Answer answer_;
};

}  // namespace dripline::line
