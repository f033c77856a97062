#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "protocol/base/result.hpp"

namespace dripline::line {

/// Where the text of a job comes from. Read where the owner of the line waits, never on the line's
/// thread.
class TextSource {
 public:
  virtual ~TextSource() = default;
  /// At most `length` bytes from `offset`, which lies before the text's end; fewer do not mean the
  /// end. Empty: they have not come yet, PortLine::on_text asks again. Errors: it cannot be had;
  /// the job ends.
  virtual Result<std::string> read(std::uint64_t offset, std::uint64_t length) = 0;
  /// The same of what can be had without waiting for the owner's storage; empty: not so.
  virtual std::string near(std::uint64_t offset, std::uint64_t length) {
    static_cast<void>(offset), static_cast<void>(length);
    return {};
  }
};

/// A text that is here as a whole.
class KeptText final : public TextSource {
 public:
  explicit KeptText(std::string text) : text_(std::move(text)) {}
  Result<std::string> read(std::uint64_t offset, std::uint64_t length) override {
    return text_.substr(std::min<std::uint64_t>(offset, text_.size()), length);
  }

 private:
  const std::string text_;
};

}  // namespace dripline::line
