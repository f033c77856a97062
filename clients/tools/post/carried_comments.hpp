#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::post {

/// The comments of a program's text in their order, each once, whatever the program repeats.
class CarriedComments {
 public:
  /// `text` must outlive it. `control`: whose lexical rules it has; one without comments has none.
  CarriedComments(std::string_view control, std::string_view text);

  /// Appends those up to the end of the line at `offset`: printable ASCII without parentheses, at
  /// most kMaxLength of each. What a control acts upon, (MSG,...), is no comment.
  void take_up_to(std::uint64_t offset, std::vector<std::string>& comments);

  static constexpr std::size_t kMaxLength = 120;

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  bool has_parentheses_ = false, has_semicolon_ = false;
};

/// Whether a control with such comments acts upon this one.
bool is_active_comment(std::string_view comment);

}  // namespace dripline::post
