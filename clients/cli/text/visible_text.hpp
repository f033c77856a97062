#pragma once

#include <string>
#include <string_view>

namespace dripline::cli {

/// Text for a terminal, with the control characters that could steer it (ESC, carriage return,
/// DEL, and U+0080 to U+009F) written as `\x1b`; lines and tabs stay. Takes a text in pieces.
class VisibleText {
 public:
  /// The visible form; stays until the next call.
  std::string_view take(std::string_view piece);

 private:
  std::string text_;
  bool is_after_c2_ = false;  ///< the last byte may begin a control character of two
};

}  // namespace dripline::cli
